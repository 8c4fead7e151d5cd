#pragma once

#include "strike/roughness.h"

#include <array>
#include <memory>

namespace ode::sound {

/// A contact that bears a load and goes along two surfaces.
struct ScrapeAim {
    double load = 0.0;                ///< [N]
    std::array<double, 2> speed = {}; ///< of the contact along each surface [m/s]
    double stiffness = 0.0;           ///< of Hertz's contact, bearing_stiffness() [N/m]
    double radius = 0.0;              ///< of the contact, bearing_radius() [m]
    double mass = 0.0;                ///< effective, of both along the normal [kg]
    double damping = 0.1;             ///< of the mass on the stiffness, of the critical [-]
};

/// The force of a contact that slides or rolls: bodies ride up and down what is rough of both
/// surfaces, a mass m on Hertz's spring k,
///
///     m z'' = k (y - z) + c (y' - z'),   y = y1(x1) + y2(x2),   u = k (y - z),
///
/// so that the force grows as the acceleration of what passes up to sqrt(k/m) and as its height
/// beyond. It adds to the load N, which it can't outdo: N u / sqrt(N^2 + u^2); bodies don't pull.
/// Heights are means over the width of the contact, which is all it feels (P. J. Remington, J.
/// Sound Vib. 46, 1976). The tangential force goes with the normal one, by the same ratio.
///
/// Not in it: stick and slip (squeaks), and ploughing.
class Scrape {
public:
    /// @param rate  of samples [Hz].
    Scrape(std::array<std::shared_ptr<const Roughness>, 2> surface, double rate);

    /// Where load and speed go within the next run. Steadily, from zero at first.
    void aim(const ScrapeAim& aim) noexcept;
    /// The load goes to nothing within the next run.
    void release() noexcept { aim_.load = 0.0; }
    /// The force beyond the load [N], sample by sample.
    void run(int samples, float* force) noexcept;

    double load() const noexcept { return load_; } ///< after the last run [N]

private:
    std::array<std::shared_ptr<const Roughness>, 2> surface_;
    double rate_;
    ScrapeAim aim_;
    std::array<double, 2> place_ = {}; ///< on each surface [m]
    std::array<double, 2> speed_ = {};
    double load_ = 0.0;
    /// y - z = y filtered by s^2 / (s^2 + 2 damping w s + w^2).
    double take_ = 0.0, back_[2] = {}, kept_[2] = {};
    bool begun_ = false;
};

} // namespace ode::sound
