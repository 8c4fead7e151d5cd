#include "couple/pole_contact.h"

#include "couple/surface_elasticity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode::soft {
namespace {

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

} // namespace

double highest_point(const Vec3& a, const std::array<double, 3>& b, Vec3& w) noexcept {
    int top = 0;
    const double corner = a.maxCoeff(&top);
    w = Vec3::Unit(top);
    double best = corner;
    if (b[0] > 0 && b[1] > 0 && b[2] > 0) {
        // Inside, with w_0 = 1 - w_1 - w_2: both derivatives zero.
        const double mixed = b[1] + b[2] - b[0];
        const double first = a[1] - a[0] + b[2], second = a[2] - a[0] + b[1];
        const double determinant = 4 * b[1] * b[2] - mixed * mixed;
        const double w1 = (2 * b[1] * first - mixed * second) / determinant;
        const double w2 = (2 * b[2] * second - mixed * first) / determinant;
        if (w1 >= 0 && w2 >= 0 && w1 + w2 <= 1) {
            const Vec3 at(1 - w1 - w2, w1, w2);
            const double value = a.dot(at) + w1 * w2 * b[0] + w2 * at[0] * b[1] + at[0] * w1 * b[2];
            if (value > best) {
                w = at;
                best = value;
            }
        }
    }
    for (int i = 0; i < 3; ++i) {
        if (!(b[index(i)] > 0))
            continue;
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        const double t = (a[k] - a[j] + b[index(i)]) / (2 * b[index(i)]);
        if (!(t > 0 && t < 1))
            continue;
        const double value = a[j] + t * (a[k] - a[j]) + t * (1 - t) * b[index(i)];
        if (value > best) {
            best = value;
            w = (1 - t) * Vec3::Unit(j) + t * Vec3::Unit(k);
        }
    }
    return best;
}

void PoleContact::begin_step(const RigidShape& shape, const ContactLaw& law, double share,
                             double dt) {
    shape_ = &shape;
    law_ = law;
    share_ = share;
    dt_ = dt;
}

double PoleContact::depth_of(const NodeArray& position, const Pose& shape,
                             int node) const noexcept {
    return -shape_->distance(shape.to_local(position[index(node)])).distance;
}

void PoleContact::climb(Pole& pole, const NodeArray& position, const Pose& shape) const noexcept {
    double depth = depth_of(position, shape, pole.node);
    for (bool moved = true; moved;) {
        moved = false;
        for (const int t : surface_.fan(pole.node))
            for (const int n : surface_.triangle[index(t)]) {
                const double there = n == pole.node ? depth : depth_of(position, shape, n);
                if (there > depth) {
                    depth = there;
                    pole.node = n;
                    moved = true;
                }
            }
    }
}

void PoleContact::look(std::span<const int> candidate, const NodeArray& position,
                       const Pose& shape) noexcept {
    const SurfaceShape& smooth = surface_.shape;
    std::size_t kept = 0;
    const auto known = [&](int node) {
        return std::any_of(pole_.begin(), pole_.begin() + static_cast<std::ptrdiff_t>(kept),
                           [&](const Pole& pole) { return pole.node == node; });
    };
    for (std::size_t p = 0; p < pole_count_; ++p) { // poles that have met become one
        climb(pole_[p], position, shape);
        if (!known(pole_[p].node))
            pole_[kept++] = pole_[p];
    }
    pole_count_ = kept;
    int first = -1;
    double deepest = -std::numeric_limits<double>::infinity();
    for (const int i : candidate) {
        const double depth = depth_of(position, shape, surface_.node[index(i)]);
        if (smooth.bulges(index(i)) && depth > deepest) {
            deepest = depth;
            first = i;
        }
    }
    if (first < 0) {
        pole_count_ = 0;
        return;
    }
    for (const int i : candidate) {
        if (kept == kMostPoles)
            break;
        if (!smooth.bulges(index(i)))
            continue;
        const double turn = smooth.curvature[index(i)][0] * surface_.mean_edge;
        const Vec3 apart = smooth.normal[index(i)] - smooth.normal[index(first)];
        if (i != first && apart.squaredNorm() > turn * turn)
            continue;
        Pole pole;
        pole.node = surface_.node[index(i)];
        pole.is_barred = pole_count_ > 0; // beside others
        climb(pole, position, shape);
        if (pole.node == surface_.node[index(i)] && !known(pole.node))
            pole_[kept++] = pole;
    }
    pole_count_ = kept;
}

