#include "reduced/modal_motion.h"

#include "reduced/mode_rows.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode::soft {
namespace {

// Turned by no more at once: the midpoint rule then errs by a millionth of a turn a second.
constexpr double kTurn = 0.01; ///< [rad]
// Coupling of two modes below this share of the gap between them leaves either as it is.
constexpr double kWeak = 0.01;
constexpr double kMixedAtOnce = 0.5; ///< [rad], of the gap or the coupling

std::pair<double, double> cosine_and_sine(double x) noexcept {
    constexpr double kSmall = 1e-3; // the series are as good as a double
    if (std::fabs(x) > kSmall)
        return {std::cos(x), std::sin(x)};
    return {1 - x * x / 2 + x * x * x * x / 24, x - x * x * x / 6};
}

} // namespace

ModalMotion::ModalMotion(std::shared_ptr<const ModalBasis> basis)
    : basis_(std::move(basis)), oscillators_(basis_->omega, basis_->decay), awake_(basis_->columns),
      load_(basis_->columns, 0.0), impulse_(basis_->columns, 0.0), settled_(basis_->columns, 0.0) {
    for (AlignedVector<float>& q : single_)
        q.assign(basis_->columns, 0.0f);
    state_.amplitude.assign(basis_->columns, 0.0);
    state_.rate.assign(basis_->columns, 0.0);
    ahead_ = kept_ = state_;
    if (!basis_->held)
        inverse_inertia_ = basis_->inertia.inverse();
}

void ModalMotion::fit_frame(const NodeArray& position, std::span<const int> held) noexcept {
    // The rotation nearest to sum m (x - c) X^T (Kabsch): about it sum m X x u = 0.
    Vec3 there = Vec3::Zero(), here = Vec3::Zero();
    double total = 0;
    const auto each = [&](auto visit) {
        for (const int node : held)
            visit(static_cast<std::size_t>(node));
        for (std::size_t n = 0; held.empty() && n < basis_->nodes(); ++n)
            visit(n);
    };
    each([&](std::size_t n) {
        there += basis_->mass[n] * position[n];
        here += basis_->mass[n] * basis_->rest[n];
        total += basis_->mass[n];
    });
    there /= total;
    here /= total;
    Mat3 moment = Mat3::Zero();
    each([&](std::size_t n) {
        moment += basis_->mass[n] * (position[n] - there) * (basis_->rest[n] - here).transpose();
    });
    const Eigen::JacobiSVD<Mat3> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Vec3 sign(1, 1, 1);
    if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0)
        sign[2] = -1;
    const Mat3 turn = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
    state_.turn = Quat(turn);
    state_.turn.normalize();
    state_.center = there - state_.turn * here;
}

double ModalMotion::take(const NodeState& nodes, std::span<const int> held) noexcept {
    const ModalBasis& b = *basis_;
    foreseen_ = 0;
    awake_ = b.columns;
    fit_frame(nodes.position, held);
    const Mat3 back = state_.turn.toRotationMatrix().transpose();
    Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero(), turned = Vec3::Zero();
    Mat3 joint = Mat3::Zero();
    for (std::size_t n = 0; !b.held && n < b.nodes(); ++n)
        momentum += b.mass[n] * nodes.velocity[n];
    state_.velocity = b.held ? Vec3(Vec3::Zero()) : Vec3(momentum / b.total_mass);
    // The spin that leaves vibrations without angular momentum to first order:
    // sum m X x R^T (v - c') = sum m X x (w x (X + u)).
    for (std::size_t n = 0; !b.held && n < b.nodes(); ++n) {
        const Vec3 arm = nodes.position[n] - state_.center;
        const Vec3 own = nodes.velocity[n] - state_.velocity;
        const Vec3 local = back * arm;
        angular += b.mass[n] * arm.cross(own);
        turned += b.mass[n] * b.rest[n].cross(back * own);
        joint +=
            b.mass[n] * (b.rest[n].dot(local) * Mat3::Identity() - local * b.rest[n].transpose());
    }
    const Vec3 spin = b.held ? Vec3(Vec3::Zero()) : Vec3(joint.partialPivLu().solve(turned));
    state_.spin_momentum = angular;
    std::fill(state_.amplitude.begin(), state_.amplitude.end(), 0.0);
    std::fill(state_.rate.begin(), state_.rate.end(), 0.0);
    for (std::size_t n = 0; n < b.nodes(); ++n) {
        const Vec3 local = back * (nodes.position[n] - state_.center);
        project(b, n, b.mass[n] * (local - b.rest[n]), state_.amplitude);
        project(b, n,
                b.mass[n] * (back * (nodes.velocity[n] - state_.velocity) - spin.cross(local)),
                state_.rate);
    }
    const Spread rate(b, awake(state_.rate), single_[1]);
    double lost = 0;
    for (std::size_t n = 0; n < b.nodes(); ++n) {
        const Vec3 local = back * (nodes.position[n] - state_.center);
        lost += b.mass[n] *
                (back * (nodes.velocity[n] - state_.velocity) - spin.cross(local) - rate.at(n))
                    .squaredNorm();
    }
    return lost;
}

