// What is asked of a motion in modes: energies, bounds, what a push meets.
#include "reduced/modal_motion.h"
#include "reduced/mode_rows.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {

double ModalMotion::vibration_energy() const noexcept {
    double sum = 0;
    for (std::size_t k = 0; k < awake_; ++k) {
        const double a = basis_->omega[k] * state_.amplitude[k];
        sum += a * a + state_.rate[k] * state_.rate[k];
    }
    return sum / 2 + (bends_ ? cubic_->energy() : 0);
}

double ModalMotion::rigid_energy() const noexcept {
    return (basis_->total_mass * state_.velocity.squaredNorm() + spin().dot(state_.spin_momentum)) /
           2;
}

double ModalMotion::largest_displacement() const noexcept {
    double sum = 0;
    for (std::size_t k = 0; k < awake_; ++k) {
        const double ahead = state_.rate[k] / basis_->omega[k];
        sum +=
            basis_->reach[k] * std::sqrt(state_.amplitude[k] * state_.amplitude[k] + ahead * ahead);
    }
    return sum;
}

double ModalMotion::largest_speed() const noexcept {
    double sum = 0;
    for (std::size_t k = 0; k < awake_; ++k) {
        const double ahead = state_.amplitude[k] * basis_->omega[k];
        sum += basis_->reach[k] * std::sqrt(state_.rate[k] * state_.rate[k] + ahead * ahead);
    }
    return sum + state_.velocity.norm() + basis_->radius * spin().norm();
}

ModalMotion::Swing ModalMotion::swing(std::span<float> way,
                                      std::span<float> acceleration) const noexcept {
    // Kicks by what isn't linear change amplitudes by some tenths at most.
    const double more = bends_ ? 1.5 : 1.0;
    Swing sum{};
    for (std::size_t k = 0; k < awake_; ++k) {
        const double w = basis_->omega[k];
        const double middle = load_[k] / (w * w);
        const double q = state_.amplitude[k] - middle, ahead = state_.rate[k] / w;
        const double swing = more * std::sqrt(q * q + ahead * ahead);
        const double most = more * std::fabs(middle) + swing;
        way[k] = static_cast<float>(most);
        // Of a damped one w^2 q and 2 d q' are no more together.
        acceleration[k] = static_cast<float>(swing * w * (w + 2 * basis_->decay[k]));
        sum.way += basis_->reach[k] * most;
        sum.speed += basis_->reach[k] * w * swing;
    }
    return sum;
}

double ModalMotion::frame_acceleration() const noexcept {
    if (basis_->held)
        return 0;
    // A spin w makes w^2 r, and where inertias differ turns about other axes by as much again.
    constexpr double kTumble = 4;
    return steady_force_.norm() / basis_->total_mass +
           basis_->radius * (kTumble * spin().squaredNorm() + spin_of(steady_torque_).norm());
}

bool ModalMotion::is_slower(double speed, std::span<const int> nodes) noexcept {
    const double half = was_pushed_ ? 0.5 : 0;
    const Vec3 velocity = state_.velocity + half / basis_->total_mass * linear_impulse_;
    const Vec3 spin = spin_of(state_.spin_momentum + half * angular_impulse_);
    const double square = speed * speed;
    double energy = 0;
    for (std::size_t k = 0; k < awake_; ++k) {
        settled_[k] = state_.rate[k] + (k < band_ ? half * impulse_[k] : 0);
        energy += settled_[k] * settled_[k];
    }
    // Some node is as fast as the mean.
    if (energy > basis_->total_mass * square || velocity.squaredNorm() > square)
        return false;
    const Mat3 turn = state_.turn.toRotationMatrix();
    const Spread rate(*basis_, awake(settled_), single_[1]);
    return std::all_of(nodes.begin(), nodes.end(), [&](int node) {
        const auto n = static_cast<std::size_t>(node);
        const Vec3 v = velocity + spin.cross(turn * basis_->rest[n]) + turn * rate.at(n);
        return v.squaredNorm() <= square;
    });
}

double ModalMotion::displacement_envelope(std::span<const int> nodes) noexcept {
    for (std::size_t k = 0; k < awake_; ++k)
        settled_[k] = state_.rate[k] / basis_->omega[k];
    const Spread moved(*basis_, awake(state_.amplitude), single_[0]),
        swing(*basis_, awake(settled_), single_[1]);
    double most = 0;
    for (const int node : nodes) {
        const auto n = static_cast<std::size_t>(node);
        most = std::fmax(most, moved.at(n).squaredNorm() + swing.at(n).squaredNorm());
    }
    return std::sqrt(most);
}

double ModalMotion::inverse_mass(std::size_t node, const Vec3& direction) const noexcept {
    double sum = 0;
    for (std::size_t k = 0; k < basis_->modes; ++k) {
        double push = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            push +=
                static_cast<double>(basis_->row(node, axis)[k]) * direction[static_cast<int>(axis)];
        sum += push * push;
    }
    if (basis_->held)
        return sum;
    const Vec3 arm = basis_->rest[node].cross(direction);
    return sum + 1 / basis_->total_mass + arm.dot(inverse_inertia_ * arm);
}

} // namespace ode::soft
