#include "couple/soft_contact.h"

#include "couple/surface_drift.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode::soft {
namespace {

constexpr int kSweeps = 2; // sixteen keep energy no better
// As far as points may move on the faces before the next look, in mean edges.
constexpr double kSlack = 0.2;
// Speeds may grow till the next look as in NodeContact.
constexpr double kHaste = 4;
constexpr double kAcceleration = 1000; ///< [m/s^2]

} // namespace

SoftContact::SoftContact(SoftSurface& a, SoftSurface& b)
    : a_(a), b_(b), points_of_a_(a, b, &a == &b) {
    if (!is_self())
        points_of_b_.emplace(b, a, false);
}

void SoftContact::begin_step(const SoftPartner& a, const SoftPartner& b) noexcept {
    points_of_a_.begin_step(make_pair_law(a, b));
    if (points_of_b_)
        points_of_b_->begin_step(make_pair_law(b, a));
    look_again_in_ = 0;
}

void SoftContact::keep() {
    points_of_a_.keep();
    if (points_of_b_)
        points_of_b_->keep();
    kept_dt_ = last_dt_;
}

void SoftContact::take_back() noexcept {
    points_of_a_.take_back();
    if (points_of_b_)
        points_of_b_->take_back();
    last_dt_ = kept_dt_;
}

void SoftContact::schedule(double budget) noexcept {
    rate_ = kHaste * fastest_ + std::sqrt(kAcceleration * budget / 2);
    look_again_in_ = budget / rate_;
}

void SoftContact::look_away(double nearest) noexcept {
    points_of_a_.look_away();
    if (points_of_b_)
        points_of_b_->look_away();
    schedule(nearest);
}

void SoftContact::look(const SoftSide& a, const SoftSide& b, double dt, unsigned long when,
                       SoftContactTally& tally) {
    const double edge = std::fmin(a_.nodes().mean_edge, b_.nodes().mean_edge);
    const double slack = kSlack * edge;
    ++tally.looks;
    way_ = 0;
    if (is_self()) {
        const Deformation change = deformation_of(a_, a.position, a.velocity);
        fastest_ = 2 * change.speed;
        // What may touch is an edge apart at rest.
        const double apart = edge - 2 * change.displacement;
        if (apart > slack)
            return look_away(apart);
    } else {
        fastest_ = fastest_between(a_.nodes(), a.velocity, b_.nodes(), b.velocity);
    }
    const double ahead = kForesight * dt * fastest_;
    // On itself, no farther than neighbours may come by strain.
    const double reach =
        is_self() ? std::fmin(edge / 2, std::fmax(slack, ahead)) : std::fmax(slack, ahead);
    a_.refit(a.position, when);
    if (!is_self()) {
        b_.refit(b.position, when);
        const double apart = std::sqrt(a_.tree().bounds().distance2(b_.tree().bounds()));
        if (apart > reach)
            return look_away(apart);
    }
    double nearest = points_of_a_.look(a, b, reach, slack, tally.tests);
    if (points_of_b_)
        nearest = std::fmin(nearest, points_of_b_->look(b, a, reach, slack, tally.tests));
    schedule(is_near() ? slack : std::fmax(slack, nearest));
}

SoftContactTally SoftContact::add_force(const SoftSide& a, const SoftSide& b, double dt,
                                        unsigned long when) {
    SoftContactTally tally;
    points_of_a_.settle(a, b, last_dt_);
    if (points_of_b_)
        points_of_b_->settle(b, a, last_dt_);
    last_dt_ = dt;
    if (look_again_in_ <= 0)
        look(a, b, dt, when, tally);
    look_again_in_ -= dt;
    if (!is_near())
        return tally;
    points_of_a_.find_touching(a, b, way_, dt, tally.tests);
    if (points_of_b_)
        points_of_b_->find_touching(b, a, way_, dt, tally.tests);
    points_of_a_.prepare(a, b);
    if (points_of_b_)
        points_of_b_->prepare(b, a);
    for (int i = 0; i < kSweeps; ++i) {
        points_of_a_.sweep(a, b, dt);
        if (points_of_b_)
            points_of_b_->sweep(b, a, dt);
    }
    tally.bearing = points_of_a_.drag(a, b, dt);
    if (points_of_b_)
        tally.bearing += points_of_b_->drag(b, a, dt);
    way_ += rate_ * dt;
    return tally;
}

} // namespace ode::soft
