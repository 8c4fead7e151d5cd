#include "model/stable_neo_hookean.h"

#include "model/tet_model_impl.h"

namespace ode::soft {

namespace baseline {
TetForce<NeoHookeanConstants> stable_neo_hookean_force(TetShape shape, bool viscous);
}
#if defined(__x86_64__)
namespace avx2 {
TetForce<NeoHookeanConstants> stable_neo_hookean_force(TetShape shape, bool viscous);
}
namespace avx512 {
TetForce<NeoHookeanConstants> stable_neo_hookean_force(TetShape shape, bool viscous);
}
#endif

namespace {

Mat3 cofactor(const Mat3& f) noexcept {
    Mat3 c;
    c << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
    return c;
}

Mat3 cross_matrix(const Vec3& w) noexcept {
    return Mat3{{0, -w.z(), w.y()}, {w.z(), 0, -w.x()}, {-w.y(), w.x(), 0}};
}

} // namespace

StableNeoHookeanTangent::StableNeoHookeanTangent(const Solid& s, const Mat3& f) noexcept
    : f_(f), cofactor_(cofactor(f)) {
    const auto c = StableNeoHookeanLaw::constants(s);
    const double i = f.squaredNorm();
    shear_ = c.mu * (1 - 1 / (i + 1));
    softening_ = 2 * c.mu / ((i + 1) * (i + 1));
    lambda_ = c.lambda;
    pressure_ = c.lambda * (f.determinant() - 1) - 0.75 * c.mu;
}

Mat3 StableNeoHookeanTangent::block(const Vec3& a, const Vec3& b) const noexcept {
    // The cofactor is bilinear: cof(F) (x cross y) = Fx cross Fy. So its derivative in the
    // direction u (x) b, applied to a, is F(b cross a) cross u.
    const Vec3 fa = f_ * a, fb = f_ * b, ca = cofactor_ * a, cb = cofactor_ * b;
    return shear_ * a.dot(b) * Mat3::Identity() + softening_ * fa * fb.transpose() +
           lambda_ * ca * cb.transpose() + pressure_ * cross_matrix(f_ * b.cross(a));
}

double StableNeoHookeanLaw::energy(const Solid& s, const Mat3& f) noexcept {
    // With g = F^T F - I of invariants i1 i2 i3 and d = J - 1 this is
    // mu/2 (i1/4 - log(1 + i1/4)) + lambda/2 d^2 + 3/4 mu (i1/2 - d): the last term is of second
    // order only as a difference. J^2 = det(I + g) = 1 + i1 + i2 + i3 gives it without
    // cancellation, so that the energy of a small vibration keeps its digits.
    const Constants c = constants(s);
    const Mat3 g = f.transpose() * f - Mat3::Identity();
    const double i1 = g.trace();
    const double j = f.determinant();
    double d = j - 1, difference = i1 / 2 - d;
    if (j > 0) {
        const double i2 = (i1 * i1 - g.squaredNorm()) / 2, i3 = g.determinant();
        d = (i1 + i2 + i3) / (j + 1);
        difference = (i1 * d / 2 - i2 - i3) / (j + 1);
    }
    return c.mu / 2 * (i1 / 4 - std::log1p(i1 / 4)) + c.lambda / 2 * d * d +
           0.75 * c.mu * difference;
}

TetForce<NeoHookeanConstants> StableNeoHookeanLaw::kernel(Isa isa, TetShape shape,
                                                          bool viscous) noexcept {
    switch (isa) {
#if defined(__x86_64__)
    case Isa::avx512:
        return avx512::stable_neo_hookean_force(shape, viscous);
    case Isa::avx2:
        return avx2::stable_neo_hookean_force(shape, viscous);
#endif
    default:
        return baseline::stable_neo_hookean_force(shape, viscous);
    }
}

template class TetModel<StableNeoHookeanLaw, Tet4Packs>;
template class TetModel<StableNeoHookeanLaw, Tet10Packs>;

} // namespace ode::soft
