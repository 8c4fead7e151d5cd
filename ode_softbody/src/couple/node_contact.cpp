#include "couple/node_contact.h"

#include "collide/shape_distance.h"
#include "couple/outward.h"
#include "couple/surface_elasticity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode::soft {
namespace {

// Nodes within this many mean edges of the shape are candidates.
constexpr double kReach = 0.5;
// How far nodes may get before they are looked at anew: elastic waves may make them kHaste times
// as fast as the fastest is now, free bodies may accelerate by kAcceleration.
constexpr double kHaste = 4;
constexpr double kAcceleration = 1000; ///< [m/s^2]

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

bool same_shape(const RigidShape& a, const RigidShape& b) noexcept {
    return a.kind == b.kind && a.size == b.size && a.body == b.body;
}

/// Unit vector into the soft body at a surface node; zero for a node without triangles.
Vec3 inward_at(const SurfaceNodes& surface, const NodeArray& position, std::size_t i) noexcept {
    Vec3 sum = Vec3::Zero();
    if (!surface.triangle.empty())
        for (const int t : surface.fan(surface.node[i]))
            sum -= area_vector(surface, position, t);
    return sum.stableNormalized();
}

} // namespace

NodeContact::NodeContact(const SurfaceNodes& nodes, dGeomID geom)
    : nodes_(nodes), geom_(geom), stiffness_(nodes.node.size()), damping_(nodes.node.size()),
      anchor_(nodes.node.size(), Vec3::Zero()), anchored_(nodes.node.size(), 0),
      entered_(nodes.node.size(), Vec3::Zero()), overlap_(nodes.node.size()), samples_(nodes),
      poles_(nodes) {
    candidate_.reserve(nodes.node.size());
    touch_.reserve(nodes.node.size());
}

void NodeContact::begin_step(const RigidShape& shape, const ContactLaw& law,
                             std::span<const double> inverse_mass, double dt) {
    if (!same_shape(shape, shape_)) {
        std::fill(anchored_.begin(), anchored_.end(), std::uint8_t{0});
        touch_.clear();
        samples_.forget();
        poles_.forget();
        is_prepared_ = false;
        std::fill(overlap_.begin(), overlap_.end(), Overlap{});
        softening_ = 1;
    }
    is_prepared_ &= law == law_;
    shape_ = shape;
    law_ = law;
    if (!is_prepared_)
        prepare_points();
    inverse_mass_ = inverse_mass;
    if (shape.kind == ShapeKind::convex) {
        if (corners_.empty()) {
            corners_ = convex_corners(shape.probe);
            faces_ = hull_faces(corners_);
        }
        shape_.corners = corners_;
        shape_.faces = faces_;
    }
    samples_.begin_step(shape_, law, dt);
    // Half is the samples'. A node may meet as many as three planes of a probed shape; since the
    // normal spring is stable at any stiffness, their friction alone counts: 3 * 0.7 * 0.4 = 0.84.
    const double share = shape.kind == ShapeKind::plane    ? 1
                         : shape.kind == ShapeKind::probed ? 0.4
                                                           : 0.5;
    poles_.begin_step(shape_, law, share, dt);
    if (shape.kind == ShapeKind::probed && !probe_) {
        probe_ = std::make_unique<SurfaceProbe>(kReach * nodes_.mean_edge);
        planes_.reserve(nodes_.node.size());
        touch_.reserve(SurfaceProbe::kMostPlanes * nodes_.node.size());
    }
    const double bearable = share * kStiffnessShare / (dt * dt); // [1/s^2]
    const double kappa = law.stiffness > 0 ? law.stiffness : bearable * nodes_.mass_per_area;
    for (std::size_t i = 0; i < stiffness_.size(); ++i) {
        const bool held = inverse_mass[index(nodes_.node[i])] == 0;
        const double most = held ? std::numeric_limits<double>::infinity() : nodes_.mass[i];
        stiffness_[i] = std::fmin(kappa * nodes_.area[i], bearable * most);
        damping_[i] = std::fmin(stiffness_[i] * law.damping, share * kDampingShare * most / dt);
    }
    look_again_in_ = 0;
}

void NodeContact::keep() {
    kept_.anchor = anchor_;
    kept_.entered = entered_;
    kept_.anchored = anchored_;
    kept_.overlap = overlap_;
    kept_.bearing = bearing_;
    kept_.softening = softening_;
    samples_.keep();
    poles_.keep();
}

void NodeContact::take_back() noexcept {
    anchor_.swap(kept_.anchor);
    entered_.swap(kept_.entered);
    anchored_.swap(kept_.anchored);
    overlap_.swap(kept_.overlap);
    bearing_ = kept_.bearing;
    softening_ = kept_.softening;
    samples_.take_back();
    poles_.take_back();
}