void ModalMotion::give(NodeState& nodes) const noexcept {
    const ModalBasis& b = *basis_;
    const Spread moved(b, awake(state_.amplitude), single_[0]),
        rate(b, awake(state_.rate), single_[1]);
    const Mat3 turn = state_.turn.toRotationMatrix();
    Mat3 inertia = Mat3::Zero();
    Vec3 left = state_.spin_momentum, drift = Vec3::Zero();
    for (std::size_t n = 0; n < b.nodes(); ++n) {
        const Vec3 arm = turn * (b.rest[n] + moved.at(n));
        const Vec3 own = turn * rate.at(n);
        nodes.position[n] = state_.center + arm;
        nodes.velocity[n] = own;
        inertia += b.mass[n] * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
        left -= b.mass[n] * arm.cross(own);
        drift += b.mass[n] * own;
    }
    if (b.held)
        return;
    const Vec3 spin = inertia.ldlt().solve(left);
    const Vec3 velocity = state_.velocity - drift / b.total_mass; // drift: rounding of the modes
    for (std::size_t n = 0; n < b.nodes(); ++n)
        nodes.velocity[n] += velocity + spin.cross(nodes.position[n] - state_.center);
}

void ModalMotion::place(std::span<const int> nodes, std::size_t columns,
                        NodeState& out) const noexcept {
    const Mat3 turn = state_.turn.toRotationMatrix();
    const Vec3 spin = this->spin();
    const Spread moved(*basis_, std::span(state_.amplitude).first(columns), single_[0]);
    const Spread rate(*basis_, std::span(state_.rate).first(columns), single_[1]);
    for (const int node : nodes) {
        const auto n = static_cast<std::size_t>(node);
        const Vec3 arm = turn * (basis_->rest[n] + moved.at(n));
        out.position[n] = state_.center + arm;
        out.velocity[n] = state_.velocity + spin.cross(arm) + turn * rate.at(n);
    }
}

void ModalMotion::set_load(const Vec3& gravity, const NodeArray* forces) noexcept {
    const ModalBasis& b = *basis_;
    steady_force_ = b.total_mass * gravity;
    steady_torque_.setZero();
    std::fill(load_.begin(), load_.end(), 0.0);
    const Mat3 back = state_.turn.toRotationMatrix().transpose();
    if (b.held) {
        const Vec3 local = back * gravity;
        for (std::size_t k = 0; k < b.columns; ++k)
            for (std::size_t axis = 0; axis < 3; ++axis)
                load_[k] += b.inertia_share[axis * b.columns + k] * local[static_cast<int>(axis)];
    }
    const Spread moved(b, awake(state_.amplitude), single_[0]);
    for (std::size_t n = 0; forces && n < b.nodes(); ++n) {
        const Vec3 f = (*forces)[n];
        if (f.isZero(0))
            continue;
        steady_force_ += f;
        const Vec3 local = back * f;
        project(b, n, local, load_);
        steady_torque_ += (state_.turn * (b.rest[n] + moved.at(n))).cross(f);
    }
    loaded_ = std::any_of(load_.begin(), load_.end(), [](double f) { return f != 0; });
}

void ModalMotion::keep() noexcept {
    copy(state_, kept_);
    kept_awake_ = awake_;
}

void ModalMotion::take_back() noexcept {
    for (AlignedVector<double>* q :
         {&state_.amplitude, &state_.rate, &ahead_.amplitude, &ahead_.rate})
        std::fill(q->begin(), q->end(), 0.0);
    awake_ = kept_awake_;
    copy(kept_, state_);
    foreseen_ = 0;
}

void ModalMotion::copy(const ModalState& from, ModalState& to) const noexcept {
    to.center = from.center;
    to.velocity = from.velocity;
    to.turn = from.turn;
    to.spin_momentum = from.spin_momentum;
    std::copy_n(from.amplitude.begin(), awake_, to.amplitude.begin());
    std::copy_n(from.rate.begin(), awake_, to.rate.begin());
}

const ModalState& ModalMotion::foresee(double dt) noexcept {
    if (foreseen_ == dt)
        return ahead_;
    copy(state_, ahead_); // what sleeps is zero in both
    foreseen_ = 0;
    advance(dt);
    std::swap(state_, ahead_);
    foreseen_ = dt;
    return ahead_;
}

