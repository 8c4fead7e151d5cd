#pragma once

#include "transfer/boundary.h"
#include "transfer/multipole.h"

#include <complex>
#include <span>
#include <vector>

namespace ode::sound {

/// Sums up what points of a surface send outwards, as spherical waves about the origin: by the
/// addition theorem a source's coefficient of h_l(kr) Y_lm is -ik j_l(kx) Y_lm(x). Several waves
/// are summed at once, of any frequencies, because points are what takes time.
class OutgoingSum {
public:
    struct Wave {
        double k;  ///< [1/m]
        int order; ///< highest degree
    };

    /// @param radius  of the sphere round all points [m].
    OutgoingSum(std::span<const Wave> waves, double radius);

    /// Adds a point: for every wave pressure times d/dn (j Y) less slope times j Y, times the area
    /// that it stands for (Kirchhoff and Helmholtz's integral).
    /// @param axis  n, of any length.
    void add(const Vec3& place, const Vec3& axis, std::span<const std::complex<double>> pressure,
             std::span<const std::complex<double>> slope);

    /// The wave's coefficients times h_l(k radius): pressure on the sphere by harmonic.
    std::vector<std::complex<double>> on_sphere(std::size_t wave) const;

    /// What a listener at twice the radius and beyond can tell: waves of degree l > kr fade as
    /// (R/r)^(l+1).
    static int order_for(double kr);

private:
    std::vector<Wave> wave_;
    double radius_;
    int highest_ = 0;
    double step_; ///< of differences along the axis [m]
    std::vector<double> harmonic_[3];
    std::vector<std::vector<std::complex<double>>> sum_;
};

} // namespace ode::sound
