#pragma once

#include "source/struck_voice.h"
#include "strike/struck_surface.h"

#include <ode_softbody/softbody.h>

#include <functional>
#include <vector>

namespace ode::sound {

struct RigidBody;

/// What soft bodies do to rigid ones that sound: forces known from substep to substep, at every
/// place where they touch or are nailed together. Nothing is made up: the voice gets them as they
/// are, less what is steady. A load that lasts makes no sound, and a soft body that falls asleep on
/// a plate ceases to press without having moved; therefore the mean of the last kSteady is taken
/// off, with what it leaves on for as long after contact ends.
class SoftPushes {
public:
    static constexpr double kSteady = 0.02; ///< [s]: 8 Hz
    using Find = std::function<RigidBody*(dBodyID)>;
    using Voice = std::function<StruckVoice&(RigidBody&)>;

    /// A substep's. Allocates for more places than ever before.
    void feel(const dSoftRigidPushes& pushes, const Find& find, const Voice& voice);
    /// After a step to `time` [s].
    void end_step(double time, double rate, const Voice& voice);
    void forget(const RigidBody& body) noexcept;
    void forget(dSoftBodyID soft) noexcept;
    void clear() noexcept { pair_.clear(); }

private:
    struct Spot {    ///< where a push of the substep before met the surface
        Vec3 looked; ///< for [m]
        StruckSurface::Place place;
    };
    /// Of one rigid and one soft body.
    struct Pair {
        RigidBody* rigid;
        dSoftBodyID soft;
        double yields;            ///< 1/m of the rigid body [1/kg]
        Eigen::Matrix3d turns_by; ///< its inverse inertia, in its frame
        std::vector<Spot> spot;
        std::size_t spots = 0;  ///< in this substep
        std::vector<float> now; ///< force on each mode [kg^1/2 m/s^2]
        RigidSound::Six jerk;   ///< change of velocity and spin [m/s^2], [rad/s^2]
        std::vector<double> mean, rest;
        RigidSound::Six mean_jerk = RigidSound::Six::Zero();
        double most = 0.0;    ///< square of the largest force on modes so far
        double seen = 0.0;    ///< up to this time all is told [s]
        bool pressed = false; ///< in this substep
    };
    Pair& pair_of(RigidBody& rigid, dSoftBodyID soft);
    void add(Pair& pair, const dSoftRigidPush& push);
    /// `now` acts for `dt` [s] up to `time`.
    void tell(Pair& pair, double time, double dt, const Voice& voice);
    /// Nothing presses up to `time`.
    void relax(Pair& pair, double time, double rate, const Voice& voice);
    bool is_quiet(const Pair& pair) const noexcept;

    std::vector<Pair> pair_;
    double rate_ = 48000.0;
};

} // namespace ode::sound
