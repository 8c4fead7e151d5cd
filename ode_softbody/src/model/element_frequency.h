#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>

namespace ode::soft {

/// Collects an upper bound on the angular frequencies of an assembly from its elements: the largest
/// eigenvalue of the whole is at most the largest of any element (Irons & Treharne 1971).
class ElementFrequency {
public:
    /// @param k  M_e^-1/2 K_e M_e^-1/2 [1/s^2].
    template <int kSize>
    void include(const Eigen::Matrix<double, kSize, kSize>& k) {
        // Most elements are no worse than the worst so far, and a Cholesky factor proves it at a
        // fiftieth of an eigenvalue's price: bound I - K is positive definite.
        using Square = Eigen::Matrix<double, kSize, kSize>;
        if (Eigen::LLT<Square>(bound_ * Square::Identity() - k).info() == Eigen::Success)
            return;
        const double largest = Eigen::SelfAdjointEigenSolver<Square>(k, Eigen::EigenvaluesOnly)
                                   .eigenvalues()[kSize - 1];
        bound_ = largest * (1 + kMargin);
    }

    double value() const { return std::sqrt(bound_); } ///< [rad/s]

private:
    static constexpr double kMargin = 1e-3; ///< so that equal elements pass the proof
    double bound_ = 0;
};

} // namespace ode::soft
