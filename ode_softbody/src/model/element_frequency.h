#pragma once

#include <Eigen/Core>

#include <cmath>

namespace ode::soft {

/// Collects an upper bound on the angular frequencies of an assembly from its elements: the largest
/// eigenvalue of the whole is at most the largest of any element (Irons & Treharne 1971).
class ElementFrequency {
public:
    /// @param k  M_e^-1/2 K_e M_e^-1/2 [1/s^2].
    void include(const Eigen::MatrixXd& k);

    double value() const { return std::sqrt(bound_); } ///< [rad/s]

private:
    double bound_ = 0;
};

} // namespace ode::soft
