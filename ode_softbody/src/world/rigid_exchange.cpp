#include "world/rigid_exchange.h"

#include "collide/rigid_shape.h"
#include "couple/surface_elasticity.h"
#include "world/body.h"

#include <algorithm>

namespace ode::soft {

void RigidExchange::begin_step(std::span<const std::unique_ptr<Body>> bodies, double h, double dt) {
    shadow_.clear();
    for (Contact& contact : contact_)
        contact.current = false;
    for (const std::unique_ptr<Body>& body : bodies) {
        if (body->stopped())
            continue;
        for (const RigidPair& pair : body->rigid_pair_) {
            const std::optional<RigidShape> shape = capture_shape(pair.geom);
            if (!shape)
                continue;
            Contact& contact = contact_of(*body, pair.geom);
            contact.current = true;
            contact.shadow = shadow_of(shape->body, h, dt);
            RigidShadow& shadow = shadow_[contact.shadow];
            if (contact.law->bearing())
                shadow.set_softening(std::min(shadow.softening(), contact.law->softening()));
            contact.law->begin_step(*shape, pair.law, body->inverse_mass_, body->substep());
        }
    }
    std::erase_if(contact_, [](const Contact& contact) { return !contact.current; });
}

ContactTally RigidExchange::add_forces(double dt) noexcept {
    ContactTally sum;
    for (Contact& contact : contact_) {
        Body& body = *contact.body;
        const ContactTally tally = contact.law->add_force(
            body.state_.position, body.state_.velocity, shadow_[contact.shadow], dt, body.force_);
        body.bearing_points_ += tally.bearing;
        sum.tests += tally.tests;
        sum.bearing += tally.bearing;
    }
    return sum;
}

void RigidExchange::advance(double dt) noexcept {
    for (RigidShadow& shadow : shadow_)
        shadow.advance(dt);
}

void RigidExchange::hand_over() noexcept {
    for (RigidShadow& shadow : shadow_)
        shadow.hand_over();
}

void RigidExchange::write_back() noexcept {
    for (RigidShadow& shadow : shadow_)
        shadow.write_back();
}

void RigidExchange::forget(const Body& body) noexcept {
    std::erase_if(contact_, [&](const Contact& contact) { return contact.body == &body; });
}

std::size_t RigidExchange::shadow_of(dBodyID body, double h, double dt) {
    const auto found = std::find_if(shadow_.begin(), shadow_.end(),
                                    [&](const RigidShadow& s) { return s.body() == body; });
    if (found != shadow_.end())
        return static_cast<std::size_t>(found - shadow_.begin());
    shadow_.emplace_back(body, h, dt);
    return shadow_.size() - 1;
}

RigidExchange::Contact& RigidExchange::contact_of(Body& body, dGeomID geom) {
    const auto found = std::find_if(contact_.begin(), contact_.end(), [&](const Contact& c) {
        return c.body == &body && c.law->geom() == geom;
    });
    if (found != contact_.end())
        return *found;
    // Only bodies that meet something need to know.
    if (!body.contact_nodes_.elastic.known())
        body.contact_nodes_.elastic =
            measure_elasticity(body.mesh_, body.contact_nodes_, *body.model_, body.solids_);
    return contact_.emplace_back(
        Contact{&body, std::make_unique<NodeContact>(body.contact_nodes_, geom), 0});
}

} // namespace ode::soft