void NodeContact::prepare_points() {
    is_prepared_ = true;
    recess_.clear();
    const bool ball = shape_.kind == ShapeKind::sphere;
    // A board thinner than an element could be pierced by a bulge, which has no memory of its side.
    const bool flat =
        shape_.kind == ShapeKind::plane || shape_.kind == ShapeKind::convex ||
        (shape_.kind == ShapeKind::box && 2 * shape_.size.minCoeff() > nodes_.mean_edge);
    if (!bears_by_point(nodes_, law_) || !(ball || flat))
        return;
    const double curvature = ball ? 1 / shape_.size.x() : 0;
    for (std::size_t i = 0; i < nodes_.node.size(); ++i) {
        const int node = nodes_.node[i];
        const int triangle = nodes_.fan(node)[0];
        const auto& corner = nodes_.triangle[index(triangle)];
        Vec3 weight = Vec3::Zero();
        weight[std::find(corner.begin(), corner.end(), node) - corner.begin()] = 1;
        const bool point = ball || nodes_.elastic.bulges(i);
        recess_.push_back(
            point ? point_spring(nodes_, triangle, weight, curvature, law_.rigid_compliance)
                        .end_depth()
                  : 0);
    }
}

void NodeContact::find_candidates(const NodeArray& position, const NodeArray& velocity,
                                  const RigidMotion& motion) noexcept {
    const Pose pose = shape_.pose.in(motion.pose);
    const double reach = kReach * nodes_.mean_edge;
    double nearest = std::numeric_limits<double>::infinity(); // of those left out
    double closest = nearest;                                 // of all
    double fastest2 = 0;
    candidate_.clear();
    for (std::size_t i = 0; i < nodes_.node.size(); ++i) {
        const auto x = position[index(nodes_.node[i])];
        const Vec3 slip = velocity[index(nodes_.node[i])] - motion.velocity_at(x);
        fastest2 = std::fmax(fastest2, slip.squaredNorm());
        const double distance = shape_.distance(pose.to_local(x)).distance;
        closest = std::fmin(closest, distance);
        if (distance < reach)
            candidate_.push_back(static_cast<int>(i));
        else
            nearest = std::fmin(nearest, distance);
    }
    // A triangle within reach of a sample has a corner not farther than an edge more.
    if (closest < reach + 2 * nodes_.mean_edge)
        samples_.look(position, pose, reach);
    else
        samples_.look_away();
    if (!recess_.empty() && shape_.kind != ShapeKind::sphere)
        poles_.look(candidate_, position, pose);
    // Samples lie within size of the shape's middle; rotation may move them faster than any node
    // sees.
    const double span =
        shape_.kind == ShapeKind::convex ? samples_.reach() : shape_.size.norm() + shape_.size.x();
    schedule_look(nearest, std::sqrt(fastest2) + motion.spin.norm() * span);
}

void NodeContact::schedule_look(double nearest, double fastest) noexcept {
    look_again_in_ = nearest / (kHaste * fastest + std::sqrt(kAcceleration * nearest / 2));
}

void NodeContact::probe_candidates(const NodeArray& position, const NodeArray& velocity,
                                   const RigidMotion& motion) noexcept {
    const Pose pose = shape_.pose.in(motion.pose);
    double fastest2 = 0;
    candidate_.clear();
    planes_.clear();
    for (std::size_t i = 0; i < nodes_.node.size(); ++i) {
        const auto x = position[index(nodes_.node[i])];
        const Vec3 slip = velocity[index(nodes_.node[i])] - motion.velocity_at(x);
        fastest2 = std::fmax(fastest2, slip.squaredNorm());
        // A node that is in is looked at from outside, where ODE's answers are good.
        const Vec3 lift = anchored_[i] ? Vec3(0.5 * probe_->radius() * entered_[i]) : Vec3::Zero();
        Planes planes;
        planes.count = probe_->feel(shape_.probe, pose.to_local(x) + lift, planes.plane);
        if (planes.count == 0 &&
            !anchored_[i]) { // may be in already: ask from within the soft body
            const Vec3 inward = pose.rotation.transpose() * inward_at(nodes_, position, i);
            planes.count = probe_->feel(
                shape_.probe, pose.to_local(x) + 0.5 * probe_->radius() * inward, planes.plane);
        }
        if (planes.count == 0) {
            anchored_[i] = 0;
            continue;
        }
        candidate_.push_back(static_cast<int>(i));
        planes_.push_back(planes);
    }
    schedule_look(probe_->radius(), std::sqrt(fastest2));
}

ContactTally NodeContact::add_force(const NodeArray& position, const NodeArray& velocity,
                                    RigidShadow& rigid, double dt,
                                    const NodeForces& force) noexcept {
    ContactTally tally;
    if (look_again_in_ <= 0) {
        if (shape_.kind == ShapeKind::probed)
            probe_candidates(position, velocity, rigid.motion());
        else
            find_candidates(position, velocity, rigid.motion());
        tally.tests += nodes_.node.size();
    }
    look_again_in_ -= dt;
    touch_.clear();
    bearing_ = 0;
    softening_ = 1;
    double load = 0;
    if (shape_.kind == ShapeKind::probed)
        load = find_touching_planes(position, velocity, rigid, dt);
    else if (!candidate_.empty())
        load = with_distance(shape_.kind, [&](auto distance_of) {
            return find_touching(distance_of, position, velocity, rigid, dt);
        });
    tally.tests += candidate_.size();
    if (samples_.is_near())
        load += samples_.find_touching(position, velocity, rigid, shape_.pose, dt, tally.tests);
    if (poles_.is_near())
        load += poles_.find_touching(position, velocity, rigid, dt, tally.tests);
    if (!touch_.empty() || samples_.is_touching() || poles_.is_touching()) {
        softening_ = rigid.soften(load);
        push(position, velocity, rigid, dt, force);
        bearing_ += samples_.push(velocity, inverse_mass_, softening_, dt, rigid, force);
        bearing_ += poles_.push(velocity, inverse_mass_, softening_, dt, rigid, force);
    }
    tally.bearing = bearing_;
    return tally;
}

