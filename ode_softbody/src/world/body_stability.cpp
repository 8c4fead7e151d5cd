// How a body is watched while it is stepped, and what is done when it goes unstable.
#include "base/error.h"
#include "integrate/critical_step.h"
#include "world/body.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode::soft {
namespace {

// Stretch raises the largest frequency of a St. Venant-Kirchhoff solid about in proportion. The
// substep follows in rungs, and patiently on the way back, because every change costs two forces.
constexpr double kRung = 1.25;
constexpr double kSlack = 0.25; ///< of a rung: 0.9 * 1.25^0.25 < 0.96 of the critical step
constexpr double kMarginLimit = 10;
constexpr int kPatience = 100; ///< steps

// Principal stretch beyond which no explicit step chosen at rest is stable for any material here.
constexpr double kStretchLimit = 10;

// What a substep is shortened to at most, in halves, before the body is given up.
constexpr double kMostCaution = 16;

/// @param stretch  after a failed attempt maybe not a number.
double rung_above(double stretch) noexcept {
    const double wanted = stretch < kMarginLimit ? std::max(1.0, stretch) : kMarginLimit;
    return std::pow(kRung, std::max(0.0, std::ceil(std::log(wanted) / std::log(kRung) - kSlack)));
}

} // namespace

void Body::reset_watch(const std::string& law, double frequency) noexcept {
    largest_frequency_ = frequency;
    budget_ = {};
    contacts_ = ContactShare(mass().size());
    frame_velocity_.setZero();
    total_load_.setZero();
    elastic_noise_ = 0;
    if (law != "stable-neo-hookean")
        return;
    // Its energy at rest is a difference of numbers of the size of E V, other laws' a square.
    for (const Solid& s : solids_)
        elastic_noise_ = std::max(elastic_noise_, 8 * std::numeric_limits<double>::epsilon() *
                                                      s.young * total_mass_ / s.density);
}

void Body::begin_step(const Vec3& gravity) noexcept {
    stepped_ = true;
    choose_tier();
    in_budget_ = true;
    failed_solve_ = false;
    extremes_ = {};
    checkpoint_.quiet = quiet_;
    if (modes_) {
        begin_ringing_step(gravity);
        return;
    }
    if (damped_by_modes_ && modes_stale_)
        find_damped_modes();
    checkpoint_.state = state_;
    checkpoint_.last_dt = last_dt_;
    checkpoint_.undamped = undamped_;
    checkpoint_.modal_pending = modal_damping_ ? modal_damping_->pending() : 0;
    checkpoint_.budget = budget_;
    take_load(gravity);
}

void Body::roll_back() noexcept {
    quiet_ = checkpoint_.quiet;
    contacts_.clear();
    if (modes_) {
        modes_->take_back();
        return;
    }
    std::swap(state_, checkpoint_.state);
    last_dt_ = checkpoint_.last_dt;
    undamped_ = checkpoint_.undamped;
    if (modal_damping_)
        modal_damping_->set_pending(checkpoint_.modal_pending);
    budget_ = checkpoint_.budget;
}

double Body::safe_substep() const noexcept {
    if (modes_)
        return modes_->pace();
    double dt = substep_;
    if (is_explicit_ && margin_ > 1)
        dt = std::min(dt, kSubstepSafety * longest_substep_ / margin_);
    return dt / caution_;
}

double Body::moving_energy(const MotionSums& sum) const noexcept {
    return is_free() ? sum.kinetic - sum.momentum.squaredNorm() / (2 * total_mass_) : sum.kinetic;
}

double Body::load_seen(const MotionSums& sum) const noexcept {
    return is_free() ? sum.load - total_load_.dot(sum.moment) / total_mass_ : sum.load;
}

double Body::load_now() const noexcept {
    MotionSums sum;
    add_load_sums(mass(), state_.position, load_, sum);
    return load_seen(sum);
}

double Body::nailed_energy() const noexcept {
    double sum = 0;
    for (const int node : nailed_) {
        const auto i = static_cast<std::size_t>(node);
        sum += mass()[i] * state_.velocity[i].squaredNorm() / 2;
    }
    return sum;
}

// Half of what changes kinetic energy where the velocity lags, else force times displacement.
double Body::contact_work(double dt) const noexcept {
    double work = 0;
    contacts_.each([&](std::size_t n, const auto& f) {
        work += lags_ ? dt / 2 * f.dot(state_.velocity[n]) : -f.dot(state_.position[n]);
    });
    return work;
}

