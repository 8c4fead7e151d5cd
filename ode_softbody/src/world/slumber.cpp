#include "world/slumber.h"

#include "world/body.h"
#include "world/rigid_exchange.h"

#include <ode/collision.h>
#include <ode/objects.h>

#include <algorithm>
#include <numeric>

namespace ode::soft {
namespace {

bool is_still(const dReal* v) noexcept { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

/// A rigid body that is under way, or may be at any moment.
bool moves(dBodyID body) noexcept {
    if (!body || !dBodyIsEnabled(body))
        return false;
    return !dBodyIsKinematic(body) || !is_still(dBodyGetLinearVel(body)) ||
           !is_still(dBodyGetAngularVel(body));
}

/// Awake, yet ready to sleep: ODE's flag allows it, and it is slower than ODE's thresholds.
bool is_quiet(dBodyID body, const RigidShadow* shadow) noexcept {
    return shadow && dBodyGetAutoDisableFlag(body) &&
           shadow->motion().velocity.norm() <= dBodyGetAutoDisableLinearThreshold(body) &&
           shadow->motion().spin.norm() <= dBodyGetAutoDisableAngularThreshold(body);
}

} // namespace

void Slumber::rouse(std::span<const std::unique_ptr<Body>> bodies) noexcept {
    if (std::none_of(bodies.begin(), bodies.end(), [](const auto& b) { return b->asleep(); }))
        return;
    const auto wake = [](Body& body) {
        body.wake();
        if (body.geom() && dGeomIsEnabled(body.geom()))
            collide_now(body.geom());
    };
    for (bool more = true; more;) {
        more = false;
        for (const std::unique_ptr<Body>& body : bodies)
            for (std::size_t i = 0; i < body->pair_.size(); ++i) { // which grows as sleepers wake
                Body* const other = Body::behind(body->pair_[i]);
                if (body->asleep() ? (other ? other->moves() : moves(dGeomGetBody(body->pair_[i])))
                                   : body->moves() && other && other->asleep()) {
                    wake(body->asleep() ? *body : *other);
                    more = true;
                }
            }
    }
}

std::size_t Slumber::root_of(std::size_t group) noexcept {
    while (parent_[group] != group)
        group = parent_[group] = parent_[parent_[group]];
    return group;
}

void Slumber::unite(std::size_t a, std::size_t b) noexcept {
    const std::size_t one = root_of(a);
    const std::size_t two = root_of(b);
    parent_[std::max(one, two)] = std::min(one, two);
    restless_[std::min(one, two)] = restless_[one] || restless_[two];
}

void Slumber::unite_with_rigid(std::size_t group, dBodyID rigid, const RigidExchange& exchange) {
    if (!rigid)
        return;
    const std::ptrdiff_t island = exchange.island_of(rigid);
    if (island < 0) { // prescribed, or no contact was wanted
        if (moves(rigid))
            restless_[root_of(group)] = true;
        return;
    }
    std::ptrdiff_t& owner = owner_[static_cast<std::size_t>(island)];
    if (owner >= 0) {
        unite(group, static_cast<std::size_t>(owner));
        return;
    }
    owner = static_cast<std::ptrdiff_t>(group);
    for (const RigidIslands::Member& member : exchange.islands().members())
        if (static_cast<std::ptrdiff_t>(member.island) == island && dBodyIsEnabled(member.body) &&
            !is_quiet(member.body, exchange.find_shadow(member.body)))
            restless_[root_of(group)] = true;
}

void Slumber::decide(std::span<const std::unique_ptr<Body>> bodies, const RigidExchange& exchange) {
    const auto ready = [](const auto& b) { return b->moves() && b->has_come_to_rest(); };
    if (std::none_of(bodies.begin(), bodies.end(), ready))
        return;
    parent_.resize(bodies.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    restless_.assign(bodies.size(), false);
    owner_.assign(exchange.islands().islands().size(), -1);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies[i]->place_ = i;
        restless_[i] = bodies[i]->moves() && !bodies[i]->has_come_to_rest();
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!bodies[i]->moves())
            continue;
        for (const dGeomID geom : bodies[i]->pair_) {
            const Body* const other = Body::behind(geom);
            if (!other)
                unite_with_rigid(i, dGeomGetBody(geom), exchange);
            else if (other->moves() && &other->world() == &bodies[i]->world())
                unite(i, other->place_);
        }
    }
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (bodies[i]->moves() && !restless_[root_of(i)])
            soft_.push_back(bodies[i].get());
    for (const RigidIslands::Member& member : exchange.islands().members()) {
        const std::ptrdiff_t owner = owner_[member.island];
        if (owner >= 0 && !restless_[root_of(static_cast<std::size_t>(owner))])
            rigid_.push_back(member.body);
    }
}

void Slumber::carry_out() noexcept {
    for (Body* const body : soft_)
        body->fall_asleep();
    for (const dBodyID body : rigid_) { // as ODE does it
        dBodySetLinearVel(body, 0, 0, 0);
        dBodySetAngularVel(body, 0, 0, 0);
        dBodyDisable(body);
    }
    soft_.clear();
    rigid_.clear();
}

} // namespace ode::soft
