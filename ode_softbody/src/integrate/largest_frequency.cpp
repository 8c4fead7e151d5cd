#include "integrate/largest_frequency.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace ode::soft {
namespace {

constexpr double kShortfall = 0.05; ///< eps
constexpr double kImprobable = 1e-12;

/// Normal deviates are uniform on the sphere, which the bound asks for.
Eigen::VectorXd random_direction(Eigen::Index n) {
    std::mt19937_64 bits(20010812);
    const auto uniform = [&] { return (double(bits() >> 11) + 0.5) * 0x1p-53; };
    Eigen::VectorXd v(n);
    for (Eigen::Index i = 0; i < n; ++i)
        v[i] = std::sqrt(-2 * std::log(uniform())) * std::cos(2 * std::numbers::pi * uniform());
    return v;
}

} // namespace

FrequencyBracket largest_frequency(const Eigen::SparseMatrix<double>& k,
                                   std::span<const double> inverse_mass) {
    const Eigen::Index n = k.rows();
    Eigen::VectorXd scale(n);
    for (Eigen::Index i = 0; i < n; ++i)
        scale[i] = std::sqrt(inverse_mass[static_cast<std::size_t>(i / 3)]);
    const auto free = static_cast<double>((scale.array() > 0).count());
    if (free == 0)
        return {0, 0};

    Eigen::VectorXd v = random_direction(n);
    v = (scale.array() > 0).select(v, 0.0);
    v.normalize();
    const double odd = std::log(1.648 * std::sqrt(free) / kImprobable) / std::sqrt(kShortfall);
    const auto steps = static_cast<int>(std::min(std::ceil((odd + 1) / 2), free));

    // Without re-orthogonalisation: rounding then makes copies of Ritz values that have converged,
    // but never moves the largest out of the spectrum (Paige 1980,
    // doi:10.1016/0024-3795(80)90167-6).
    std::vector<double> diagonal, side;
    Eigen::VectorXd before = Eigen::VectorXd::Zero(n);
    double beta = 0, norm = 0;
    for (int i = 0; i < steps; ++i) {
        Eigen::VectorXd w = scale.cwiseProduct(k * scale.cwiseProduct(v)) - beta * before;
        const double alpha = v.dot(w);
        w -= alpha * v;
        diagonal.push_back(alpha);
        beta = w.norm();
        norm = std::isfinite(alpha) ? std::max(norm, std::abs(alpha) + beta)
                                    : std::numeric_limits<double>::infinity();
        if (!std::isfinite(norm))
            break;
        // The vectors span all that a random start can reach: what is left of w is rounding.
        if (beta <= 1e-14 * norm)
            break;
        side.push_back(beta);
        before.swap(v);
        v = w / beta;
    }
    side.resize(diagonal.size() - 1);
    if (norm == 0)
        return {0, 0};
    if (!std::isfinite(norm)) // a law without a derivative there: no step is known to be stable
        return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    // Eigen's test for a vanished off-diagonal is meant for entries near 1; far from it the
    // iteration ends unsorted.
    for (double& x : diagonal)
        x /= norm;
    for (double& x : side)
        x /= norm;
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    ritz.computeFromTridiagonal(
        Eigen::Map<Eigen::VectorXd>(diagonal.data(), static_cast<Eigen::Index>(diagonal.size())),
        Eigen::Map<Eigen::VectorXd>(side.data(), static_cast<Eigen::Index>(side.size())),
        Eigen::EigenvaluesOnly);
    const double largest = norm * std::max(ritz.eigenvalues().maxCoeff(), 0.0);
    return {std::sqrt(largest), std::sqrt(largest / (1 - kShortfall))};
}

} // namespace ode::soft
