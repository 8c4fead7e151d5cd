#include "reduced/modal_motion.h"

#include "reduced/mode_rows.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode::soft {
namespace {

// Turned by no more at once: the midpoint rule then errs by a millionth of a turn a second.
constexpr double kTurn = 0.01; ///< [rad]
// Coupling of two modes below this share of the gap between them leaves either as it is.
constexpr double kWeak = 0.01;
constexpr double kMixedAtOnce = 0.5; ///< [rad], of the gap or the coupling

std::pair<double, double> cosine_and_sine(double x) noexcept {
    constexpr double kSmall = 1e-3; // the series are as good as a double
    if (std::fabs(x) > kSmall)
        return {std::cos(x), std::sin(x)};
    return {1 - x * x / 2 + x * x * x * x / 24, x - x * x * x / 6};
}

} // namespace

ModalMotion::ModalMotion(std::shared_ptr<const ModalBasis> basis)
    : basis_(std::move(basis)), oscillators_(basis_->omega, basis_->decay), awake_(basis_->columns),
      band_(basis_->columns), load_(basis_->columns, 0.0), impulse_(basis_->columns, 0.0),
      settled_(basis_->columns, 0.0) {
    for (AlignedVector<float>& q : single_)
        q.assign(basis_->columns, 0.0f);
    state_.amplitude.assign(basis_->columns, 0.0);
    state_.rate.assign(basis_->columns, 0.0);
    ahead_ = kept_ = state_;
    if (!basis_->held)
        inverse_inertia_ = basis_->inertia.inverse();
}

void ModalMotion::set_load(const Vec3& gravity, const NodeArray* forces) noexcept {
    const ModalBasis& b = *basis_;
    steady_force_ = b.total_mass * gravity;
    steady_torque_.setZero();
    std::fill(load_.begin(), load_.end(), 0.0);
    const Mat3 back = state_.turn.toRotationMatrix().transpose();
    if (b.held) {
        const Vec3 local = back * gravity;
        for (std::size_t k = 0; k < b.columns; ++k)
            for (std::size_t axis = 0; axis < 3; ++axis)
                load_[k] += b.inertia_share[axis * b.columns + k] * local[static_cast<int>(axis)];
    }
    if (bends_)
        std::fill(following_.place.begin(), following_.place.end(), 0.0);
    const Spread moved(b, awake(state_.amplitude), single_[0]);
    for (std::size_t n = 0; forces && n < b.nodes(); ++n) {
        const Vec3 f = (*forces)[n];
        if (f.isZero(0))
            continue;
        steady_force_ += f;
        const Vec3 local = back * f;
        project(b, n, local, load_);
        if (bends_)
            project(cubic_->terms().row(n), cubic_->terms().columns(), local, following_.place);
        steady_torque_ += (state_.turn * (b.rest[n] + moved.at(n))).cross(f);
    }
    if (bends_)
        cubic_->set_load(following_.place);
    loaded_ = std::any_of(load_.begin(), load_.end(), [](double f) { return f != 0; });
}

void ModalMotion::keep() noexcept {
    copy(state_, kept_);
    kept_awake_ = awake_;
    if (bends_)
        cubic_->keep();
}

void ModalMotion::take_back() noexcept {
    for (AlignedVector<double>* q :
         {&state_.amplitude, &state_.rate, &ahead_.amplitude, &ahead_.rate})
        std::fill(q->begin(), q->end(), 0.0);
    awake_ = kept_awake_;
    copy(kept_, state_);
    foreseen_ = 0;
    if (bends_)
        cubic_->take_back();
}

void ModalMotion::copy(const ModalState& from, ModalState& to) const noexcept {
    to.center = from.center;
    to.velocity = from.velocity;
    to.turn = from.turn;
    to.spin_momentum = from.spin_momentum;
    std::copy_n(from.amplitude.begin(), awake_, to.amplitude.begin());
    std::copy_n(from.rate.begin(), awake_, to.rate.begin());
}

const ModalState& ModalMotion::foresee(double dt) noexcept {
    if (foreseen_ == dt)
        return ahead_;
    begin_kicks(dt);
    copy(state_, ahead_); // what sleeps is zero in both
    foreseen_ = 0;
    move_on(dt);
    std::swap(state_, ahead_);
    foreseen_ = dt;
    return ahead_;
}

