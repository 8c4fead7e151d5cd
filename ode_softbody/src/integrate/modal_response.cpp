#include "integrate/modal_response.h"

#include "integrate/oscillator.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace ode::soft {
namespace {

constexpr double kInverseMass[] = {1.0};

/// Eigenvalue of larger modulus; with a positive imaginary part where there is one.
std::complex<double> dominant(const Eigen::Matrix2d& a) {
    const double half = a.trace() / 2;
    const double discriminant = half * half - a.determinant();
    if (discriminant < 0)
        return {half, std::sqrt(-discriminant)};
    return half < 0 ? half - std::sqrt(discriminant) : half + std::sqrt(discriminant);
}

/// Rounding of an eigenvalue on the unit circle, squared near a double one: sqrt(2^-52) = 1.5e-8.
constexpr double kRounding = 4e-8;
/// A method that is stable at all is so at this share of an undamped critical step.
constexpr double kSmall = 0.05;
/// No explicit method here gets this far; one that does is stable at any step.
constexpr double kFar = 64;

} // namespace

ModalAnalysis::ModalAnalysis(std::string_view integrator)
    : method_(integrator_kind(integrator).make(1)), state_{NodeArray(1), NodeArray(1)}, force_(1) {}

ModalResponse ModalAnalysis::response(double omega_h, double damping_ratio) {
    const Oscillator mode(1, damping_ratio);
    const NodeInertia inertia{kInverseMass};
    Eigen::Matrix2d transfer;
    for (int column = 0; column < 2; ++column) {
        state_.position.set_zero();
        state_.velocity.set_zero();
        force_.set_zero();
        (column == 0 ? state_.position : state_.velocity)[0].x() = 1;
        method_->evaluate(mode, state_, force_);
        method_->step(mode, inertia, omega_h, state_, force_);
        transfer.col(column) << state_.position[0].x(), state_.velocity[0].x();
    }
    const std::complex<double> z = dominant(transfer);
    const std::complex<double> rate = std::log(z);
    const double exact = std::sqrt(std::max(0.0, 1 - damping_ratio * damping_ratio)) * omega_h;
    ModalResponse out;
    out.amplification = std::abs(z);
    out.artificial_damping = -rate.real() / std::abs(rate) - damping_ratio;
    out.period_error = z.imag() > 0 && exact > 0 ? exact / rate.imag() - 1 : std::nan("");
    return out;
}

bool ModalAnalysis::is_stable(double omega, double beta, double h) {
    // Modes of all lower frequencies, by half tones.
    for (int k = 0; k <= 96; ++k) {
        const double w = omega * std::exp2(-k / 12.0);
        if (response(w * h, beta * w / 2).amplification > 1 + kRounding)
            return false;
    }
    return true;
}

double ModalAnalysis::critical_step(double omega, double beta) {
    if (!(omega > 0))
        return std::numeric_limits<double>::infinity();
    double good = kSmall / omega;
    if (!is_stable(omega, beta, good))
        return 0;
    constexpr double kRatio = 1.03;
    double bad = good;
    do {
        good = bad;
        bad *= kRatio;
        if (omega * bad > kFar)
            return std::numeric_limits<double>::infinity();
    } while (is_stable(omega, beta, bad));
    while (bad > 1.001 * good) {
        const double middle = std::sqrt(good * bad);
        (is_stable(omega, beta, middle) ? good : bad) = middle;
    }
    return good;
}

} // namespace ode::soft
