#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace ode::soft {

/// Roots of f in ascending order, by stepping and bisection.
inline std::vector<double> roots(const std::function<double(double)>& f, double from, double step,
                                 std::size_t count) {
    std::vector<double> out;
    for (double x = from; out.size() < count; x += step) {
        double low = x, high = x + step;
        if (f(low) * f(high) > 0)
            continue;
        const bool rising = f(high) > 0;
        for (int i = 0; i < 60; ++i) {
            const double mid = 0.5 * (low + high);
            ((f(mid) > 0) == rising ? high : low) = mid;
        }
        out.push_back(low);
    }
    return out;
}

enum class BeamEnds { kFree, kClampedFree };

/// Timoshenko's beam (Huang 1961, doi:10.1115/1.3641787): roots b with b^2 = rho A L^4 w^2 / (E I).
/// @param r2  (radius of gyration / length)^2
/// @param s2  r2 E / (k G), k the shear coefficient
inline std::vector<double> timoshenko_roots(BeamEnds ends, double r2, double s2,
                                            std::size_t count) {
    const auto equation = [&](double b) {
        const double spread = std::sqrt((r2 - s2) * (r2 - s2) + 4 / (b * b));
        const double alpha = std::sqrt((spread - r2 - s2) / 2) * b;
        const double beta = std::sqrt((spread + r2 + s2) / 2) * b;
        const double root = std::sqrt(1 - b * b * r2 * s2);
        // Divided by cosh(alpha), so that nothing overflows.
        const double one = 1 / std::cosh(alpha), cosine = std::cos(beta);
        const double sine = std::tanh(alpha) * std::sin(beta);
        if (ends == BeamEnds::kFree)
            return 2 * one - 2 * cosine +
                   b / root * (b * b * r2 * (r2 - s2) * (r2 - s2) + 3 * r2 - s2) * sine;
        return 2 * one + (b * b * (r2 - s2) * (r2 - s2) + 2) * cosine - b * (r2 + s2) / root * sine;
    };
    return roots(equation, 1.0, 0.25, count);
}

/// Of rectangular section, with Cowper's shear coefficient (1966, doi:10.1115/1.3625046).
struct TimoshenkoBar {
    double length, width, thickness; ///< bending along the thickness [m]
    double young, poisson, density;

    std::vector<double> frequencies(BeamEnds ends, std::size_t count) const {
        const double inertia = width * std::pow(thickness, 3) / 12, area = width * thickness;
        const double shear = 10 * (1 + poisson) / (12 + 11 * poisson);
        const double r2 = inertia / (area * length * length);
        std::vector<double> out;
        for (const double b : timoshenko_roots(ends, r2, r2 * 2 * (1 + poisson) / shear, count))
            out.push_back(b / (2 * std::numbers::pi * length * length) *
                          std::sqrt(young * inertia / (density * area)));
        return out;
    }
};

/// A round tube with free ends, with Hutchinson's shear coefficient (2001,
/// doi:10.1115/1.1349417), which agrees with the solid to the next order in wavelength: Cowper's is
/// 12 cents off in a fourth partial.
struct TimoshenkoTube {
    double length, outer, inner; ///< radii [m]
    double young, poisson, density;

    std::vector<double> frequencies(std::size_t count) const {
        const double gyration = (outer * outer + inner * inner) / 4;
        const double r2 = gyration / (length * length);
        const double a = outer * outer, b = inner * inner, nu = poisson;
        const double shear =
            6 * (a + b) * (a + b) * (1 + nu) * (1 + nu) /
            (7 * a * a + 34 * a * b + 7 * b * b + nu * (12 * a * a + 48 * a * b + 12 * b * b) +
             nu * nu * (4 * a * a + 16 * a * b + 4 * b * b));
        std::vector<double> out;
        for (const double root :
             timoshenko_roots(BeamEnds::kFree, r2, r2 * 2 * (1 + poisson) / shear, count))
            out.push_back(root / (2 * std::numbers::pi * length * length) *
                          std::sqrt(young * gyration / density));
        return out;
    }
};

/// 1200 log2(f / reference).
inline double cents(double f, double reference) { return 1200 * std::log2(f / reference); }

} // namespace ode::soft
