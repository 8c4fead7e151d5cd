#pragma once

#include "integrate/node_state.h"

namespace ode::soft {

/// The rigid motions that a body's held nodes leave it: what damping must not brake. Free: six. One
/// node held: rotations about it. Two: rotations about the line through them. More: none (nodes in
/// one line count as holding).
class RigidMotions {
public:
    struct Motion {
        Vec3 velocity = Vec3::Zero(); ///< of the pivot [m/s]
        Vec3 spin = Vec3::Zero();     ///< [rad/s]
    };

    /// @param weight  weight(i) of a node; only its ratio to others matters. Nodes of inverse mass
    ///                0 have none.
    /// @param held    the nodes of inverse mass 0.
    template <class Weight>
    RigidMotions(Weight weight, std::span<const double> inverse_mass, std::span<const int> held,
                 const NodeArray& position) noexcept
        : held_(held.size()) {
        if (held_ > 2)
            return;
        for (std::size_t i = 0; i < inverse_mass.size(); ++i)
            if (inverse_mass[i] != 0) {
                total_ += weight(i);
                pivot_ += weight(i) * position[i];
            }
        if (total_ == 0)
            return;
        pivot_ /= total_;
        if (held_ > 0)
            pivot_ = position[static_cast<std::size_t>(held[0])];
        Mat3 inertia = Mat3::Zero();
        for (std::size_t i = 0; i < inverse_mass.size(); ++i)
            if (inverse_mass[i] != 0) {
                const Vec3 r = position[i] - pivot_;
                inertia += weight(i) * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
            }
        if (held_ == 2) {
            const Vec3 axis = position[static_cast<std::size_t>(held[1])] - pivot_;
            inverse_inertia_ = axis * axis.transpose() / axis.dot(inertia * axis);
        } else {
            inverse_inertia_ = inertia.ldlt().solve(Mat3::Identity());
        }
    }

    /// The motion of given momentum and angular momentum about pivot(), in units of the weight.
    Motion of(const Vec3& momentum, const Vec3& angular) const noexcept {
        if (held_ > 2 || total_ == 0)
            return {};
        return {held_ > 0 ? Vec3(Vec3::Zero()) : Vec3(momentum / total_),
                inverse_inertia_ * angular};
    }

    Vec3 at(const Motion& motion, const Vec3& x) const noexcept {
        return motion.velocity + motion.spin.cross(x - pivot_);
    }

    const Vec3& pivot() const noexcept { return pivot_; } ///< centre of the weight, or held [m]

private:
    std::size_t held_;
    double total_ = 0;
    Vec3 pivot_ = Vec3::Zero();
    Mat3 inverse_inertia_ = Mat3::Zero();
};

} // namespace ode::soft
