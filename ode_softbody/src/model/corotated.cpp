#include "model/corotated.h"

#include "model/tet_model_impl.h"

#include <Eigen/SVD>

namespace ode::soft {

namespace baseline {
TetForce<CorotatedConstants> corotated_force(TetShape shape, bool viscous);
}
#if defined(__x86_64__)
namespace avx2 {
TetForce<CorotatedConstants> corotated_force(TetShape shape, bool viscous);
}
namespace avx512 {
TetForce<CorotatedConstants> corotated_force(TetShape shape, bool viscous);
}
#endif

namespace {

/// By singular values: slow, and independent of the kernels' way.
Mat3 nearest_rotation(const Mat3& f) {
    const Eigen::JacobiSVD<Mat3> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    return svd.matrixU() * Vec3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

Mat3 cross_matrix(const Vec3& w) noexcept {
    return Mat3{{0, -w.z(), w.y()}, {w.z(), 0, -w.x()}, {-w.y(), w.x(), 0}};
}

} // namespace

CorotatedTangent::CorotatedTangent(const Solid& s, const Mat3& f) noexcept
    : rotation_(nearest_rotation(f)), lambda_(s.lambda()), mu_(s.mu()) {
    const Mat3 stretch = rotation_.transpose() * f;
    spin_ = (stretch.trace() * Mat3::Identity() - stretch).inverse();
    turning_ = lambda_ * (stretch.trace() - 3) - 2 * mu_;
}

Mat3 CorotatedTangent::block(const Vec3& a, const Vec3& b) const noexcept {
    // For dF = u (x) b the rotation turns by dR = R [w]x with (tr(S) I - S) w = b cross R^T u, from
    // the skew part of R^T dF; and dP = 2 mu dF + lambda (R:dF) R + (lambda tr(S - I) - 2 mu) dR.
    return 2 * mu_ * a.dot(b) * Mat3::Identity() +
           lambda_ * (rotation_ * a) * (rotation_ * b).transpose() -
           turning_ * rotation_ * cross_matrix(a) * spin_ * cross_matrix(b) * rotation_.transpose();
}

double CorotatedLaw::energy(const Solid& s, const Mat3& f) noexcept {
    const Mat3 r = nearest_rotation(f);
    const double strain = (r.transpose() * (f - r)).trace();
    return s.mu() * (f - r).squaredNorm() + s.lambda() / 2 * strain * strain;
}

TetForce<CorotatedConstants> CorotatedLaw::kernel(Isa isa, TetShape shape, bool viscous) noexcept {
    switch (isa) {
#if defined(__x86_64__)
    case Isa::avx512:
        return avx512::corotated_force(shape, viscous);
    case Isa::avx2:
        return avx2::corotated_force(shape, viscous);
#endif
    default:
        return baseline::corotated_force(shape, viscous);
    }
}

template class TetModel<CorotatedLaw, Tet4Packs>;
template class TetModel<CorotatedLaw, Tet10Packs>;

} // namespace ode::soft
