#include "world/observer.h"
#include "api/boundary.h"
#include "api/handles.h"
#include "api/versioned.h"

using namespace ode::soft;

namespace {

/// A set of C callbacks as an Observer. Owned by the world's observer list through this file.
class CallbackObserver final : public Observer {
public:
    CallbackObserver(const dSoftObserver& callbacks, dSoftWorldID world) noexcept
        : call_(callbacks), world_(world) {}

    void* data() const noexcept { return call_.data; }

    bool wants_substeps() const noexcept override { return call_.on_substep || call_.on_modal; }
    bool takes_modes() const noexcept override { return call_.on_modal || !call_.on_substep; }

    void on_substep(const SubstepView& view) noexcept override {
        const Body& body = view.body;
        if (body.rings() && call_.on_modal) {
            show_modes(view);
            return;
        }
        if (!call_.on_substep)
            return;
        const auto& triangles = body.surface().triangle;
        const NodeState& state = body.shown_state();
        dSoftSubstep substep{};
        substep.struct_size = sizeof substep;
        substep.body = to_id(body);
        substep.time = view.time;
        substep.dt = view.dt;
        substep.position = state.position.data();
        substep.velocity = state.velocity.data();
        substep.stride = NodeArray::kStride;
        substep.node_count = static_cast<int>(state.position.size());
        substep.triangle = triangles.front().data();
        substep.triangle_count = static_cast<int>(triangles.size());
        call_.on_substep(call_.data, &substep);
    }

    bool wants_pushes() const noexcept override { return call_.on_rigid_pushes; }

    void on_pushes(double time, double dt, std::span<const PushView> pushes) noexcept override {
        push_.clear();
        for (const PushView& view : pushes) {
            dSoftRigidPush& out = push_.emplace_back();
            out.body = view.rigid;
            out.soft = to_id(*view.soft);
            for (int i = 0; i < 3; ++i) {
                out.position[i] = view.push.position[i];
                out.force[i] = view.push.force[i];
                out.center[i] = view.pose.position[i];
                for (int j = 0; j < 3; ++j)
                    out.rotation[4 * i + j] = view.pose.rotation(i, j);
            }
        }
        const dSoftRigidPushes all{sizeof all,  world_, time, dt, static_cast<int>(push_.size()),
                                   push_.data()};
        call_.on_rigid_pushes(call_.data, &all);
    }

    void on_step(SoftWorld& world, double time) noexcept override {
        if (call_.on_step)
            call_.on_step(call_.data, to_id(world), time);
    }

    void on_moved(SoftWorld& world, double time) noexcept override {
        if (call_.on_moved)
            call_.on_moved(call_.data, to_id(world), time);
    }

    void on_body_end(Body& body) noexcept override {
        if (call_.on_body_end)
            call_.on_body_end(call_.data, to_id(body));
    }

    void on_world_end(SoftWorld& world) noexcept override {
        if (call_.on_world_end)
            call_.on_world_end(call_.data, to_id(world));
    }

private:
    void show_modes(const SubstepView& view) const noexcept {
        const ModalMotion& motion = *view.body.modal_motion();
        const ModalState& now = motion.state();
        const ModalMotion::Shown shown = motion.shown();
        dSoftModalState state{};
        state.struct_size = sizeof state;
        state.body = to_id(view.body);
        state.time = view.time;
        state.dt = view.dt;
        state.mode_count = static_cast<int>(shown.count);
        state.amplitude = shown.amplitude;
        state.rate = shown.rate;
        const Vec3 spin = motion.spin();
        const Mat3 turn = now.turn.toRotationMatrix();
        for (int i = 0; i < 3; ++i) {
            state.center[i] = now.center[i];
            state.velocity[i] = now.velocity[i];
            state.spin[i] = spin[i];
            for (int j = 0; j < 3; ++j)
                state.rotation[4 * i + j] = turn(i, j);
        }
        call_.on_modal(call_.data, &state);
    }

    dSoftObserver call_;
    dSoftWorldID world_;
    std::vector<dSoftRigidPush> push_; ///< scratch
};

} // namespace

int dSoftWorldAddObserver(dSoftWorldID world, const dSoftObserver* observer) {
    require_id(observer, __func__);
    SoftWorld* watched = live(world, __func__);
    if (!watched)
        return 0;
    return guarded(__func__, 0, [&] {
        dSoftObserver callbacks{};
        copy_in(*observer, "{sizeof(dSoftObserver), ...}", &callbacks);
        watched->add_observer(std::make_unique<CallbackObserver>(callbacks, to_id(*watched)));
        return 1;
    });
}

int dSoftWorldAddSubstepObserver(dSoftWorldID world, dSoftSubstepCallback* callback, void* data) {
    dSoftObserver observer{};
    observer.struct_size = sizeof observer;
    observer.data = data;
    observer.on_substep = callback;
    return dSoftWorldAddObserver(world, &observer);
}

int dSoftWorldRemoveObserver(dSoftWorldID world, void* data) {
    SoftWorld* watched = live(world, __func__);
    if (!watched)
        return 0;
    return static_cast<int>(watched->remove_observers([data](const Observer& observer) {
        const auto* callbacks = dynamic_cast<const CallbackObserver*>(&observer);
        return callbacks && callbacks->data() == data;
    }));
}