void ModalMotion::push(const ContactShare& forces, const NodeState& nodes, double dt) noexcept {
    const Mat3 back = state_.turn.toRotationMatrix().transpose();
    const std::span<double> given = std::span(impulse_).first(band_);
    std::fill(given.begin(), given.end(), 0.0);
    linear_impulse_.setZero();
    angular_impulse_.setZero();
    forces.each([&](std::size_t n, const auto& f) {
        const Vec3 impulse = dt * f;
        project(*basis_, n, back * impulse, given);
        linear_impulse_ += impulse;
        angular_impulse_ += (nodes.position[n] - state_.center).cross(impulse);
    });
    pushed_ = true;
    if (bends_ && band_ > basis_->gentle_columns)
        cubic_->widen();
    if (!basis_->held) {
        state_.velocity += linear_impulse_ / basis_->total_mass;
        state_.spin_momentum += angular_impulse_;
    }
    if (awake_ < band_) {
        awake_ = band_;
        unpruned_ = 0;
    }
    if (foreseen_ != dt) {
        for (std::size_t k = 0; k < band_; ++k)
            state_.rate[k] += given[k];
        foreseen_ = 0;
        return;
    }
    oscillators_.respond(dt, given, ahead_.amplitude, ahead_.rate);
    if (!basis_->held)
        fly(dt);
    ahead_.center = state_.center;
    ahead_.velocity = state_.velocity;
    ahead_.turn = state_.turn;
    ahead_.spin_momentum = state_.spin_momentum;
}

Vec3 ModalMotion::spin_of(const Vec3& momentum) const noexcept {
    if (basis_->held)
        return Vec3::Zero();
    return state_.turn * (inverse_inertia_ * (state_.turn.conjugate() * momentum));
}

void ModalMotion::turn_by(const Vec3& spin, double dt) noexcept {
    const Vec3 half = dt / 2 * spin;
    const double square = half.squaredNorm();
    if (square == 0)
        return;
    // No more than kTurn: sine and cosine to the sixth power of half of it, 1e-16.
    const double cosine = 1 - square / 2 + square * square / 24;
    const Vec3 sine = (1 - square / 6 + square * square / 120) * half;
    state_.turn = Quat(cosine, sine.x(), sine.y(), sine.z()) * state_.turn;
    state_.turn.normalize();
}

void ModalMotion::fly(double dt) noexcept {
    const Vec3 acceleration = steady_force_ / basis_->total_mass;
    state_.center += dt * (state_.velocity + dt / 2 * acceleration);
    state_.velocity += dt * acceleration;
    state_.spin_momentum += dt * steady_torque_;
    const double steps = std::ceil(spin().norm() * dt / kTurn);
    if (!(steps >= 1))
        return;
    const double h = dt / steps;
    for (double i = 0; i < steps; ++i) { // the spin turns with the body while its momentum stays
        const Quat before = state_.turn;
        turn_by(spin(), h / 2);
        const Vec3 middle = spin();
        state_.turn = before;
        turn_by(middle, h);
    }
}

void ModalMotion::settle(std::size_t columns, const Vec3& w) noexcept {
    const double* slope = basis_->inertia_slope.data();
    const std::size_t n = basis_->columns;
    if (loaded_)
        std::copy_n(load_.begin(), columns, settled_.begin());
    else
        std::fill_n(settled_.begin(), columns, 0.0);
    const double xx = w.x() * w.x() / 2, yy = w.y() * w.y() / 2, zz = w.z() * w.z() / 2;
    const double xy = w.x() * w.y(), xz = w.x() * w.z(), yz = w.y() * w.z();
    for (std::size_t k = 0; k < columns; ++k)
        settled_[k] += xx * slope[k] + yy * slope[n + k] + zz * slope[2 * n + k] +
                       xy * slope[3 * n + k] + xz * slope[4 * n + k] + yz * slope[5 * n + k];
    for (std::size_t k = 0; k < columns; ++k)
        settled_[k] /= basis_->omega[k] * basis_->omega[k];
}

