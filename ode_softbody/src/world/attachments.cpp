#include "world/attachments.h"

#include "base/error.h"
#include "world/body.h"
#include "world/rigid_exchange.h"

#include <ode/objects.h>

#include <algorithm>

namespace ode::soft {
namespace {

constexpr double kMoved = 1e-9; ///< [m] by the application, not by rounding

Pose pose_of(dBodyID rigid) noexcept {
    const dReal* x = dBodyGetPosition(rigid);
    const dReal* r = dBodyGetRotation(rigid);
    Pose pose;
    for (int i = 0; i < 3; ++i) {
        pose.position[i] = x[i];
        for (int j = 0; j < 3; ++j)
            pose.rotation(i, j) = r[4 * i + j]; // dMatrix3: rows of four
    }
    return pose;
}

} // namespace

int Attachments::attach(Body& soft, dBodyID rigid, std::span<const int> nodes) {
    const Pose pose = pose_of(rigid);
    Anchor* anchor = find(rigid);
    if (!anchor)
        anchor = &anchor_.emplace_back(
            Anchor{rigid, std::make_unique<BodyWatch>(rigid), {}, RigidBond(), 0});
    auto group = std::find_if(anchor->group.begin(), anchor->group.end(),
                              [&](const Group& g) { return g.soft == &soft; });
    if (group == anchor->group.end())
        group = anchor->group.insert(group, Group{&soft, {}});
    for (const int node : soft.nail(nodes))
        group->nail.push_back(
            {node, pose.to_local(soft.state().position[static_cast<std::size_t>(node)])});
    return static_cast<int>(group->nail.size());
}

int Attachments::detach(Body& soft, dBodyID rigid) noexcept {
    Anchor* anchor = find(rigid);
    int freed = 0;
    if (!anchor)
        return 0;
    std::erase_if(anchor->group, [&](const Group& group) {
        if (group.soft != &soft)
            return false;
        for (const Nail& nail : group.nail)
            soft.release(nail.node);
        freed = static_cast<int>(group.nail.size());
        return true;
    });
    std::erase_if(anchor_, [](const Anchor& a) { return a.group.empty(); });
    return freed;
}

void Attachments::forget(const Body& soft) noexcept {
    for (Anchor& anchor : anchor_)
        std::erase_if(anchor.group, [&](const Group& group) { return group.soft == &soft; });
    std::erase_if(anchor_, [](const Anchor& a) { return a.group.empty(); });
}

bool Attachments::has(const Body& soft) const noexcept {
    return std::any_of(anchor_.begin(), anchor_.end(),
                       [&](const Anchor& a) { return find(soft, a.rigid) != nullptr; });
}

bool Attachments::has(const Body& soft, dBodyID rigid) const noexcept {
    return find(soft, rigid) != nullptr;
}

void Attachments::check() noexcept {
    std::erase_if(anchor_, [](const Anchor& anchor) {
        if (!anchor.watch->gone())
            return false;
        for (const Group& group : anchor.group) {
            for (const Nail& nail : group.nail)
                group.soft->release(nail.node);
            report(format("the rigid body that %zu nodes of soft body %p were attached to is gone; "
                          "they are free now",
                          group.nail.size(), group.soft->id()));
        }
        return true;
    });
}

void Attachments::announce(RigidExchange& exchange) const {
    for (const Anchor& anchor : anchor_)
        exchange.expect(anchor.rigid);
}

void Attachments::begin_step(RigidExchange& exchange, double h, double dt) noexcept {
    for (Anchor& anchor : anchor_) {
        anchor.shadow = exchange.shadow_of(anchor.rigid, h, dt);
        anchor.bond.forget();
        const Pose& pose = exchange.shadow(anchor.shadow).motion().pose;
        for (const Group& group : anchor.group)
            if (!group.soft->stopped())
                for (const Nail& nail : group.nail) {
                    auto x = group.soft->state_.position[static_cast<std::size_t>(nail.node)];
                    const Vec3 place = pose.to_world(nail.place);
                    if ((place - x).squaredNorm() > kMoved * kMoved)
                        group.soft->budget_.restart();
                    x = place;
                }
    }
}

void Attachments::bind(RigidExchange& exchange, double dt) noexcept {
    for (Anchor& anchor : anchor_) {
        RigidShadow& rigid = exchange.shadow(anchor.shadow);
        anchor.bond.begin(rigid, dt);
        for (const Group& group : anchor.group) {
            Body& soft = *group.soft;
            if (soft.stopped())
                continue;
            for (const Nail& nail : group.nail) {
                const auto n = static_cast<std::size_t>(nail.node);
                anchor.bond.add(soft.mass()[n], soft.state_.position[n], soft.state_.velocity[n],
                                soft.force_[n]);
            }
        }
        anchor.bond.bind(rigid);
        for (const Group& group : anchor.group)
            if (!group.soft->stopped())
                for (const Nail& nail : group.nail) {
                    const auto n = static_cast<std::size_t>(nail.node);
                    Body& soft = *group.soft;
                    auto velocity = soft.state_.velocity[n];
                    const Vec3 bound = anchor.bond.velocity(soft.state_.position[n]);
                    // What holds the node gives it all that its own forces do not.
                    soft.budget_.add_work(
                        (bound + velocity)
                            .dot(soft.mass()[n] * (bound - velocity) - dt * soft.force_[n]) /
                        2);
                    exchange.note_push(soft, anchor.shadow,
                                       {soft.state_.position[n],
                                        soft.force_[n] - soft.mass()[n] / dt * (bound - velocity)});
                    velocity = bound;
                }
    }
}

void Attachments::follow(const RigidExchange& exchange) noexcept {
    for (Anchor& anchor : anchor_) {
        const Pose& pose = exchange.shadow(anchor.shadow).motion().pose;
        for (const Group& group : anchor.group) {
            if (group.soft->stopped())
                continue;
            NodeState& state = group.soft->state_;
            for (const Nail& nail : group.nail) {
                const auto n = static_cast<std::size_t>(nail.node);
                const Vec3 place = pose.to_world(nail.place);
                anchor.bond.settle(group.soft->mass()[n], state.velocity[n], state.position[n],
                                   place);
                state.position[n] = place;
            }
        }
    }
}

Attachments::Anchor* Attachments::find(dBodyID rigid) noexcept {
    const auto found = std::find_if(anchor_.begin(), anchor_.end(),
                                    [&](const Anchor& a) { return a.rigid == rigid; });
    return found == anchor_.end() ? nullptr : &*found;
}

const Attachments::Group* Attachments::find(const Body& soft, dBodyID rigid) const noexcept {
    for (const Anchor& anchor : anchor_)
        if (anchor.rigid == rigid)
            for (const Group& group : anchor.group)
                if (group.soft == &soft)
                    return &group;
    return nullptr;
}

} // namespace ode::soft
