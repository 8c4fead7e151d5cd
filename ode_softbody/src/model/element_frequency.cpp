#include "model/element_frequency.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace ode::soft {
namespace {

constexpr double kMargin = 1e-3; ///< so that elements equal to the worst pass the proof

} // namespace

void ElementFrequency::include(const Eigen::MatrixXd& k) {
    // Most elements are no worse than the worst so far, and a Cholesky factor proves it at a
    // fraction of an eigenvalue's price: bound I - K is positive definite.
    const Eigen::MatrixXd rest = -k + bound_ * Eigen::MatrixXd::Identity(k.rows(), k.cols());
    if (Eigen::LLT<Eigen::MatrixXd>(rest).info() == Eigen::Success)
        return;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(k, Eigen::EigenvaluesOnly);
    bound_ = eigen.eigenvalues().maxCoeff() * (1 + kMargin);
}

} // namespace ode::soft