int ModalMotion::pieces(const Vec3& spin, double dt) const noexcept {
    double most = 1;
    const double fast = spin.norm();
    for (const ModalBasis::Gyration& pair : basis_->gyration) {
        if (fast < kWeak * pair.spin)
            break; // nor do the others mix
        const double strength = std::fabs(spin.dot(pair.coupling));
        const double gap = std::fabs(basis_->omega[static_cast<std::size_t>(pair.first)] -
                                     basis_->omega[static_cast<std::size_t>(pair.second)]);
        if (strength > kWeak * gap)
            most = std::fmax(most, std::fmax(strength, gap) * dt / kMixedAtOnce);
    }
    return static_cast<int>(std::ceil(most));
}

void ModalMotion::mix(const Vec3& spin, double dt) noexcept {
    // q_i'' = 2 w.g q_j' and its reverse: over many periods the two amplitudes turn into one
    // another by w.g a second.
    const double fast = spin.norm();
    for (const ModalBasis::Gyration& pair : basis_->gyration) {
        if (fast < kWeak * pair.spin)
            break;
        const auto i = static_cast<std::size_t>(pair.first);
        const auto j = static_cast<std::size_t>(pair.second);
        const double strength = spin.dot(pair.coupling);
        const double wi = basis_->omega[i], wj = basis_->omega[j];
        if (!(std::fabs(strength) > kWeak * std::fabs(wi - wj)))
            continue;
        const auto [c, s] = cosine_and_sine(strength * dt);
        double &qi = state_.amplitude[i], &qj = state_.amplitude[j];
        double &vi = state_.rate[i], &vj = state_.rate[j];
        const double a = wi * qi, b = wj * qj, u = vi, v = vj;
        qi = (c * a + s * b) / wi;
        qj = (c * b - s * a) / wj;
        vi = c * u + s * v;
        vj = c * v - s * u;
    }
}

void ModalMotion::advance(double dt) noexcept {
    rest_what_died();
    was_pushed_ = pushed_;
    pushed_ = false;
    if (foreseen_ == dt) {
        std::swap(state_, ahead_);
        foreseen_ = 0;
        if (bends_)
            cubic_->end(dt, state_.amplitude, state_.rate);
        return;
    }
    foreseen_ = 0;
    begin_kicks(dt);
    move_on(dt);
    if (bends_)
        cubic_->end(dt, state_.amplitude, state_.rate);
}

void ModalMotion::move_on(double dt) noexcept {
    const Vec3 spin = state_.turn.conjugate() * this->spin();
    const bool spins = spin.squaredNorm() > 0;
    if (!basis_->held)
        fly(dt);
    // By their spin, bodies hardly stretch in modes above hearing.
    const std::size_t shifted = loaded_ ? awake_ : spins ? basis_->audible_columns : 0;
    settle(shifted, spin);
    for (std::size_t k = 0; k < shifted; ++k)
        state_.amplitude[k] -= settled_[k];
    const int parts = spins ? pieces(spin, dt) : 1;
    const double h = dt / parts;
    for (int i = 0; i < parts; ++i) {
        if (spins)
            mix(spin, h / 2);
        oscillators_.advance(h, std::span(state_.amplitude).first(awake_),
                             std::span(state_.rate).first(awake_));
        if (spins)
            mix(spin, h / 2);
    }
    for (std::size_t k = 0; k < shifted; ++k)
        state_.amplitude[k] += settled_[k];
}

void ModalMotion::rest_what_died() noexcept {
    constexpr int kPatience = 16;    // advances: pushes come in bursts
    constexpr double kShare = 1e-12; // of the energy
    const std::size_t lower =
        awake_ > basis_->gentle_columns ? basis_->gentle_columns : basis_->audible_columns;
    if (awake_ == lower || ++unpruned_ < kPatience)
        return;
    unpruned_ = 0;
    double above = 0;
    for (std::size_t k = lower; k < awake_; ++k) {
        const double a = basis_->omega[k] * state_.amplitude[k];
        above += a * a + state_.rate[k] * state_.rate[k];
    }
    if (above > 2 * kShare * (vibration_energy() + rigid_energy()))
        return;
    for (ModalState* state : {&state_, &ahead_})
        for (AlignedVector<double>* q : {&state->amplitude, &state->rate})
            std::fill(q->begin() + static_cast<std::ptrdiff_t>(lower), q->end(), 0.0);
    awake_ = lower;
}

} // namespace ode::soft
