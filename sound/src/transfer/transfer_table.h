#pragma once

#include "transfer/boundary.h"

#include <complex>
#include <span>
#include <vector>

namespace ode::sound {

/// What one mode makes audible at one place:
/// p(t) = velocity q'(t - r/c) + acceleration q''(t - r/c), r the way from TransferTable::centre.
/// At the mode's own frequency this is the complex gain of its wave; a wave that grows as the
/// motion's acceleration, as those of compact bodies do, is right at all others too.
struct ModeGain {
    float velocity;     ///< [Pa s] per unit of q', q mass-normalised: [Pa s / (kg^1/2 m)]
    float acceleration; ///< [Pa s^2 / (kg^1/2 m)]
};

/// How every mode of a body sounds, in all directions and at any distance beyond near_limit():
/// outgoing spherical waves about its centre, in the body's frame. Plain data.
struct TransferTable {
    struct Mode {
        double frequency;         ///< [Hz]
        int order;                ///< highest degree of its harmonics
        std::size_t first;        ///< its (order + 1)^2 coefficients
        std::size_t first_degree; ///< its order + 1 entries of per_sphere
    };

    Vec3 centre = Vec3::Zero(); ///< [m]
    double radius = 0.0;        ///< of the sphere round the body [m]
    double speed = 343.0;       ///< of sound [m/s]
    double boundary_limit =
        0.0;           ///< modes above were not solved for: p = rho c v on the surface [Hz]
    int triangles = 0; ///< of the boundary elements
    std::vector<Mode> mode;
    /// Pressure on that sphere per unit modal acceleration, by harmonic; harmonic_count() a mode.
    std::vector<std::complex<float>> coefficient;
    std::vector<std::complex<double>> per_sphere; ///< e^{ikR} / (h_l(kR) e^{ikR}), by degree

    /// The next mode, radius and speed being set. @param on_sphere  its pressure by harmonic, to
    /// the degree `order`.
    void add(double frequency, int order, std::span<const std::complex<double>> on_sphere);

    /// Nearer to the centre the table holds the values of its sphere: the series diverges inside.
    /// Waves that fade within a radius or so (high degrees of low modes) are left out of it.
    double near_limit() const noexcept { return radius; }

    /// Gains of all modes at a place in the body's frame [m]. No allocation.
    void gains(const Vec3& place, std::span<ModeGain> out) const noexcept;
    /// Of the finest pattern, on the sphere.
    int lobes() const noexcept;

    /// Complex pressure of a mode per unit modal acceleration, retardation by r/c taken out.
    std::complex<double> gain(int mode, const Vec3& place) const noexcept;
};

/// A closed surface and how the modes move it.
struct ModalSurface {
    BoundaryMesh mesh;
    std::vector<double> frequency; ///< [Hz], ascending
    std::vector<double> shape;     ///< x y z of every node, mode after mode; mass-normalised
};

struct TransferOptions {
    double density = 1.21;     ///< of air [kg/m^3]
    double speed = 343.0;      ///< of sound [m/s]
    int max_triangles = 1200;  ///< finer surfaces are coarsened, coarse ones cut up to this
    double per_wavelength = 3; ///< longest edges; modes with fewer go by p = rho c v
};

/// Solves the boundary elements of every mode; those within 1 % of frequency share a matrix. Half a
/// second a matrix for 1200 triangles, with its cube.
/// @throws std::invalid_argument with a sentence: open surface, sizes that don't fit.
TransferTable make_transfer_table(const ModalSurface& surface, const TransferOptions& options = {});

} // namespace ode::sound
