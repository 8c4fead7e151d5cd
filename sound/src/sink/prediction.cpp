#include "sink/prediction.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace ode::sound {

Predictor fit_predictor(std::span<const float> signal) noexcept {
    constexpr auto kOrder = static_cast<Eigen::Index>(kPredictionOrder);
    const auto n = static_cast<Eigen::Index>(signal.size());
    const auto x = [signal](Eigen::Index i) {
        return static_cast<double>(signal[static_cast<std::size_t>(i)]);
    };
    // r(i, j) = sum over t in [order, n) of x[t-i] x[t-j]; along a diagonal only the ends change.
    Eigen::Matrix<double, kOrder + 1, kOrder + 1> r;
    for (Eigen::Index j = 0; j <= kOrder; ++j) {
        r(0, j) = 0;
        for (Eigen::Index t = kOrder; t < n; ++t)
            r(0, j) += x(t) * x(t - j);
        r(j, 0) = r(0, j);
    }
    for (Eigen::Index i = 0; i < kOrder; ++i)
        for (Eigen::Index j = 0; j < kOrder; ++j)
            r(i + 1, j + 1) =
                r(i, j) + x(kOrder - 1 - i) * x(kOrder - 1 - j) - x(n - 1 - i) * x(n - 1 - j);

    Predictor predictor{};
    Eigen::Map<Eigen::Matrix<double, kOrder, 1>> a(predictor.data());
    Eigen::Matrix<double, kOrder, kOrder> normal = r.bottomRightCorner<kOrder, kOrder>();
    const double trace = normal.trace();
    if (!(trace > 0))
        return predictor; // silence
    // The ridge chooses the least norm among equal fits. It lies between the rounding of floats and
    // of doubles, and damps a sine by 1e-11 a frame.
    normal.diagonal().array() += 1e-11 * trace;
    a = normal.llt().solve(r.bottomLeftCorner<kOrder, 1>());
    return predictor;
}

} // namespace ode::sound
