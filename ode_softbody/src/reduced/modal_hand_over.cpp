// From the motion of nodes to that of a frame and its modes, and back.
#include "reduced/modal_motion.h"
#include "reduced/mode_rows.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>

namespace ode::soft {

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
    if (bends_)
        cubic_->restart();
    const auto following = followers();
    // Of what follows by itself, modes that are neither kept nor driven have their part too.
    for (std::size_t n = 0; following && n < b.nodes(); ++n) {
        project(b, n, -b.mass[n] * following->place.at(n), state_.amplitude);
        project(b, n, -b.mass[n] * following->speed.at(n), state_.rate);
    }
    const Spread rate(b, awake(state_.rate), single_[1]);
    double lost = 0;
    for (std::size_t n = 0; n < b.nodes(); ++n) {
        const Vec3 local = back * (nodes.position[n] - state_.center);
        Vec3 left = back * (nodes.velocity[n] - state_.velocity) - spin.cross(local) - rate.at(n);
        if (following)
            left -= following->speed.at(n);
        lost += b.mass[n] * left.squaredNorm();
    }
    return lost;
}

void ModalMotion::give(NodeState& nodes) const noexcept {
    const ModalBasis& b = *basis_;
    const Spread moved(b, awake(state_.amplitude), single_[0]),
        rate(b, awake(state_.rate), single_[1]);
    const auto following = followers();
    const Mat3 turn = state_.turn.toRotationMatrix();
    Mat3 inertia = Mat3::Zero();
    Vec3 left = state_.spin_momentum, drift = Vec3::Zero();
    for (std::size_t n = 0; n < b.nodes(); ++n) {
        Vec3 arm = b.rest[n] + moved.at(n), own = rate.at(n);
        if (following) {
            arm += following->place.at(n);
            own += following->speed.at(n);
        }
        arm = turn * arm;
        own = turn * own;
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

void ModalMotion::place(std::span<const int> nodes, NodeState& out) const noexcept {
    const Mat3 turn = state_.turn.toRotationMatrix();
    const Vec3 spin = this->spin();
    const Spread moved(*basis_, awake(state_.amplitude), single_[0]);
    const Spread rate(*basis_, awake(state_.rate), single_[1]);
    const auto following = followers();
    for (const int node : nodes) {
        const auto n = static_cast<std::size_t>(node);
        Vec3 arm = basis_->rest[n] + moved.at(n), own = rate.at(n);
        if (following) {
            arm += following->place.at(n);
            own += following->speed.at(n);
        }
        arm = turn * arm;
        out.position[n] = state_.center + arm;
        out.velocity[n] = state_.velocity + spin.cross(arm) + turn * own;
    }
}

} // namespace ode::soft
