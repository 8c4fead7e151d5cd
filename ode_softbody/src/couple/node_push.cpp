// Forces of the nodes that touch; samples and poles have their own.
#include "collide/shape_distance.h"
#include "couple/node_contact.h"

namespace ode::soft {
namespace {

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

} // namespace

template <class Distance>
inline bool NodeContact::may_touch(Distance distance_of, std::size_t i, const Vec3& local,
                                   const Vec3& slip, const Mat3& rotation, double dt,
                                   SurfaceDistance& gap) noexcept {
    gap = distance_of(shape_, local);
    if (!recess_.empty())
        gap.distance += recess_[i];
    Vec3& entered = entered_[i];
    if (anchored_[i] && gap.normal.dot(entered) < 0)
        gap = {entered.dot(local) - shape_.support(entered), entered};
    if (gap.distance < 0)
        gap.distance += overlap_[i].hidden(-gap.distance, -slip.dot(rotation * gap.normal), dt);
    else
        overlap_[i].hidden(0, 0, dt);
    if (gap.distance >= 0) {
        anchored_[i] = 0;
        const double reach = kForesight * dt;
        if (gap.distance * gap.distance >= reach * reach * slip.squaredNorm())
            return false;
    }
    entered = gap.normal;
    return true;
}

double NodeContact::find_touching(const NodeArray& position, const NodeArray& velocity,
                                  const RigidShadow& rigid, double dt) noexcept {
    const RigidMotion& motion = rigid.motion();
    const Pose pose = shape_.pose.in(motion.pose);
    double load = 0;
    with_distance(shape_.kind, [&](auto distance_of) {
        for (const int i : candidate_) {
            const std::size_t n = index(nodes_.node[index(i)]);
            const Vec3 x = position[n];
            const Vec3 local = pose.to_local(x);
            const Vec3 slip = velocity[n] - motion.velocity_at(x);
            SurfaceDistance gap{};
            if (!may_touch(distance_of, index(i), local, slip, pose.rotation, dt, gap)) {
                book_[index(i)].close();
                continue;
            }
            const Vec3 normal = pose.rotation * gap.normal;
            load += grip_load(index(i), x, normal, dt, rigid);
            touch({i, local, gap.normal, normal, -gap.distance, x, slip}, rigid, dt);
        }
    });
    return load;
}

double NodeContact::find_touching_planes(const NodeArray& position, const NodeArray& velocity,
                                         const RigidShadow& rigid, double dt) noexcept {
    const RigidMotion& motion = rigid.motion();
    const Pose pose = shape_.pose.in(motion.pose);
    double load = 0;
    for (std::size_t c = 0; c < candidate_.size(); ++c) {
        const std::size_t i = index(candidate_[c]);
        const std::size_t n = index(nodes_.node[i]);
        const Vec3 x = position[n];
        const Vec3 local = pose.to_local(x);
        const Vec3 slip = velocity[n] - motion.velocity_at(x);
        const double way = kForesight * dt * slip.norm();
        const Planes& planes = planes_[c];
        double deepest = 0;
        for (int k = 0; k < planes.count; ++k) {
            const TangentPlane& plane = planes.plane[index(k)];
            const double depth = plane.offset - plane.normal.dot(local);
            if (depth <= -way)
                continue;
            const Vec3 normal = pose.rotation * plane.normal;
            load += grip_load(i, x, normal, dt, rigid);
            touch_.push_back({candidate_[c], local, plane.normal, normal, depth, x, slip});
            if (depth > deepest)
                entered_[i] = plane.normal;
            deepest = std::fmax(deepest, depth);
        }
        if (deepest == 0)
            anchored_[i] = 0;
    }
    return load;
}

void NodeContact::touch(Touch touch, const RigidShadow& rigid, double dt) noexcept {
    const std::size_t i = index(touch.node);
    if (rigid.needs_books(dt))
        touch.owed = book_[i].open({.stiffness = stiffness_[i],
                                    .damping = 0,
                                    .compliance = 0,
                                    .depth = touch.depth,
                                    .speed = -touch.slip.dot(touch.normal),
                                    .ahead = 0},
                                   dt);
    touch_.push_back(touch);
}

double NodeContact::grip_load(std::size_t node, const Vec3& x, const Vec3& normal, double dt,
                              const RigidShadow& rigid) const noexcept {
    if (law_.friction == 0 || !rigid.can_move())
        return 0;
    return kTangential * (stiffness_[node] * dt + 2 * damping_[node]) * dt *
           rigid.grip_compliance(x, normal);
}

Vec3 NodeContact::grip_of(std::size_t i, const Vec3& local, const Vec3& across, const Vec3& slip,
                          const Vec3& normal, double press, const Mat3& rotation,
                          const TouchForces& on, const Vec3& base, const Vec3* led) noexcept {
    if (!anchored_[i]) {
        anchored_[i] = 1;
        anchor_[i] = local;
    }
    if (law_.friction == 0)
        return Vec3::Zero();
    double k = kTangential * softening_ * stiffness_[i];
    if (!nodes_.residual_across.empty())
        k /= 1 + k * nodes_.residual_across[index(nodes_.node[i])];
    const double c = kTangential * softening_ * damping_[i];
    const double grip = law_.friction * press;
    Vec3 stretch = local - anchor_[i];
    stretch -= across.dot(stretch) * across;
    if (clamp_length(stretch, grip / k))
        anchor_[i] = local - stretch;
    Vec3 f = rotation * (-k * stretch) - c * (slip - slip.dot(normal) * normal);
    if (led) {
        // The substep is long for these springs: the force is the one at its end.
        const Vec3 stretched = rotation * stretch;
        const auto across_of = [&](const Vec3& v) { return Vec3(v - v.dot(normal) * normal); };
        const Vec3 along = (stretched + on.dt * across_of(slip)).stableNormalized();
        const double compliance = along.dot(on.force.joint()->yield(index(nodes_.node[i]), along));
        const Vec3 creep = across_of(*led - base);
        f = -(k * (stretched + on.dt * creep) + c * creep) /
            (1 + compliance * on.dt * (k * on.dt + c));
    }
    clamp_length(f, grip);
    return f;
}

void NodeContact::push_at_once(const NodeArray& position, const TouchForces& on, RigidShadow& rigid,
                               std::vector<RigidPush>* felt) noexcept {
    if (!at_once_)
        return;
    const RigidMotion motion = rigid.motion();
    const Pose pose = shape_.pose.in(motion.pose);
    Wrench sum;
    with_distance(shape_.kind, [&](auto distance_of) {
        // Who comes later meets what the earlier have done, not the other way round. Always in one
        // order, nodes that lie on a floor would be driven by it; to and fro they come to rest.
        for (std::size_t at = 0; at < candidate_.size(); ++at) {
            const std::size_t i = index(candidate_[backwards_ ? candidate_.size() - 1 - at : at]);
            const std::size_t n = index(nodes_.node[i]);
            const Vec3 x = position[n];
            const Vec3 local = pose.to_local(x);
            const Vec3 slip = on.velocity[n] - motion.velocity_at(x);
            SurfaceDistance gap{};
            if (!may_touch(distance_of, i, local, slip, pose.rotation, on.dt, gap))
                continue;
            const Vec3 normal = pose.rotation * gap.normal;
            const double parting = slip.dot(normal);
            const Vec3 base = motion.velocity_at(x);
            const JointInertia* const joint = on.force.joint();
            const double lightness = on.inverse_mass[n];
            Vec3 yield, led;
            if (joint) {
                yield = joint->yield(n, normal);
                led = joint->ahead({{static_cast<int>(n)}, {1, 0, 0}});
            } else {
                led = on.velocity[n] + on.dt * lightness * on.force[n];
            }
            const double press = NormalContact{.stiffness = stiffness_[i],
                                               .damping = damping_[i],
                                               .compliance = joint ? normal.dot(yield) : lightness,
                                               .depth = -gap.distance,
                                               .speed = -parting,
                                               .ahead = (base - led).dot(normal)}
                                     .press(on.dt)
                                     .force;
            if (press == 0)
                continue;
            ++bearing_;
            if (joint)
                led += on.dt * press * yield;
            const Vec3 f =
                press * normal + grip_of(i, local, gap.normal, slip, normal, press, pose.rotation,
                                         on, base, joint ? &led : nullptr);
            on.force.add(n, f);
            sum.force -= f;
            sum.torque -= (x - motion.pose.position).cross(f);
            if (felt)
                felt->push_back({x, -f});
        }
    });
    if (bearing_ != 0)
        rigid.add(sum);
}

void NodeContact::sweep(const TouchForces& on, RigidResponse& rigid) noexcept {
    for (Touch& touch : touch_) {
        const std::size_t i = index(touch.node);
        const std::size_t n = index(nodes_.node[i]);
        const Vec3& x = touch.at;
        const auto [velocity, lightness] = ahead_of(on, n, touch.normal);
        const Vec3 ahead = velocity - rigid.velocity_at(x);
        const Press press =
            NormalContact{.stiffness = stiffness_[i],
                          .damping = damping_[i],
                          .compliance = lightness,
                          .depth = touch.depth,
                          .speed = -touch.slip.dot(touch.normal),
                          .ahead = -ahead.dot(touch.normal) + on.dt * lightness * touch.press.force,
                          .owed = touch.owed}
                .press(on.dt);
        rigid.add(x, -touch.normal, press, touch.press.force);
        const double more = press.force - touch.press.force;
        touch.press = press;
        if (more != 0)
            on.force.add(n, more * touch.normal);
    }
    samples_.sweep(on, rigid);
    poles_.sweep(on, rigid);
}

void NodeContact::enter_books(const TouchForces& on, const RigidResponse& rigid) noexcept {
    for (const Touch& touch : touch_) {
        const std::size_t n = index(nodes_.node[index(touch.node)]);
        const Vec3 ahead = ahead_of(on, n, touch.normal).velocity - rigid.velocity_at(touch.at);
        book_[index(touch.node)].enter(touch.press.spring,
                                       -on.dt * (touch.slip + ahead).dot(touch.normal));
    }
    samples_.enter_books(on, rigid);
    poles_.enter_books(on, rigid);
}

std::size_t NodeContact::drag(const TouchForces& on, RigidShadow& rigid) noexcept {
    const RigidMotion& motion = rigid.motion();
    const Mat3 rotation = shape_.pose.in(motion.pose).rotation;
    for (Touch& touch : touch_) {
        if (touch.press.force == 0)
            continue;
        ++bearing_;
        const std::size_t i = index(touch.node);
        const std::size_t n = index(nodes_.node[i]);
        const JointInertia* const joint = on.force.joint();
        Vec3 led;
        if (joint)
            led = joint->ahead({{static_cast<int>(n)}, {1, 0, 0}});
        const Vec3 f =
            grip_of(i, touch.local, touch.across, touch.slip, touch.normal, touch.press.force,
                    rotation, on, motion.velocity_at(touch.at), joint ? &led : nullptr);
        if (law_.friction == 0)
            continue;
        touch.grip = f;
        on.force.add(n, f);
        rigid.add({-f, -(touch.at - motion.pose.position).cross(f)});
    }
    bearing_ += samples_.drag(softening_, on, rigid);
    bearing_ += poles_.drag(softening_, on, rigid);
    return bearing_;
}

} // namespace ode::soft