void ModalMotion::push(const ContactShare& forces, const NodeState& nodes, double dt) noexcept {
    const Mat3 back = state_.turn.toRotationMatrix().transpose();
    std::fill(impulse_.begin(), impulse_.end(), 0.0);
    forces.each([&](std::size_t n, const auto& f) {
        const Vec3 impulse = dt * f;
        project(*basis_, n, back * impulse, impulse_);
        if (basis_->held)
            return;
        state_.velocity += impulse / basis_->total_mass;
        state_.spin_momentum += (nodes.position[n] - state_.center).cross(impulse);
    });
    awake_ = basis_->columns;
    unpruned_ = 0;
    if (foreseen_ != dt) {
        for (std::size_t k = 0; k < awake_; ++k)
            state_.rate[k] += impulse_[k];
        foreseen_ = 0;
        return;
    }
    oscillators_.respond(dt, impulse_, ahead_.amplitude, ahead_.rate);
    if (!basis_->held)
        fly(dt);
    ahead_.center = state_.center;
    ahead_.velocity = state_.velocity;
    ahead_.turn = state_.turn;
    ahead_.spin_momentum = state_.spin_momentum;
}

Vec3 ModalMotion::spin_of(const Vec3& momentum) const noexcept {
    if (basis_->held)
        return Vec3::Zero();
    return state_.turn * (inverse_inertia_ * (state_.turn.conjugate() * momentum));
}

void ModalMotion::turn_by(const Vec3& spin, double dt) noexcept {
    const Vec3 half = dt / 2 * spin;
    const double square = half.squaredNorm();
    if (square == 0)
        return;
    // No more than kTurn: sine and cosine to the sixth power of half of it, 1e-16.
    const double cosine = 1 - square / 2 + square * square / 24;
    const Vec3 sine = (1 - square / 6 + square * square / 120) * half;
    state_.turn = Quat(cosine, sine.x(), sine.y(), sine.z()) * state_.turn;
    state_.turn.normalize();
}

void ModalMotion::fly(double dt) noexcept {
    const Vec3 acceleration = steady_force_ / basis_->total_mass;
    state_.center += dt * (state_.velocity + dt / 2 * acceleration);
    state_.velocity += dt * acceleration;
    state_.spin_momentum += dt * steady_torque_;
    const double steps = std::ceil(spin().norm() * dt / kTurn);
    if (!(steps >= 1))
        return;
    const double h = dt / steps;
    for (double i = 0; i < steps; ++i) { // the spin turns with the body while its momentum stays
        const Quat before = state_.turn;
        turn_by(spin(), h / 2);
        const Vec3 middle = spin();
        state_.turn = before;
        turn_by(middle, h);
    }
}

void ModalMotion::stretch_by_spin(const Vec3& w) noexcept {
    const double* slope = basis_->inertia_slope.data();
    const std::size_t n = basis_->columns;
    const std::size_t heard = basis_->audible_columns; // above, bodies hardly stretch
    const double xx = w.x() * w.x() / 2, yy = w.y() * w.y() / 2, zz = w.z() * w.z() / 2;
    const double xy = w.x() * w.y(), xz = w.x() * w.z(), yz = w.y() * w.z();
    for (std::size_t k = 0; k < heard; ++k)
        settled_[k] += xx * slope[k] + yy * slope[n + k] + zz * slope[2 * n + k] +
                       xy * slope[3 * n + k] + xz * slope[4 * n + k] + yz * slope[5 * n + k];
}

int ModalMotion::pieces(const Vec3& spin, double dt) const noexcept {
    double most = 1;
    for (const ModalBasis::Gyration& pair : basis_->gyration) {
        const double strength = std::fabs(spin.dot(pair.coupling));
        const double gap = std::fabs(basis_->omega[static_cast<std::size_t>(pair.first)] -
                                     basis_->omega[static_cast<std::size_t>(pair.second)]);
        if (strength > kWeak * gap)
            most = std::fmax(most, std::fmax(strength, gap) * dt / kMixedAtOnce);
    }
    return static_cast<int>(std::ceil(most));
}

void ModalMotion::mix(const Vec3& spin, double dt) noexcept {
    // q_i'' = 2 w.g q_j' and its reverse: over many periods the two amplitudes turn into one
    // another by w.g a second.
    for (const ModalBasis::Gyration& pair : basis_->gyration) {
        const auto i = static_cast<std::size_t>(pair.first);
        const auto j = static_cast<std::size_t>(pair.second);
        const double strength = spin.dot(pair.coupling);
        const double wi = basis_->omega[i], wj = basis_->omega[j];
        if (!(std::fabs(strength) > kWeak * std::fabs(wi - wj)))
            continue;
        const auto [c, s] = cosine_and_sine(strength * dt);
        double &qi = state_.amplitude[i], &qj = state_.amplitude[j];
        double &vi = state_.rate[i], &vj = state_.rate[j];
        const double a = wi * qi, b = wj * qj, u = vi, v = vj;
        qi = (c * a + s * b) / wi;
        qj = (c * b - s * a) / wj;
        vi = c * u + s * v;
        vj = c * v - s * u;
    }
}

