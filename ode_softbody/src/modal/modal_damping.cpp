#include "modal/modal_damping.h"

#include "integrate/rigid_fit.h"
#include "modal/avx2.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ode::soft {
namespace {

constexpr std::size_t kTile = 4;  ///< modes at once, so that a vector is read a fourth as often
constexpr std::size_t kWidth = 4; ///< doubles in a register

/// out[t] = column t times v.
[[gnu::always_inline]] inline void dot_body(const double* shape, const double* v, std::size_t rows,
                                            double* out) {
    double sum[kTile][kWidth] = {};
    for (std::size_t i = 0; i < rows; i += kWidth)
        for (std::size_t t = 0; t < kTile; ++t)
            for (std::size_t l = 0; l < kWidth; ++l)
                sum[t][l] += shape[t * rows + i + l] * v[i + l];
    for (std::size_t t = 0; t < kTile; ++t)
        out[t] = (sum[t][0] + sum[t][1]) + (sum[t][2] + sum[t][3]);
}

/// v += column t times by[t].
[[gnu::always_inline]] inline void add_body(const double* shape, const double* by, std::size_t rows,
                                            double* v) {
    for (std::size_t i = 0; i < rows; i += kWidth)
        for (std::size_t l = 0; l < kWidth; ++l) {
            double sum = v[i + l];
            for (std::size_t t = 0; t < kTile; ++t)
                sum += shape[t * rows + i + l] * by[t];
            v[i + l] = sum;
        }
}

// The same arithmetic at either register width: equal bits.
void dot_narrow(const double* shape, const double* v, std::size_t rows, double* out) {
    dot_body(shape, v, rows, out);
}
ODE_SOFTBODY_AVX2 void dot_wide(const double* shape, const double* v, std::size_t rows,
                                double* out) {
    dot_body(shape, v, rows, out);
}
void add_narrow(const double* shape, const double* by, std::size_t rows, double* v) {
    add_body(shape, by, rows, v);
}
ODE_SOFTBODY_AVX2 void add_wide(const double* shape, const double* by, std::size_t rows,
                                double* v) {
    add_body(shape, by, rows, v);
}

std::size_t filled_up(std::size_t n, std::size_t to) { return (n + to - 1) / to * to; }

} // namespace

ModalDamping::ModalDamping(std::span<const double> mass, std::span<const double> inverse_mass,
                           std::span<const int> held, std::span<const Vec3> rest,
                           const DampedModes& damped, std::span<const int> nailed)
    : mass_(mass.begin(), mass.end()), inverse_mass_(inverse_mass.begin(), inverse_mass.end()),
      held_(held.begin(), held.end()), nailed_(nailed.begin(), nailed.end()),
      rest_(rest.begin(), rest.end()), rows_(filled_up(3 * mass.size(), kWidth)),
      decay_(damped.decay.begin(), damped.decay.end()), rest_decay_(damped.rest_decay),
      interval_(damped.interval), momentum_(rows_, 0.0), change_(rows_, 0.0),
      amplitude_(filled_up(decay_.size(), kTile), 0.0) {
    // Mass-orthonormal in the masses of the stepped body too, or a portion could give energy.
    const auto n = static_cast<Eigen::Index>(mass.size());
    Eigen::MatrixXd shape(3 * n, static_cast<Eigen::Index>(decay_.size()));
    for (std::size_t k = 0; k < decay_.size(); ++k)
        for (Eigen::Index i = 0; i < n; ++i)
            shape.block<3, 1>(3 * i, static_cast<Eigen::Index>(k)) =
                inverse_mass_[static_cast<std::size_t>(i)] == 0
                    ? Vec3(Vec3::Zero())
                    : Vec3(damped.modes.shape_at(k, static_cast<std::size_t>(i)));
    Eigen::VectorXd weight(3 * n);
    for (Eigen::Index i = 0; i < n; ++i)
        weight.segment<3>(3 * i).setConstant(mass_[static_cast<std::size_t>(i)]);
    const Eigen::MatrixXd gram = shape.transpose() * weight.asDiagonal() * shape;
    const Eigen::LLT<Eigen::MatrixXd> root(gram);
    root.matrixU().solveInPlace<Eigen::OnTheRight>(shape);
    shape_.assign(rows_ * amplitude_.size(), 0.0);
    for (std::size_t k = 0; k < decay_.size(); ++k)
        std::copy_n(shape.data() + 3 * n * static_cast<Eigen::Index>(k), 3 * n,
                    shape_.begin() + static_cast<std::ptrdiff_t>(k * rows_));

    if (held_.size() > 2) // they hold the rotation, unless they lie in a line
        frame_ = held_;
    const auto centre_on = [&] {
        Vec3 centre = Vec3::Zero();
        double total = 0;
        const auto take = [&](std::size_t i) {
            centre += mass_[i] * rest_[i];
            total += mass_[i];
        };
        for (const int i : frame_)
            take(static_cast<std::size_t>(i));
        for (std::size_t i = 0; frame_.empty() && i < rest_.size(); ++i)
            take(i);
        for (Vec3& x : rest_)
            x -= centre / total;
    };
    centre_on();
    if (!frame_.empty()) {
        Mat3 moment = Mat3::Zero();
        for (const int i : frame_) {
            const Vec3& x = rest_[static_cast<std::size_t>(i)];
            moment += x * x.transpose();
        }
        const Vec3 extent = Eigen::SelfAdjointEigenSolver<Mat3>(moment).eigenvalues();
        if (extent[1] < 1e-8 * extent[2]) {
            frame_.clear();
            centre_on();
        }
    }
}

