#include "couple/volume_contact.h"

#include "couple/surface_drift.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

constexpr int kSweeps = 2;
// As SoftContact's: way between looks in mean edges, and what speeds may grow to meanwhile.
constexpr double kSlack = 0.2;
constexpr double kHaste = 4;
constexpr double kAcceleration = 1000; ///< [m/s^2]

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

double volume_of(const Tet& t) noexcept {
    return (t[1] - t[0]).cross(t[2] - t[0]).dot(t[3] - t[0]) / 6;
}

/// Barycentric weights of a point.
std::array<double, 4> weights_of(const Tet& t, const Vec3& x) noexcept {
    Mat3 edges;
    edges << t[1] - t[0], t[2] - t[0], t[3] - t[0];
    const Vec3 w = edges.inverse() * (x - t[0]);
    return {1 - w.sum(), w[0], w[1], w[2]};
}

double mean_triangle(const SurfaceNodes& nodes) noexcept {
    double area = 0;
    for (const double a : nodes.area)
        area += a;
    return area / static_cast<double>(nodes.triangle.size());
}

} // namespace

VolumeContact::VolumeContact(SoftVolume& a, SoftVolume& b) : a_(a), b_(b) {}

template <class Visit>
void VolumeContact::each_corner(const Touch& touch, const SoftSide& a, const SoftSide& b,
                                Visit visit) const noexcept {
    const Near& near = near_[touch.near];
    for (std::size_t i = 0; i < 4; ++i)
        visit(a, index(a_.corner(near.first)[i]), touch.shape.gradient[0][i]);
    for (std::size_t i = 0; i < 4; ++i)
        visit(b, index(b_.corner(near.second)[i]), touch.shape.gradient[1][i]);
}

void VolumeContact::begin_step(const SoftPartner& a, const SoftPartner& b) noexcept {
    law_ = make_pair_law(a, b);
    softest_ = std::fmin(law_.bearable_point, law_.bearable_face);
    softest_damping_ = std::fmin(law_.bearable_point_damping, law_.bearable_face_damping);
    // Two faces of a triangle's area that lie d deep in each other bear kappa (A d) A: as much as
    // the penalty by depth, k A d.
    kappa_ = law_.stiffness /
             std::fmin(mean_triangle(a.surface.nodes()), mean_triangle(b.surface.nodes()));
    look_again_in_ = 0;
}

void VolumeContact::schedule(double budget) noexcept {
    rate_ = kHaste * fastest_ + std::sqrt(kAcceleration * budget / 2);
    look_again_in_ = budget / rate_;
}

void VolumeContact::look(const SoftSide& a, const SoftSide& b, double dt, unsigned long when,
                         SoftContactTally& tally) {
    const SurfaceNodes& nodes_a = a_.surface().nodes();
    const SurfaceNodes& nodes_b = b_.surface().nodes();
    const double slack = kSlack * std::fmin(nodes_a.mean_edge, nodes_b.mean_edge);
    ++tally.looks;
    way_ = 0;
    fresh_.clear();
    double nearest = HUGE_VAL;
    double apart = 0;
    if (is_self()) {
        const Deformation change = deformation_of(a_.surface(), a.position, a.velocity);
        fastest_ = 2 * change.speed;
        apart = nodes_a.mean_edge - 2 * change.displacement; // what may touch, at rest
    } else {
        fastest_ = fastest_between(nodes_a, a.velocity, nodes_b, b.velocity);
    }
    const double reach = std::fmax(slack, kForesight * dt * fastest_);
    if (apart <= slack) {
        a_.refit(a.position, when);
        b_.refit(b.position, when);
        apart = is_self() ? 0 : std::sqrt(a_.tree().bounds().distance2(b_.tree().bounds()));
    }
    if (apart > reach) {
        nearest = apart;
    } else {
        for (int t = 0; t < a_.size(); ++t) {
            const double beyond = b_.tree().near(a_.box(t, a.position), reach, [&](int u) {
                ++tally.tests;
                if (!is_self() || (t < u && !a_.are_neighbours(t, u)))
                    fresh_.push_back({.first = t, .second = u});
            });
            nearest = std::fmin(nearest, beyond);
        }
        std::sort(fresh_.begin(), fresh_.end(),
                  [](const Near& x, const Near& y) { return x.before(y); });
    }
    keep_memory();
    schedule(near_.empty() ? std::fmax(slack, nearest) : slack);
}

void VolumeContact::keep_memory() {
    auto old = near_.begin();
    for (Near& near : fresh_) {
        while (old != near_.end() && old->before(near))
            ++old;
        if (old != near_.end() && !near.before(*old))
            near = *old;
        near.wake = 0;
    }
    std::swap(near_, fresh_);
    touch_.clear();
}

void VolumeContact::settle(const SoftSide& a, const SoftSide& b) noexcept {
    for (const Touch& touch : touch_) {
        double rate = 0;
        each_corner(touch, a, b, [&](const SoftSide& side, std::size_t n, const Vec3& gradient) {
            rate += gradient.dot(side.velocity[n]);
        });
        Near& near = near_[touch.near];
        near.paid = std::fmax(0, near.paid + touch.spring * last_dt_ * (rate + touch.rate) / 2);
    }
}

