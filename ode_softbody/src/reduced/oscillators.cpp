#include "reduced/oscillators.h"

#include "modal/avx2.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

[[gnu::always_inline]] inline void advance_body(const double* table, std::size_t n,
                                                std::size_t count, double* q, double* v) {
    for (std::size_t i = 0; i < count; ++i) {
        const double x = table[i] * q[i] + table[n + i] * v[i];
        v[i] = table[2 * n + i] * q[i] + table[3 * n + i] * v[i];
        q[i] = x;
    }
}

// The same arithmetic at either register width: equal bits.
void advance_narrow(const double* table, std::size_t n, std::size_t count, double* q, double* v) {
    advance_body(table, n, count, q, v);
}
ODE_SOFTBODY_AVX2 void advance_wide(const double* table, std::size_t n, std::size_t count,
                                    double* q, double* v) {
    advance_body(table, n, count, q, v);
}
ODE_SOFTBODY_AVX512 void advance_widest(const double* table, std::size_t n, std::size_t count,
                                        double* q, double* v) {
    advance_body(table, n, count, q, v);
}

} // namespace

Oscillators::Oscillators(std::span<const double> omega, std::span<const double> decay)
    : omega_(omega.begin(), omega.end()), decay_(decay.begin(), decay.end()) {
    for (Length& length : length_)
        length.table.assign(4 * omega_.size(), 0.0);
}

const Oscillators::Length& Oscillators::length(double dt) noexcept {
    ++clock_;
    const auto known = std::find_if(length_.begin(), length_.end(),
                                    [&](const Length& length) { return length.dt == dt; });
    if (known != length_.end()) {
        known->used = clock_;
        return *known;
    }
    Length& made = *std::min_element(length_.begin(), length_.end(),
                                     [](const auto& a, const auto& b) { return a.used < b.used; });
    made.dt = dt;
    made.used = clock_;
    const std::size_t n = omega_.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double w = omega_[i];
        const double d = decay_[i];
        const double rest = (w - d) * (w + d);
        const double fade = std::exp(-d * dt);
        double c, s; // cos and sin / wd, damped; of a creeping motion their hyperbolic kin
        if (rest > 0) {
            const double damped = std::sqrt(rest);
            c = fade * std::cos(damped * dt);
            s = fade * std::sin(damped * dt) / damped;
        } else { // exp(-d t) cosh would overflow where d t is large
            const double damped = std::sqrt(-rest);
            const double slow = std::exp((damped - d) * dt);
            const double fast = std::exp(-(damped + d) * dt);
            c = (slow + fast) / 2;
            s = damped > 0 ? (slow - fast) / (2 * damped) : fade * dt;
        }
        made.table[i] = c + d * s;
        made.table[n + i] = s;
        made.table[2 * n + i] = -w * w * s;
        made.table[3 * n + i] = c - d * s;
    }
    return made;
}

void Oscillators::respond(double dt, std::span<const double> impulse, std::span<double> amplitude,
                          std::span<double> rate) noexcept {
    const std::size_t n = size();
    const double* table = length(dt).table.data();
    for (std::size_t i = 0; i < impulse.size(); ++i) {
        amplitude[i] += table[n + i] * impulse[i];
        rate[i] += table[3 * n + i] * impulse[i];
    }
}

std::span<const double> Oscillators::drift(double dt) noexcept {
    return std::span<const double>(length(dt).table).subspan(size(), size());
}

void Oscillators::advance(double dt, std::span<double> amplitude, std::span<double> rate) noexcept {
    const Length& by = length(dt);
    const auto run = has_avx512() ? advance_widest : has_avx2() ? advance_wide : advance_narrow;
    run(by.table.data(), size(), amplitude.size(), amplitude.data(), rate.data());
}

} // namespace ode::soft
