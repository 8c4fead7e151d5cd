#include "bridge/rigid_touch.h"

#include <cstdint>
#include <utility>

namespace ode::sound {

void RigidTouches::begin_step() noexcept {
    touch_.clear();
    recalled_.clear();
    used_ = 0;
    ++step_;
}

void RigidTouches::add(dSoftWorldID world, dJointID joint) {
    RigidTouch touch{};
    touch.joint = joint;
    // ODE gives the forces of a joint on the ground to the body that it has, as the first.
    for (int i = 0; i < 2; ++i)
        touch.body[i] = dJointGetBody(joint, i);
    if (!touch.body[0])
        std::swap(touch.body[0], touch.body[1]);
    for (int i = 0; i < 2; ++i)
        if (touch.body[i])
            touch.motion[i] = motion_of(touch.body[i]);
    dSoftRigidContact made{};
    made.struct_size = sizeof made;
    touch.located = dSoftWorldGetRigidContact(world, joint, &made) != 0;
    touch.friction = -1.0;
    if (touch.located) {
        touch.position = Vec3(made.position);
        touch.normal = Vec3(made.normal);
        touch.depth = made.depth;
        touch.friction = made.friction;
        const bool crossed = made.geom[0] && dGeomGetBody(made.geom[0]) != touch.body[0];
        touch.geom[0] = made.geom[crossed];
        touch.geom[1] = made.geom[!crossed];
        if (crossed)
            touch.normal = -touch.normal;
    } else {
        recall(touch);
    }
    touch.feedback = dJointGetFeedback(joint);
    touch.ours = !touch.feedback;
    if (touch.ours) {
        if (used_ == feedback_.size())
            feedback_.emplace_back();
        touch.feedback = &feedback_[used_++];
        dJointSetFeedback(joint, touch.feedback);
    }
    *touch.feedback = {}; // of a body asleep ODE leaves it as it is
    touch_.push_back(touch);
}

const RigidMotion& RigidTouches::motion_of(dBodyID body) {
    constexpr std::size_t kPlaces = 1024;
    moving_.resize(kPlaces);
    const auto address = reinterpret_cast<std::uintptr_t>(body);
    Moving& own = moving_[(address >> 4 ^ address >> 14) % kPlaces];
    if (own.body != body || own.step != step_)
        own = {body, step_, RigidMotion(body)};
    return own.motion;
}

void RigidTouches::recall(RigidTouch& touch) {
    // Joints of a pair come one after the other.
    if (!touch_.empty() && !touch_.back().located && touch_.back().body[0] == touch.body[0] &&
        touch_.back().body[1] == touch.body[1]) {
        touch.recalled = touch_.back().recalled;
        touch.recalled_count = touch_.back().recalled_count;
        return;
    }
    touch.recalled = static_cast<int>(recalled_.size());
    recall_contacts(touch.body[0], touch.body[1], recalled_);
    touch.recalled_count = static_cast<int>(recalled_.size()) - touch.recalled;
}

void RigidTouches::read(double h) noexcept {
    for (RigidTouch& touch : touch_) {
        touch.impulse = h * Vec3(touch.feedback->f1);
        touch.turning = h * Vec3(touch.feedback->t1);
        touch.second_turning = h * Vec3(touch.feedback->t2);
        if (touch.ours)
            dJointSetFeedback(touch.joint, nullptr);
    }
}

} // namespace ode::sound