template <class Distance>
double NodeContact::find_touching(Distance distance_of, const NodeArray& position,
                                  const NodeArray& velocity, const RigidShadow& rigid,
                                  double dt) noexcept {
    const RigidMotion& motion = rigid.motion();
    const Pose pose = shape_.pose.in(motion.pose);
    double load = 0;
    for (const int i : candidate_) {
        const std::size_t n = index(nodes_.node[index(i)]);
        const Vec3 x = position[n];
        const Vec3 local = pose.to_local(x);
        SurfaceDistance gap = distance_of(shape_, local);
        if (!recess_.empty())
            gap.distance += recess_[index(i)];
        Vec3& entered = entered_[index(i)];
        if (anchored_[index(i)] && gap.normal.dot(entered) < 0)
            gap = {entered.dot(local) - shape_.support(entered), entered};
        if (gap.distance < 0) {
            const Vec3 in = -(pose.rotation * gap.normal);
            gap.distance += overlap_[index(i)].hidden(
                -gap.distance, (velocity[n] - motion.velocity_at(x)).dot(in), dt);
        } else
            overlap_[index(i)].hidden(0, 0, dt);
        if (gap.distance >= 0) {
            anchored_[index(i)] = 0;
            const double way = kForesight * dt * (velocity[n] - motion.velocity_at(x)).norm();
            if (gap.distance >= way)
                continue;
        }
        entered = gap.normal;
        const Vec3 normal = pose.rotation * gap.normal;
        load +=
            (stiffness_[index(i)] * dt + 2 * damping_[index(i)]) * dt * rigid.compliance(x, normal);
        touch_.push_back({i, local, gap.normal, normal, -gap.distance});
    }
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
        const double way = kForesight * dt * (velocity[n] - motion.velocity_at(x)).norm();
        const Planes& planes = planes_[c];
        double deepest = 0;
        for (int k = 0; k < planes.count; ++k) {
            const TangentPlane& plane = planes.plane[index(k)];
            const double depth = plane.offset - plane.normal.dot(local);
            if (depth <= -way)
                continue;
            const Vec3 normal = pose.rotation * plane.normal;
            load += (stiffness_[i] * dt + 2 * damping_[i]) * dt * rigid.compliance(x, normal);
            touch_.push_back({candidate_[c], local, plane.normal, normal, depth});
            if (depth > deepest)
                entered_[i] = plane.normal;
            deepest = std::fmax(deepest, depth);
        }
        if (deepest == 0)
            anchored_[i] = 0;
    }
    return load;
}

void NodeContact::push(const NodeArray& position, const NodeArray& velocity, RigidShadow& rigid,
                       double dt, const NodeForces& force) noexcept {
    const RigidMotion& motion = rigid.motion();
    const Pose pose = shape_.pose.in(motion.pose);
    for (const Touch& touch : touch_) {
        const std::size_t i = index(touch.node);
        const std::size_t n = index(nodes_.node[i]);
        const Vec3 x = position[n];
        const Vec3 slip = velocity[n] - motion.velocity_at(x);
        const double k = softening_ * stiffness_[i];
        const double c = softening_ * damping_[i];
        const double parting = slip.dot(touch.normal);
        const double lightness = inverse_mass_[n];
        const Vec3 ahead = velocity[n] + dt * lightness * force[n] - rigid.velocity_ahead(x, dt);
        const double press =
            NormalContact{.stiffness = k,
                          .damping = c,
                          .compliance = lightness + rigid.compliance(x, touch.normal),
                          .depth = touch.depth,
                          .speed = -parting,
                          .ahead = -ahead.dot(touch.normal)}
                .press(dt);
        if (press == 0)
            continue;
        ++bearing_;
        if (!anchored_[i]) {
            anchored_[i] = 1;
            anchor_[i] = touch.local;
        }
        const double grip = law_.friction * press;
        Vec3 stretch = touch.local - anchor_[i];
        stretch -= touch.across.dot(stretch) * touch.across;
        if (clamp_length(stretch, grip / (kTangential * k)))
            anchor_[i] = touch.local - stretch;
        Vec3 f = pose.rotation * (-kTangential * k * stretch) -
                 kTangential * c * (slip - parting * touch.normal);
        clamp_length(f, grip);
        f += press * touch.normal;

        force.add(n, f);
        rigid.add({-f, -(x - motion.pose.position).cross(f)});
    }
}

} // namespace ode::soft
