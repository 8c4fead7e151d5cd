#pragma once

#include "model/elastic_model.h"

#include <cmath>

namespace ode::soft {

/// One mode of a linear body, x'' + 2 zeta w x' + w^2 x = 0 on each axis: a unit mass on a spring
/// to the origin, for looking at what a method makes of it.
class Oscillator final : public ElasticModel {
public:
    Oscillator(double omega, double damping_ratio) noexcept
        : stiffness_(omega * omega), damping_(2 * damping_ratio * omega) {}

    std::size_t node_count() const noexcept override { return 1; }
    std::span<const double> mass() const noexcept override { return {&kMass, 1}; }
    StrainExtremes add_force(const NodeArray& position, const NodeArray& velocity,
                             NodeArray& force) const noexcept override {
        force[0] -= stiffness_ * position[0] + damping_ * velocity[0];
        return {};
    }
    double energy(const NodeArray& position) const noexcept override {
        return stiffness_ / 2 * position[0].squaredNorm();
    }
    BlockMatrix tangent_pattern() const override {
        static constexpr int kNode = 0;
        return BlockMatrix({&kNode, 1}, 1, 1);
    }
    void add_tangent(const NodeArray&, double elastic, double viscous,
                     BlockMatrix& out) const noexcept override {
        out.add(0, 0, (elastic * stiffness_ + viscous * damping_) * Mat3::Identity());
    }
    Eigen::SparseMatrix<double> consistent_mass() const override {
        BlockMatrix m = tangent_pattern();
        m.add(0, 0, kMass * Mat3::Identity());
        return m.take();
    }
    double max_frequency_bound() const override { return std::sqrt(stiffness_); }

private:
    static constexpr double kMass = 1; ///< [kg]
    double stiffness_;                 ///< [N/m]
    double damping_;                   ///< [N s/m]
};

} // namespace ode::soft