void Body::book_contacts(double before, double dt) noexcept {
    Vec3 push = Vec3::Zero();
    if (!contacts_.empty()) {
        double after = contact_work(dt);
        contacts_.each([&](std::size_t, const auto& f) { push += f; });
        budget_.add_work(lags_ ? before + after : before - after);
    }
    if (!is_free())
        return;
    const Vec3 gained = dt / total_mass_ * (push + total_load_);
    budget_.add_work(-dt * push.dot(frame_velocity_ + gained / 2));
    frame_velocity_ += gained;
}

void Body::book_lag(double dt) noexcept {
    double power = 0;
    contacts_.each([&](std::size_t n, const auto& f) {
        power += f.dot(state_.velocity[n] - frame_velocity_);
    });
    budget_.add_past_work(-(last_dt_ - dt) / 2 * power);
}

void Body::finish_look(double dt) noexcept {
    const double before = moving_energy(before_);
    const double after = moving_energy(kinetic_sums(mass(), state_.velocity));
    // Where the velocity lags, the mean is that of the positions' time.
    const double energy = elastic_ + (lags_ ? (before + after) / 2 : before);
    const double load = load_seen(before_);
    budget_.add_past_work(load - load_at_look_);
    load_at_look_ = load;
    if (lags_)
        swing_ = EnergyBudget::swing(dt * extremes_.max_stretch / critical_step_);
    // The energy of flight is a difference of large numbers.
    constexpr double kCancelled = 1e-13;
    double noise = noise_ + kCancelled * before_.kinetic;
    // A force of the application's that has just begun has moved nothing yet, and yet the velocity
    // of half a substep ahead has it: energy h^2 f^2 / (4 m) where no work has been done.
    for (std::size_t i = 0; has_external_ && i < load_.size(); ++i)
        noise += dt * dt / 2 * inverse_mass_[i] * load_[i].squaredNorm();
    // What the substep ends with must not wait for the next, which may be that of another step.
    in_budget_ = budget_.look(energy, lags_ ? 0.5 : 0, swing_, noise) &&
                 budget_.allows(after, EnergyBudget::kMost, noise);
}

bool Body::is_sound() const noexcept {
    return in_budget_ && !failed_solve_ && extremes_.max_stretch < kStretchLimit;
}

std::string Body::trouble() const {
    if (failed_solve_)
        return format("its integrator found no solution at a substep of %g s", last_dt_);
    if (!in_budget_)
        return format("it holds %.3g J where %.3g J are due, at a substep of %g s",
                      budget_.energy(), budget_.budget(), last_dt_);
    return format("it is stretched %.3g times, at a substep of %g s", extremes_.max_stretch,
                  last_dt_);
}

bool Body::take_care() noexcept {
    ++rollbacks_;
    quiet_steps_ = 0;
    given_up_ = critical_step_ == 0 || caution_ >= kMostCaution || modes_;
    if (!given_up_)
        caution_ *= 2;
    return !given_up_;
}

bool Body::adapt_margin() noexcept {
    if (!is_explicit_ || modes_)
        return false; // stretch takes nothing from its stability
    const double wanted = rung_above(extremes_.max_stretch);
    if (wanted <= margin_)
        return false;
    const double before = safe_substep();
    margin_ = wanted;
    calm_steps_ = 0;
    return safe_substep() < before;
}

void Body::relax_margin() noexcept {
    const double wanted = rung_above(extremes_.max_stretch);
    calm_steps_ = wanted < margin_ ? calm_steps_ + 1 : 0;
    if (calm_steps_ > kPatience) {
        margin_ = wanted;
        calm_steps_ = 0;
    }
    // The more often it went wrong, the longer nothing is risked.
    quiet_steps_ = caution_ > 1 ? quiet_steps_ + 1 : 0;
    if (quiet_steps_ > kPatience * rollbacks_) {
        caution_ /= 2;
        quiet_steps_ = 0;
    }
}

void Body::watch_inversion() noexcept {
    const bool now = !(extremes_.min_jacobian > 0);
    if (now && !inverted_)
        report(format("an element of a soft body of %zu nodes is turned inside out (volume ratio "
                      "%.3g); under stable-neo-Hookean it finds back",
                      mass().size(), extremes_.min_jacobian));
    inverted_ = now;
}

void Body::stop() noexcept {
    leave_modes();
    stopped_ = true;
    bearing_points_ = 0;
    state_.velocity.set_zero();
    moved();
}

} // namespace ode::soft
