#pragma once

#include <ode/common.h>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace ode::soft {

class Body;
class RigidExchange;

/// Soft bodies fall asleep, and wake, together with those that they are near, as ODE's islands do.
///
/// No sleeper ever bears force: it is woken before the step in which something that moves comes
/// near, and with it what is near itself. So momentum is kept, and contacts remember their friction
/// over the sleep. Nothing here costs while all are awake and none is quiet.
class Slumber {
public:
    /// Once the pairs of those awake are known, and what rigid bodies have swept over: wakes
    /// sleepers that these are near, and makes them meet theirs.
    void rouse(std::span<const std::unique_ptr<Body>> bodies) noexcept;

    /// After the substeps: settles who has come to rest together with all its neighbours.
    void decide(std::span<const std::unique_ptr<Body>> bodies, const RigidExchange& exchange);
    /// After ODE's step: puts these to sleep.
    void carry_out() noexcept;

private:
    std::size_t root_of(std::size_t group) noexcept;
    void unite(std::size_t a, std::size_t b) noexcept;
    void unite_with_rigid(std::size_t group, dBodyID rigid, const RigidExchange& exchange);

    std::vector<std::size_t> parent_;   ///< of each body, by its place in the world
    std::vector<bool> restless_;        ///< by root
    std::vector<std::ptrdiff_t> owner_; ///< of each island of rigid bodies: a group, or -1
    std::vector<Body*> soft_;           ///< to sleep
    std::vector<dBodyID> rigid_;
};

} // namespace ode::soft