void ModalMotion::advance(double dt) noexcept {
    rest_what_died();
    if (foreseen_ == dt) {
        std::swap(state_, ahead_);
        foreseen_ = 0;
        return;
    }
    foreseen_ = 0;
    const Vec3 spin = state_.turn.conjugate() * this->spin();
    const bool spins = spin.squaredNorm() > 0;
    if (!basis_->held)
        fly(dt);
    const bool shifted = spins || loaded_;
    if (shifted) {
        std::copy(load_.begin(), load_.end(), settled_.begin());
        if (spins)
            stretch_by_spin(spin);
        for (std::size_t k = 0; k < awake_; ++k) {
            settled_[k] /= basis_->omega[k] * basis_->omega[k];
            state_.amplitude[k] -= settled_[k];
        }
    }
    const int parts = spins ? pieces(spin, dt) : 1;
    const double h = dt / parts;
    for (int i = 0; i < parts; ++i) {
        if (spins)
            mix(spin, h / 2);
        oscillators_.advance(h, std::span(state_.amplitude).first(awake_),
                             std::span(state_.rate).first(awake_));
        if (spins)
            mix(spin, h / 2);
    }
    for (std::size_t k = 0; shifted && k < awake_; ++k)
        state_.amplitude[k] += settled_[k];
}

void ModalMotion::rest_what_died() noexcept {
    constexpr int kPatience = 16;    // advances: pushes come in bursts
    constexpr double kShare = 1e-12; // of the energy
    const std::size_t heard = basis_->audible_columns;
    if (awake_ == heard || ++unpruned_ < kPatience)
        return;
    unpruned_ = 0;
    double above = 0;
    for (std::size_t k = heard; k < awake_; ++k) {
        const double a = basis_->omega[k] * state_.amplitude[k];
        above += a * a + state_.rate[k] * state_.rate[k];
    }
    if (above > 2 * kShare * (vibration_energy() + rigid_energy()))
        return;
    for (ModalState* state : {&state_, &ahead_})
        for (AlignedVector<double>* q : {&state->amplitude, &state->rate})
            std::fill(q->begin() + static_cast<std::ptrdiff_t>(heard), q->end(), 0.0);
    awake_ = heard;
}

double ModalMotion::vibration_energy() const noexcept {
    double sum = 0;
    for (std::size_t k = 0; k < awake_; ++k) {
        const double a = basis_->omega[k] * state_.amplitude[k];
        sum += a * a + state_.rate[k] * state_.rate[k];
    }
    return sum / 2;
}

double ModalMotion::rigid_energy() const noexcept {
    return (basis_->total_mass * state_.velocity.squaredNorm() + spin().dot(state_.spin_momentum)) /
           2;
}

double ModalMotion::largest_displacement() const noexcept {
    double sum = 0;
    for (std::size_t k = 0; k < awake_; ++k) {
        const double ahead = state_.rate[k] / basis_->omega[k];
        sum +=
            basis_->reach[k] * std::sqrt(state_.amplitude[k] * state_.amplitude[k] + ahead * ahead);
    }
    return sum;
}

double ModalMotion::largest_speed() const noexcept {
    double sum = 0;
    for (std::size_t k = 0; k < awake_; ++k) {
        const double ahead = state_.amplitude[k] * basis_->omega[k];
        sum += basis_->reach[k] * std::sqrt(state_.rate[k] * state_.rate[k] + ahead * ahead);
    }
    return sum + state_.velocity.norm() + basis_->radius * spin().norm();
}

double ModalMotion::displacement_envelope(std::span<const int> nodes) noexcept {
    for (std::size_t k = 0; k < awake_; ++k)
        settled_[k] = state_.rate[k] / basis_->omega[k];
    const Spread moved(*basis_, awake(state_.amplitude), single_[0]),
        swing(*basis_, awake(settled_), single_[1]);
    double most = 0;
    for (const int node : nodes) {
        const auto n = static_cast<std::size_t>(node);
        most = std::fmax(most, moved.at(n).squaredNorm() + swing.at(n).squaredNorm());
    }
    return std::sqrt(most);
}

double ModalMotion::inverse_mass(std::size_t node, const Vec3& direction) const noexcept {
    double sum = 0;
    for (std::size_t k = 0; k < basis_->modes; ++k) {
        double push = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            push +=
                static_cast<double>(basis_->row(node, axis)[k]) * direction[static_cast<int>(axis)];
        sum += push * push;
    }
    if (basis_->held)
        return sum;
    const Vec3 arm = basis_->rest[node].cross(direction);
    return sum + 1 / basis_->total_mass + arm.dot(inverse_inertia_ * arm);
}

} // namespace ode::soft
