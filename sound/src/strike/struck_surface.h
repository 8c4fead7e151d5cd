#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace ode::sound {

using Vec3 = Eigen::Vector3d;

/// The surface of a body that is struck, in the body's frame: where a contact lies on it, how it is
/// curved there, and what a push there gives each mode.
class StruckSurface {
public:
    struct Place {
        int triangle = 0;
        Vec3 weight = Vec3::Zero(); ///< of its corners
        Vec3 point = Vec3::Zero();  ///< on the surface [m]
        double distance = 0.0;      ///< of the point looked for [m]
    };

    StruckSurface() = default;
    /// @param node      [m].  @param triangle  outward.
    /// @param shape     x y z of every node, mode after mode [kg^-1/2].
    StruckSurface(std::vector<Vec3> node, std::vector<std::array<int, 3>> triangle,
                  std::span<const double> shape);

    /// The place nearest to a point, among those whose outward side looks along `outward` if there
    /// are any: a thin wall is struck from the side that the contact is on.
    Place nearest(const Vec3& point, const Vec3& outward) const noexcept;

    /// Where a line of force that acts on the body meets its surface and goes in, the last such
    /// place it comes from; nearest() where it misses.
    Place entered(const Vec3& origin, const Vec3& force) const noexcept;

    /// Half the sum of the principal curvatures, positive where the body bulges [1/m].
    double curvature(const Place& place) const noexcept;

    /// push[k] += shape of mode k at the place . impulse.
    void project(const Place& place, const Vec3& impulse, std::span<float> push) const noexcept;

    /// The transpose of it: sum over the modes of shape times q.
    Vec3 motion(const Place& place, std::span<const float> q) const noexcept;

    std::size_t modes() const noexcept { return modes_; }
    double radius() const noexcept { return radius_; } ///< of the farthest node [m]
    std::span<const Vec3> nodes() const noexcept { return node_; }
    std::span<const std::array<int, 3>> triangles() const noexcept { return triangle_; }

private:
    void find_curvature();

    std::vector<Vec3> node_, normal_; ///< normal of a node: the mean of its triangles'
    std::vector<std::array<int, 3>> triangle_;
    std::vector<Vec3> facing_;                    ///< unit normal of each triangle
    std::vector<Vec3> middle_;                    ///< of each triangle [m]
    std::array<std::vector<float>, 3> middle_of_; ///< x, y, z of the same
    std::array<std::vector<float>, 3> facing_of_; ///< and of facing_
    std::vector<double> reach_;                   ///< of a triangle from its middle [m]
    std::vector<double> curvature_;               ///< of each node [1/m]
    std::size_t modes_ = 0;
    double radius_ = 0.0;
    double longest_ = 0.0;     ///< reach
    std::vector<float> shape_; ///< (3 node + axis) * modes + mode
};

} // namespace ode::sound
