#pragma once

#include "dsp/storage.h"
#include "source/surface.h"
#include "transfer/boundary.h"

#include <complex>
#include <memory>

namespace ode::sound {

/// What a node's sound has more in front of it than behind: p = (flow + lean . r) / R before the
/// derivative, r the unit way to the ear.
///
/// kNormal is Kirchhoff's integral with p = rho c v on the surface: lean = n flow, right for bodies
/// large against the wavelength. kCarried is right for small ones, too: at low frequencies the lean
/// is the derivative of the flow times the time that sound takes over CarriedAir's shift, so that
/// monopoles and dipoles are exact; a high-pass of the body's own length lets it end in
/// Kirchhoff's. Even pulsation has another length than shaking, and is taken out and filtered by
/// itself.
enum class Leaning { kNone, kNormal, kCarried };

class Lean {
public:
    /// @param point, area  of the surface's nodes at rest, points [m], [m^2].
    /// @param rate         of samples [Hz].  @param speed  of sound [m/s].
    Lean(Leaning leaning, const Surface& surface, const double* point, const double* area,
         double rate, double speed);

    /// False for a surface that has no inside: `lean` is zero.
    bool leans() const noexcept { return leans_; }

    /// Forgets what was heard before.
    void reset() noexcept;
    /// Takes over how the body is turned.
    void aim(const double* point, const double* area) noexcept;
    /// Next sample. @param flow  of all nodes [m^3/s]; read again through flow() if nothing
    /// filters.
    void follow(const double* flow) noexcept;

    /// What follow() makes of a steady tone: own times a node's flow and common times its share of
    /// all flow.
    struct Response {
        std::complex<double> own, common;
    };
    Response response(double frequency, double rate) const noexcept;
    double share(int node) const noexcept { return share_[static_cast<std::size_t>(node)]; }
    /// Of the high-pass that shaking goes through; 0: none [s].
    double time() const noexcept { return shake_time_; }

    const double* direction() const noexcept { return direction_.data(); } ///< points [-]
    const double* flow() const noexcept { return heard_; }                 ///< [m^3/s]

private:
    struct HighPass {
        double keep = 0.0, pass = 0.0;
        HighPass() = default;
        HighPass(double time, double rate) noexcept;
        std::complex<double>
        response(double angle) const noexcept; ///< @param angle  a sample [rad]
    };

    void aim_normals(const double* area);
    void aim_at_air(const Surface& surface, const double* point, const double* area, double rate,
                    double speed);

    /// What a shape has in common with all like it, however they are turned.
    struct Carried {
        AlignedVector along_area, along_way, share;
        double pulse_length = 0.0, shake_length = 0.0; ///< [m]; 0: there is none
    };
    static Carried carry(const BoundaryMesh& mesh, int nodes, const double* point,
                         const double* area);
    static std::shared_ptr<const Carried> shared(const BoundaryMesh& mesh, int nodes,
                                                 const double* point, const double* area);

    bool leans_ = false;
    bool filters_ = false;
    AlignedVector along_area_; ///< direction = along_area A + along_way (x - mean of x)
    AlignedVector along_way_;
    AlignedVector share_; ///< of each node in the surface's area
    AlignedVector direction_;
    AlignedVector before_, after_, sum_;
    std::shared_ptr<const Carried> carried_; ///< keeps it for the next body of this shape
    HighPass shake_, pulse_;
    double shake_time_ = 0.0;
    double pulse_before_ = 0.0, pulse_after_ = 0.0, pulse_shaken_ = 0.0;
    const double* heard_ = nullptr;
};

} // namespace ode::sound
