#include "bridge/blow.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {
namespace {

// Slower contact makes no sound that could be told from silence [m/s].
constexpr double kSlowest = 5e-3;
// What ODE's solver leaves of a contact at rest [m/s].
constexpr double kJitter = 2e-2;

} // namespace

std::optional<Blow> find_blow(const RigidTouch& touch, Acquaintance acquaintance, double begin,
                              double h, double before) noexcept {
    const Vec3& n = touch.normal;
    const double given = touch.impulse.dot(n);
    if (!(given > 0.0))
        return {};
    const double closing = n.dot(touch.motion[1].velocity_at(touch.position) -
                                 touch.motion[0].velocity_at(touch.position));
    // By how much it would have closed faster in the step: the load that any contact bears.
    const double pull = n.dot(touch.motion[1].pull - touch.motion[0].pull);
    const double falls = std::max(0.0, pull * h);
    // The end of what rocks falls at 3/2 of what pulls, for two steps or so.
    const double least =
        acquaintance == Acquaintance::kNew ? kSlowest : std::max(kJitter, 3.0 * falls);
    if (!(closing > least))
        return {};
    const double mass = 1.0 / (touch.motion[0].yielding(touch.position, n) +
                               touch.motion[1].yielding(touch.position, n));
    const double stroke = given - mass * falls;
    if (!(stroke > 0.0) || !std::isfinite(mass))
        return {};
    // Overlap is found at the step's begin; it has grown since the surfaces met.
    const double late = std::clamp(touch.depth / closing, 0.0, before);
    const double speed = std::max(closing - std::max(0.0, pull) * late, 0.5 * closing);
    Blow blow{};
    blow.time = begin - late;
    blow.speed = speed;
    blow.mass = mass;
    blow.impulse = touch.impulse * (stroke / given * speed / closing);
    // J v - J^2 / 2m. A bounce that gives all back, as applications like to have it, must be heard,
    // too: a twentieth of what came.
    constexpr double kLeast = 0.05;
    const double push = stroke * speed / closing;
    const double came = 0.5 * mass * speed * speed;
    blow.energy = std::max(push * speed - push * push / (2.0 * mass), kLeast * came);
    blow.goes_on = acquaintance == Acquaintance::kLasting;
    return blow;
}

} // namespace ode::sound