void PoleContact::find_deepest(Pole& pole, const NodeArray& position,
                               const Pose& shape) const noexcept {
    const PointElasticity& elastic = surface_.elastic;
    const double half = pole.state.bears ? pole.force / 2 : 0;
    double most = -std::numeric_limits<double>::infinity();
    for (const int t : surface_.fan(pole.node)) {
        const auto& corner = surface_.triangle[index(t)];
        Vec3 depth;
        for (int i = 0; i < 3; ++i)
            depth[i] = depth_of(position, shape, corner[index(i)]);
        const std::array<double, 3>& bulge = surface_.shape.bulge[index(t)];
        const std::array<double, 3> coupling = corner_coupling(surface_, t);
        Vec3 lifted = depth;
        std::array<double, 3> rise = bulge;
        for (int i = 0; i < 3; ++i) {
            const double own = elastic.compliance[index(elastic.place[index(corner[index(i)])])];
            lifted[i] += half * own;
            rise[index((i + 1) % 3)] -= half * own;
            rise[index((i + 2) % 3)] -= half * own;
            rise[index(i)] += half * 2 * coupling[index(i)];
        }
        Vec3 w;
        const double here = highest_point(lifted, rise, w);
        if (here <= most)
            continue;
        most = here;
        pole.touch.depth =
            depth.dot(w) + w[1] * w[2] * bulge[0] + w[2] * w[0] * bulge[1] + w[0] * w[1] * bulge[2];
        pole.touch.triangle = t;
        pole.weight = w;
    }
    place(pole, position);
}

void PoleContact::follow(Pole& pole, const NodeArray& position, const Pose& shape) const noexcept {
    const auto& corner = surface_.triangle[index(pole.touch.triangle)];
    const std::array<double, 3>& bulge = surface_.shape.bulge[index(pole.touch.triangle)];
    const Vec3& w = pole.weight;
    double depth = 0;
    for (int i = 0; i < 3; ++i)
        depth += w[i] * depth_of(position, shape, corner[index(i)]) +
                 w[(i + 1) % 3] * w[(i + 2) % 3] * bulge[index(i)];
    pole.touch.depth = depth;
    place(pole, position);
}

bool PoleContact::repeats_another(std::size_t p) const noexcept {
    return std::any_of(
        pole_.begin(), pole_.begin() + static_cast<std::ptrdiff_t>(p), [&](const Pole& other) {
            return (other.touch.at.point - pole_[p].touch.at.point).norm() < surface_.mean_edge;
        });
}

void PoleContact::bar(Pole& pole) noexcept {
    pole.is_barred = true;
    pole.held = pole.touches = false;
    pole.state = {};
}

void PoleContact::place(Pole& pole, const NodeArray& position) const noexcept {
    TrianglePoint& at = pole.touch.at;
    at.weight = pole.weight;
    at.point.setZero();
    const auto& corner = surface_.triangle[index(pole.touch.triangle)];
    for (int i = 0; i < 3; ++i)
        at.point += at.weight[i] * position[index(corner[index(i)])];
}

// Stress that answers to E + beta dE/dt answers, in contact that rolls at v, to the dent of beta
// later: all pressure is shifted ahead by beta v, and resists rolling by beta v F (as
// N. V. Brilliantov and T. Poeschel, Europhys. Lett. 42 (1998), doi:10.1209/epl/i1998-00281-7).
// That is for what the mesh doesn't yield by itself; its own part lags by itself.
void PoleContact::run_ahead(Pole& pole, const NodeArray& position, const Pose& shape,
                            double dt) const noexcept {
    const Vec3 now = shape.to_local(pole.touch.at.point);
    if (!pole.state.bears || pole.held)
        pole.trail = now;
    const auto& corner = surface_.triangle[index(pole.touch.triangle)];
    double relaxation = 0;
    double curvature = 0;
    for (int i = 0; i < 3; ++i) {
        const std::size_t n = index(surface_.elastic.place[index(corner[index(i)])]);
        relaxation += pole.weight[i] * surface_.elastic.relaxation[n];
        curvature += pole.weight[i] * surface_.shape.curvature[n][0];
    }
    const double depth = pole.touch.depth;
    const double lag = relaxation * pole.state.point.own_share(depth);
    // The trail follows within the time of lag, so that it is left behind by v times lag.
    pole.trail += std::fmin(1, dt / std::fmax(lag, dt)) * (now - pole.trail);
    Vec3 ahead = shape.rotation * (now - pole.trail);
    ahead -= pole.state.normal.dot(ahead) * pole.state.normal;
    clamp_length(ahead, std::sqrt(std::fmax(0.0, depth) / curvature));
    const Vec3 e1 = position[index(corner[1])] - position[index(corner[0])];
    const Vec3 e2 = position[index(corner[2])] - position[index(corner[0])];
    const Vec3 across = e1.cross(e2);
    const double scale = 1 / across.squaredNorm();
    const double w1 = scale * across.dot(ahead.cross(e2));
    const double w2 = scale * across.dot(e1.cross(ahead));
    pole.touch.at.weight += Vec3(-w1 - w2, w1, w2);
    pole.touch.at.point += w1 * e1 + w2 * e2;
}

