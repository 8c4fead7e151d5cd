#include "couple/surface_drift.h"

#include <Eigen/SVD>

#include <cmath>

namespace ode::soft {
namespace {

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

Vec3 sum_over(const SurfaceNodes& nodes, const NodeArray& field) noexcept {
    Vec3 sum = Vec3::Zero();
    for (const int n : nodes.node)
        sum += field[index(n)];
    return sum;
}

double farthest_from(const Vec3& middle, const SurfaceNodes& nodes,
                     const NodeArray& field) noexcept {
    double most = 0;
    for (const int n : nodes.node)
        most = std::fmax(most, (field[index(n)] - middle).squaredNorm());
    return std::sqrt(most);
}

} // namespace

double fastest_between(const SurfaceNodes& a, const NodeArray& velocity_a, const SurfaceNodes& b,
                       const NodeArray& velocity_b) noexcept {
    const auto count = static_cast<double>(a.node.size() + b.node.size());
    const Vec3 mean = (sum_over(a, velocity_a) + sum_over(b, velocity_b)) / count;
    return farthest_from(mean, a, velocity_a) + farthest_from(mean, b, velocity_b);
}

Deformation deformation_of(const SoftSurface& surface, const NodeArray& position,
                           const NodeArray& velocity) noexcept {
    const SurfaceNodes& nodes = surface.nodes();
    const auto count = static_cast<double>(nodes.node.size());
    Vec3 rest_middle = Vec3::Zero();
    for (const int n : nodes.node)
        rest_middle += surface.rest()[index(n)] / count;
    const Vec3 middle = sum_over(nodes, position) / count;
    const Vec3 drift = sum_over(nodes, velocity) / count;
    Mat3 correlation = Mat3::Zero();
    Mat3 inertia = Mat3::Zero();
    Vec3 swirl = Vec3::Zero();
    for (const int n : nodes.node) {
        const Vec3 arm = position[index(n)] - middle;
        correlation += arm * (surface.rest()[index(n)] - rest_middle).transpose();
        inertia += arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
        swirl += arm.cross(velocity[index(n)] - drift);
    }
    // Kabsch: the rotation nearest to the correlation.
    const Eigen::JacobiSVD<Mat3> svd(correlation, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 flip = Mat3::Identity();
    flip(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
    const Mat3 turn = svd.matrixU() * flip * svd.matrixV().transpose();
    const Vec3 spin = inertia.inverse() * swirl;
    Deformation worst{0, 0};
    for (const int n : nodes.node) {
        const Vec3 arm = position[index(n)] - middle;
        const Vec3 moved = arm - turn * (surface.rest()[index(n)] - rest_middle);
        const Vec3 motion = velocity[index(n)] - drift - spin.cross(arm);
        worst.displacement = std::fmax(worst.displacement, moved.squaredNorm());
        worst.speed = std::fmax(worst.speed, motion.squaredNorm());
    }
    return {std::sqrt(worst.displacement), std::sqrt(worst.speed)};
}

} // namespace ode::soft