Mat3 ModalDamping::rotation(const NodeArray& position) const noexcept {
    // The rotation nearest to sum m (x - c) X^T (Kabsch); sum m X = 0, so c may be left out but for
    // rounding, which is why the first node stands for it.
    Mat3 moment = Mat3::Zero();
    const Vec3 near = position[0];
    const auto take = [&](std::size_t i) {
        moment += (position[i] - near) * (mass_[i] * rest_[i]).transpose();
    };
    for (const int i : frame_)
        take(static_cast<std::size_t>(i));
    for (std::size_t i = 0; frame_.empty() && i < rest_.size(); ++i)
        take(i);
    const Eigen::JacobiSVD<Mat3> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Vec3 sign(1, 1, 1);
    if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0)
        sign[2] = -1;
    return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

void ModalDamping::advance(double dt, NodeState& state) noexcept {
    pending_ += dt;
    if (pending_ < interval_)
        return;
    apply(pending_, state);
    pending_ = 0;
}

namespace {

/// Inertia about a centre, and what turns an angular momentum into a spin. Nodes in a line have no
/// spin about it.
Mat3 inverse_inertia(std::span<const int> nodes, std::span<const double> mass,
                     const NodeArray& position, const Vec3& center) noexcept {
    Mat3 inertia = Mat3::Zero();
    for (const int node : nodes) {
        const auto i = static_cast<std::size_t>(node);
        const Vec3 r = position[i] - center;
        inertia += mass[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
    Eigen::SelfAdjointEigenSolver<Mat3> axes;
    axes.computeDirect(inertia);
    Vec3 inverse = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
        if (axes.eigenvalues()[k] > 1e-8 * axes.eigenvalues()[2])
            inverse[k] = 1 / axes.eigenvalues()[k];
    return axes.eigenvectors() * inverse.asDiagonal() * axes.eigenvectors().transpose();
}

} // namespace

ModalDamping::Carrier ModalDamping::carrier(const NodeArray& position,
                                            const NodeArray& velocity) const noexcept {
    Carrier motion;
    if (nailed_.empty())
        return motion;
    double total = 0;
    for (const int node : nailed_) {
        const auto i = static_cast<std::size_t>(node);
        motion.center += mass_[i] * position[i];
        motion.velocity += mass_[i] * velocity[i];
        total += mass_[i];
    }
    motion.center /= total;
    motion.velocity /= total;
    Vec3 angular = Vec3::Zero();
    for (const int node : nailed_) {
        const auto i = static_cast<std::size_t>(node);
        angular += mass_[i] * (position[i] - motion.center).cross(velocity[i]);
    }
    motion.spin = inverse_inertia(nailed_, mass_, position, motion.center) * angular;
    return motion;
}

void ModalDamping::give(const Vec3& momentum, const Vec3& angular, const Carrier& to,
                        NodeState& state) const noexcept {
    double total = 0;
    for (const int node : nailed_)
        total += mass_[static_cast<std::size_t>(node)];
    const Vec3 gained = momentum / total;
    const Vec3 spun = inverse_inertia(nailed_, mass_, state.position, to.center) * angular;
    for (const int node : nailed_) {
        const auto i = static_cast<std::size_t>(node);
        state.velocity[i] += gained + spun.cross(state.position[i] - to.center);
    }
}

void ModalDamping::apply(double dt, NodeState& state) noexcept {
    const RigidMotions rigid([&](std::size_t i) { return mass_[i]; }, inverse_mass_, held_,
                             state.position);
    const std::size_t nodes = mass_.size();
    const Carrier frame = carrier(state.position, state.velocity);
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    for (std::size_t i = 0; i < nodes; ++i)
        if (inverse_mass_[i] != 0) {
            const Vec3 p = mass_[i] * (state.velocity[i] - frame.at(state.position[i]));
            linear += p;
            angular += (state.position[i] - rigid.pivot()).cross(p);
        }
    const RigidMotions::Motion carried = rigid.of(linear, angular);
    const Mat3 turn = rotation(state.position);
    if (!turn.allFinite())
        return; // nor is the body: its world will see

    for (std::size_t i = 0; i < nodes; ++i) {
        Vec3 own = Vec3::Zero();
        if (inverse_mass_[i] != 0)
            own = turn.transpose() * (state.velocity[i] - frame.at(state.position[i]) -
                                      rigid.at(carried, state.position[i]));
        Eigen::Map<Vec3>(momentum_.data() + 3 * i) = mass_[i] * own;
        const double rest = std::expm1(-2 * rest_decay_ * dt);
        Eigen::Map<Vec3>(change_.data() + 3 * i) = rest * own;
    }
    const bool wide = has_avx2();
    for (std::size_t k = 0; k < decay_.size(); k += kTile)
        (wide ? dot_wide : dot_narrow)(&shape_[k * rows_], momentum_.data(), rows_, &amplitude_[k]);
    for (std::size_t k = 0; k < decay_.size(); ++k)
        amplitude_[k] *= std::exp(-2 * decay_[k] * dt) - std::exp(-2 * rest_decay_ * dt);
    for (std::size_t k = 0; k < decay_.size(); k += kTile)
        (wide ? add_wide : add_narrow)(&shape_[k * rows_], &amplitude_[k], rows_, change_.data());

    // Modes carry no momentum at rest; deformed, they carry a little, which is left out.
    linear.setZero();
    angular.setZero();
    for (std::size_t i = 0; i < nodes; ++i)
        if (inverse_mass_[i] != 0) {
            const Vec3 p = mass_[i] * (turn * Eigen::Map<const Vec3>(change_.data() + 3 * i));
            linear += p;
            angular += (state.position[i] - rigid.pivot()).cross(p);
        }
    const RigidMotions::Motion surplus = rigid.of(linear, angular);
    Vec3 lost = Vec3::Zero(), turned = Vec3::Zero();
    for (std::size_t i = 0; i < nodes; ++i)
        if (inverse_mass_[i] != 0) {
            const Vec3 change = turn * Eigen::Map<const Vec3>(change_.data() + 3 * i) -
                                rigid.at(surplus, state.position[i]);
            state.velocity[i] += change;
            lost -= mass_[i] * change;
            turned -= mass_[i] * (state.position[i] - frame.center).cross(change);
        }
    if (!nailed_.empty())
        give(lost, turned, frame, state);
}

} // namespace ode::soft