void VolumeContact::find_touching(const SoftSide& a, const SoftSide& b, double dt,
                                  SoftContactTally& tally) {
    touch_.clear();
    for (std::size_t i = 0; i < near_.size(); ++i) {
        Near& near = near_[i];
        if (way_ < near.wake)
            continue;
        Touch touch{};
        touch.near = i;
        ++tally.tests;
        const Tet first = a_.at(near.first, a.position);
        const Tet second = b_.at(near.second, b.position);
        if (!overlap_of(first, second, touch.shape) || !(volume_of(first) > 0) ||
            !(volume_of(second) > 0)) {
            near = {.first = near.first, .second = near.second};
            near.wake = way_ + face_gap(first, second);
            continue;
        }
        each_corner(touch, a, b, [&](const SoftSide& side, std::size_t n, const Vec3& gradient) {
            touch.rate += gradient.dot(side.velocity[n]);
            touch.compliance += side.inverse_mass[n] * gradient.squaredNorm();
        });
        if (!(touch.compliance > 0)) // held on both sides, or wholly inside
            continue;
        touch.volume = touch.shape.volume - near.overlap.hidden(touch.shape.volume, touch.rate, dt);
        const double k = std::fmin(kappa_, law_.hardness * softest_ / touch.compliance);
        near.stiffness = near.bears ? std::fmin(near.stiffness, k) : k;
        touch.damping =
            std::fmin(near.stiffness * law_.damping, softest_damping_ / touch.compliance);
        touch_.push_back(touch);
    }
}

void VolumeContact::sweep(const SoftSide& a, const SoftSide& b, double dt) noexcept {
    for (Touch& touch : touch_) {
        const Near& near = near_[touch.near];
        double gain = 0;
        each_corner(touch, a, b, [&](const SoftSide& side, std::size_t n, const Vec3& gradient) {
            gain += side.inverse_mass[n] * gradient.dot(side.force[n]);
        });
        const double others = gain + touch.compliance * touch.press;
        const double before = touch.volume - dt * touch.rate;
        const double free = touch.volume + dt * (touch.rate + dt * others);
        const double g = dt * dt * touch.compliance;
        double spring = conserving_press(near.stiffness, g, before, free);
        // The work of the substep, spring (free - g spring - before) / 2, leaves paid >= 0.
        const double back = before - free;
        spring = std::fmin(spring, (std::sqrt(back * back + 8 * g * near.paid) - back) / (2 * g));
        touch.spring = spring;
        double press = 0;
        if (spring > 0) {
            const double c = touch.damping;
            const double mean_rate = (free - g * spring - before) / (2 * dt);
            press = std::fmax(0, spring + c * mean_rate / (1 + dt * touch.compliance * c / 2));
        }
        const double more = press - touch.press;
        touch.press = press;
        if (more != 0)
            each_corner(touch, a, b,
                        [&](const SoftSide& side, std::size_t n, const Vec3& gradient) {
                            side.force.add(n, -more * gradient);
                        });
    }
}

std::size_t VolumeContact::drag(const SoftSide& a, const SoftSide& b, double dt) noexcept {
    std::size_t bearing = 0;
    for (const Touch& touch : touch_) {
        if (touch.press == 0)
            continue;
        ++bearing;
        Near& near = near_[touch.near];
        near.bears = true;
        const Tet& on_a = touch.shape.gradient[0];
        const Vec3 area = on_a[0] + on_a[1] + on_a[2] + on_a[3]; // of a inside b, outward
        const double size = area.norm();
        if (law_.friction == 0 || !(size > 0))
            continue;
        const Vec3 normal = area / size;
        const auto& nodes_a = a_.corner(near.first);
        const auto& nodes_b = b_.corner(near.second);
        const auto weight_a = weights_of(a_.at(near.first, a.position), touch.shape.center);
        const auto weight_b = weights_of(b_.at(near.second, b.position), touch.shape.center);
        Vec3 slip = Vec3::Zero();
        double compliance = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            slip += weight_a[i] * a.velocity[index(nodes_a[i])];
            slip -= weight_b[i] * b.velocity[index(nodes_b[i])];
            compliance += weight_a[i] * weight_a[i] * a.inverse_mass[index(nodes_a[i])] +
                          weight_b[i] * weight_b[i] * b.inverse_mass[index(nodes_b[i])];
        }
        const double k =
            kTangential * std::fmin(near.stiffness * size * size, softest_ / compliance);
        const Vec3 across = slip - slip.dot(normal) * normal;
        const double most = law_.friction * touch.press * size;
        near.stretch += dt * across;
        near.stretch -= normal.dot(near.stretch) * normal;
        clamp_length(near.stretch, most / k);
        Vec3 f =
            -k * near.stretch - std::fmin(k * law_.damping, softest_damping_ / compliance) * across;
        clamp_length(f, most);
        for (std::size_t i = 0; i < 4; ++i) {
            a.force.add(index(nodes_a[i]), weight_a[i] * f);
            b.force.add(index(nodes_b[i]), -weight_b[i] * f);
        }
    }
    return bearing;
}

SoftContactTally VolumeContact::add_force(const SoftSide& a, const SoftSide& b, double dt,
                                          unsigned long when) {
    SoftContactTally tally;
    settle(a, b);
    last_dt_ = dt;
    if (look_again_in_ <= 0)
        look(a, b, dt, when, tally);
    look_again_in_ -= dt;
    if (near_.empty())
        return tally;
    find_touching(a, b, dt, tally);
    for (int i = 0; i < kSweeps; ++i)
        sweep(a, b, dt);
    tally.bearing = drag(a, b, dt);
    way_ += rate_ * dt;
    return tally;
}

} // namespace ode::soft
