#include "couple/node_contact.h"

#include "couple/surface_elasticity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode::soft {
namespace {

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

bool same_shape(const RigidShape& a, const RigidShape& b) noexcept {
    return a.kind == b.kind && a.size == b.size && a.body == b.body;
}

} // namespace

NodeContact::NodeContact(const SurfaceNodes& nodes, dGeomID geom)
    : nodes_(nodes), geom_(geom), stiffness_(nodes.node.size()), damping_(nodes.node.size()),
      anchor_(nodes.node.size(), Vec3::Zero()), anchored_(nodes.node.size(), 0),
      entered_(nodes.node.size(), Vec3::Zero()), overlap_(nodes.node.size()),
      book_(nodes.node.size()), samples_(nodes), poles_(nodes) {
    candidate_.reserve(nodes.node.size());
    wide_.reserve(nodes.node.size());
    approach_.reserve(nodes.node.size());
    seen_.reserve(nodes.node.size());
    touch_.reserve(nodes.node.size());
}

RigidShape NodeContact::known_shape(const RigidShape& shape) {
    RigidShape out = shape;
    if (corners_.empty() && shape.kind == ShapeKind::convex) {
        corners_ = convex_corners(shape.probe);
        faces_ = hull_faces(corners_);
    } else if (!probe_ && corners_.empty() && shape.kind == ShapeKind::probed) {
        if (dGeomGetClass(shape.probe) == dTriMeshClass) {
            ConvexMesh mesh = convex_mesh(shape.probe);
            corners_ = std::move(mesh.corner);
            faces_ = std::move(mesh.face);
        }
        if (corners_.empty())
            probe_ = std::make_unique<SurfaceProbe>(kReach * nodes_.mean_edge);
    }
    if (corners_.empty())
        return out;
    out.kind = ShapeKind::convex;
    out.corners = corners_;
    out.faces = faces_;
    return out;
}

void NodeContact::begin_step(const RigidShape& given, const ContactLaw& law,
                             std::span<const double> inverse_mass, double dt) {
    const RigidShape shape = known_shape(given);
    if (!same_shape(shape, shape_)) {
        changed_ = true;
        std::fill(anchored_.begin(), anchored_.end(), std::uint8_t{0});
        touch_.clear();
        samples_.forget();
        poles_.forget();
        is_prepared_ = false;
        std::fill(overlap_.begin(), overlap_.end(), Overlap{});
        std::fill(book_.begin(), book_.end(), EnergyBook{});
        softening_ = 1;
    }
    is_prepared_ &= law == law_;
    shape_ = shape;
    law_ = law;
    if (!is_prepared_)
        prepare_points();
    inverse_mass_ = inverse_mass;
    samples_.begin_step(shape_, law, dt);
    // Half is the samples'. A node may meet as many as three planes of a probed shape; since the
    // normal spring is stable at any stiffness, their friction alone counts: 3 * 0.7 * 0.4 = 0.84.
    const double share = shape.kind == ShapeKind::plane    ? 1
                         : shape.kind == ShapeKind::probed ? 0.4
                                                           : 0.5;
    poles_.begin_step(shape_, law, share, dt);
    if (shape.kind == ShapeKind::probed) {
        planes_.reserve(nodes_.node.size());
        touch_.reserve(SurfaceProbe::kMostPlanes * nodes_.node.size());
    }
    const double bearable = share * kStiffnessShare / (dt * dt); // [1/s^2]
    const double kappa = law.stiffness > 0 ? law.stiffness : bearable * nodes_.mass_per_area;
    for (std::size_t i = 0; i < stiffness_.size(); ++i) {
        const bool held = inverse_mass[index(nodes_.node[i])] == 0;
        const double most = held ? std::numeric_limits<double>::infinity() : nodes_.mass[i];
        stiffness_[i] = std::fmin(kappa * nodes_.area[i], bearable * most);
        if (!nodes_.residual.empty())
            stiffness_[i] /= 1 + stiffness_[i] * nodes_.residual[index(nodes_.node[i])];
        damping_[i] = std::fmin(stiffness_[i] * law.damping, share * kDampingShare * most / dt);
    }
    look_again_in_ = 0;
    look_wide_in_ = 0;
    quiet_in_ = free_in_ = 0;
}

void NodeContact::keep() {
    if (!changed_)
        return;
    changed_ = false;
    kept_.anchor = anchor_;
    kept_.entered = entered_;
    kept_.anchored = anchored_;
    kept_.overlap = overlap_;
    kept_.book = book_;
    kept_.bearing = bearing_;
    kept_.softening = softening_;
    samples_.keep();
    poles_.keep();
}

