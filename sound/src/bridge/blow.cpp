#include "bridge/blow.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {
namespace {

// Slower contact makes no sound that could be told from silence [m/s].
constexpr double kSlowest = 5e-3;
// What ODE's solver leaves of a contact at rest [m/s].
constexpr double kJitter = 2e-2;

// A bounce that gives all back, as applications like to have it, must be heard, too: a twentieth of
// what came.
constexpr double kLeast = 0.05;

/// @param falls  by how much it would close faster in the step [m/s].
std::optional<Blow> find_passed(const RigidTouch& touch, const History& history, double begin,
                                double h, double falls, double mass) noexcept {
    // What lies on several places shifts its load from one to another.
    constexpr double kFar = 4.0;
    constexpr int kLong = 3;
    if (history.acquaintance != Acquaintance::kLasting || history.steps < kLong)
        return {};
    const double given = touch.impulse.dot(touch.normal), borne = history.load * h;
    const double stroke = given - borne - mass * falls;
    // As two that part as fast as they met.
    const double speed = 0.5 * stroke / mass;
    if (!(given > kFar * borne) || !(speed > std::max(kJitter, 3.0 * falls)))
        return {};
    Blow blow{};
    blow.time = begin;
    blow.speed = speed;
    blow.mass = mass;
    blow.impulse = touch.impulse * (stroke / given);
    blow.energy = kLeast * 0.5 * mass * speed * speed;
    blow.passed = true;
    return blow;
}

} // namespace

std::optional<Blow> find_blow(const RigidTouch& touch, const History& history, double begin,
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
        history.acquaintance == Acquaintance::kNew ? kSlowest : std::max(kJitter, 3.0 * falls);
    const double mass = 1.0 / (touch.motion[0].yielding(touch.position, n) +
                               touch.motion[1].yielding(touch.position, n));
    const double stroke = given - mass * falls;
    if (!(stroke > 0.0) || !std::isfinite(mass))
        return {};
    if (!(closing > least))
        return find_passed(touch, history, begin, h, falls, mass);
    // Overlap is found at the step's begin; it has grown since the surfaces met.
    const double late = std::clamp(touch.depth / closing, 0.0, before);
    const double speed = std::max(closing - std::max(0.0, pull) * late, 0.5 * closing);
    Blow blow{};
    blow.time = begin - late;
    blow.speed = speed;
    blow.mass = mass;
    blow.impulse = touch.impulse * (stroke / given * speed / closing);
    // J v - J^2 / 2m.
    const double push = stroke * speed / closing;
    const double came = 0.5 * mass * speed * speed;
    blow.energy = std::max(push * speed - push * push / (2.0 * mass), kLeast * came);
    blow.goes_on = history.acquaintance == Acquaintance::kLasting;
    return blow;
}

} // namespace ode::sound
