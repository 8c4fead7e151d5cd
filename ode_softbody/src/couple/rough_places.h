#pragma once

namespace ode::soft {

/// A body whose nodes are brought up to date one by one, for those who ask: first as its frame
/// carries them, which tells what is far from a shape. Places and velocities are those of the
/// arrays that a look is given.
class RoughPlaces {
public:
    virtual ~RoughPlaces() = default;

    virtual void carry(int node) noexcept = 0;   ///< by the frame
    virtual void place(int node) noexcept = 0;   ///< where it is
    double off() const noexcept { return off_; } ///< of where a frame carries a node, at most [m]
    double speed() const noexcept { return speed_; } ///< that nodes have in the frame, in the mean

protected:
    double off_ = 0;   ///< [m]
    double speed_ = 0; ///< root of the mean square [m/s]
};

} // namespace ode::soft