void NodeContact::take_back() noexcept {
    changed_ = true;
    anchor_.swap(kept_.anchor);
    entered_.swap(kept_.entered);
    anchored_.swap(kept_.anchored);
    overlap_.swap(kept_.overlap);
    book_.swap(kept_.book);
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
    std::size_t points = 0;
    std::size_t dented = 0;
    for (std::size_t i = 0; i < nodes_.node.size(); ++i) {
        recess_.push_back(0);
        if (!ball && !nodes_.shape.bulges(i))
            continue;
        const int node = nodes_.node[i];
        const int triangle = nodes_.fan(node)[0];
        const auto& corner = nodes_.triangle[index(triangle)];
        Vec3 weight = Vec3::Zero();
        weight[std::find(corner.begin(), corner.end(), node) - corner.begin()] = 1;
        const HertzSpring spring =
            point_spring(nodes_, triangle, weight, curvature, law_.rigid_compliance);
        recess_[i] = spring.end_depth();
        ++points;
        dented += spring.force(PoleContact::kHold * spring.end_depth()) < law_.weight;
    }
    // A body that would rest where the mesh is the spring stands on its nodes: a point that can't
    // follow the surface would be left, and what is in by then would be energy from nowhere.
    if (!ball && 2 * dented > points)
        recess_.clear();
}

unsigned long NodeContact::find(const NodeArray& position, const NodeArray& velocity,
                                RigidShadow& rigid, double dt) noexcept {
    unsigned long tests = candidate_.size();
    changed_ = true;
    if (is_look_due())
        tests = look(position, velocity, rigid);
    look_again_in_ -= dt;
    look_wide_in_ -= dt;
    quiet_in_ -= dt;
    free_in_ -= dt;
    wide_free_in_ -= dt;
    touch_.clear();
    bearing_ = 0;
    at_once_ = !rigid.can_move() && shape_.kind != ShapeKind::probed;
    backwards_ = !backwards_;
    double load = 0;
    if (shape_.kind == ShapeKind::probed)
        load = find_touching_planes(position, velocity, rigid, dt);
    else if (!at_once_)
        load = find_touching(position, velocity, rigid, dt);
    if (samples_.is_near())
        load += samples_.find_touching(position, velocity, rigid, shape_.pose, dt, tests);
    if (poles_.is_near())
        load += poles_.find_touching(position, velocity, rigid, dt, tests);
    softening_ = is_touching() ? rigid.soften(load) : 1;
    return tests;
}

unsigned long NodeContact::look(const NodeArray& position, const NodeArray& velocity,
                                const RigidShadow& rigid, RoughPlaces* rough) noexcept {
    quiet_in_ = free_in_ = 0;
    changed_ |= poles_.is_near() || samples_.exist() || shape_.kind == ShapeKind::probed;
    if (shape_.kind == ShapeKind::probed) {
        for (std::size_t i = 0; rough && i < nodes_.node.size(); ++i)
            rough->place(nodes_.node[i]);
        probe_candidates(position, velocity, rigid.motion());
    } else if (rough) {
        find_candidates(position, velocity, rigid, *rough);
    } else {
        find_candidates(position, velocity, rigid.motion());
    }
    changed_ |= !candidate_.empty();
    return candidate_.size() + nodes_.node.size();
}

void NodeContact::pass(double dt) noexcept {
    look_again_in_ -= dt;
    look_wide_in_ -= dt;
    quiet_in_ -= dt;
    free_in_ -= dt;
    wide_free_in_ -= dt;
    touch_.clear();
    at_once_ = false;
    changed_ |= softening_ != 1;
    softening_ = 1;
}

void NodeContact::collect_nodes(std::vector<int>& out) const {
    for (const int i : candidate_) {
        const int node = nodes_.node[index(i)];
        out.push_back(node);
        if (!has_pole(index(i)))
            continue;
        for (const int t : nodes_.fan(node))
            out.insert(out.end(), nodes_.triangle[index(t)].begin(),
                       nodes_.triangle[index(t)].end());
    }
    samples_.collect_nodes(out);
}

ContactTally NodeContact::add_force(const NodeArray& position, const NodeArray& velocity,
                                    RigidShadow& rigid, double dt,
                                    const NodeForces& force) noexcept {
    ContactTally tally;
    tally.tests = find(position, velocity, rigid, dt);
    if (!is_touching())
        return tally;
    const TouchForces on{inverse_mass_, velocity, force, dt};
    if (!rigid.can_move())
        push_at_once(position, on, rigid, nullptr);
    response_.begin(rigid, dt);
    const auto once = [&] {
        response_.open(rigid);
        sweep(on, response_);
        response_.close(rigid);
        return response_.moves() ? response_.change() : 0;
    };
    settle(once);
    tally.bearing = drag(on, rigid);
    if (!response_.moves())
        return tally;
    if (law_.friction > 0)
        settle(once);
    response_.end(rigid);
    enter_books(on, response_);
    return tally;
}

} // namespace ode::soft