double PoleContact::find_touching(const NodeArray& position, const NodeArray& velocity,
                                  const RigidShadow& rigid, double dt,
                                  unsigned long& tests) noexcept {
    const Pose shape = shape_->pose.in(rigid.motion().pose);
    double load = 0;
    touching_ = false;
    for (std::size_t p = 0; p < pole_count_; ++p) {
        Pole& pole = pole_[p];
        TouchState& state = pole.state;
        if (state.bears && pole.touch.depth > kHold * state.point.end_depth())
            pole.held = true;
        if (pole.held) {
            follow(pole, position, shape);
            pole.held = pole.touch.depth > 0;
            if (!pole.held)
                bar(pole);
        }
        if (!pole.held) {
            climb(pole, position, shape);
            find_deepest(pole, position, shape);
        }
        if (repeats_another(p)) {
            bar(pole);
            continue;
        }
        pole.is_barred &= pole.touch.depth > 0;
        pole.touches = false;
        if (pole.is_barred)
            continue;
        tests += surface_.fan(pole.node).size();
        const Vec3 inward = shape_->distance(shape.to_local(pole.touch.at.point)).normal;
        state.normal = -(shape.rotation * inward);
        run_ahead(pole, position, shape, dt);
        pole.touch.press = {};
        pole.touch.grip.setZero();
        pole.touch.slip = slip_at(pole.touch, surface_, velocity, rigid.motion());
        const Vec3& slip = pole.touch.slip;
        pole.touch.depth -= state.overlap.hidden(pole.touch.depth, -slip.dot(state.normal), dt);
        pole.touches = pole.touch.depth > -kForesight * dt * slip.norm();
        if (pole.touch.depth <= 0)
            state.bears = false;
        if (!pole.touches) {
            state.book.close();
            continue;
        }
        touching_ = true;
        const double light = share_ * surface_.lightest[index(pole.touch.triangle)];
        if (!state.bears) {
            state.stretch.setZero();
            state.stiffness = kStiffnessShare / (dt_ * dt_) * light;
        }
        // What the mesh yields there: the contact may roll on.
        state.is_point = true;
        state.point =
            point_spring(surface_, pole.touch.triangle, pole.weight, 0, law_.rigid_compliance);
        pole.touch.damping = std::fmin(state.stiffness * law_.damping, kDampingShare * light / dt_);
        if (law_.friction > 0)
            load += grip_load(pole.touch, state, dt, rigid);
        if (rigid.needs_books(dt))
            open_book(pole.touch, state, dt);
        pole.force = std::fmin(state.point.force(pole.touch.depth), state.point.end_force());
    }
    return load;
}

void PoleContact::sweep(const TouchForces& on, RigidResponse& rigid) noexcept {
    for (std::size_t p = 0; p < pole_count_; ++p)
        if (pole_[p].touches)
            sweep_triangle(pole_[p].touch, pole_[p].state, surface_, on, rigid);
}

void PoleContact::enter_books(const TouchForces& on, const RigidResponse& rigid) noexcept {
    for (std::size_t p = 0; p < pole_count_; ++p)
        if (pole_[p].touches)
            enter_book(pole_[p].touch, pole_[p].state, surface_, on, rigid);
}

std::size_t PoleContact::drag(double softening, const TouchForces& on,
                              RigidShadow& rigid) noexcept {
    std::size_t bearing = 0;
    for (std::size_t p = 0; p < pole_count_; ++p)
        if (pole_[p].touches)
            bearing += drag_triangle(pole_[p].touch, pole_[p].state, law_.friction, softening,
                                     surface_, on, rigid);
    return bearing;
}

} // namespace ode::soft
