#include "world/soft_exchange.h"

#include "world/body.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace ode::soft {

void SoftExchange::begin_step(std::span<const std::unique_ptr<Body>> bodies) {
    std::swap(last_, contact_);
    contact_.clear();
    for (const std::unique_ptr<Body>& body : bodies) {
        if (body->self_contact() && !body->stopped())
            meet(*body, *body);
        for (const dGeomID geom : body->pair_) {
            Body* const other = Body::behind(geom);
            if (!other || &other->world() != &body->world() || other == body.get())
                continue;
            if (body->stopped() && other->stopped())
                continue;
            // ODE tells one of the two, whichever its space comes upon first.
            if (body->number_ < other->number_)
                meet(*body, *other);
            else
                meet(*other, *body);
        }
    }
    // Sums of forces must not depend on the order in which a space finds its pairs.
    std::sort(contact_.begin(), contact_.end(), [](const Contact& x, const Contact& y) {
        return std::pair(x.a->number_, x.b->number_) < std::pair(y.a->number_, y.b->number_);
    });
    last_.clear();
    for (const Contact& contact : contact_) {
        const auto partner = [&](Body& body) {
            return SoftPartner{surface_of(body), body.contact_law(), body.substep()};
        };
        contact.law->begin_step(partner(*contact.a), partner(*contact.b));
        for (const Body* body : {contact.a, contact.b})
            if (body->stopped() && held_.size() < body->mass().size())
                held_.assign(body->mass().size(), 0.0);
    }
}

SoftContactTally SoftExchange::add_forces(double dt) {
    SoftContactTally sum;
    ++substep_;
    for (const Contact& contact : contact_) {
        const auto side = [&](Body& body) {
            const std::span<const double> inverse_mass =
                body.stopped() ? held_ : body.inverse_mass_;
            return SoftSide{body.state_.position, body.state_.velocity, inverse_mass, body.force_};
        };
        const SoftContactTally tally =
            contact.law->add_force(side(*contact.a), side(*contact.b), dt, substep_);
        contact.a->bearing_points_ += tally.bearing;
        if (contact.b != contact.a)
            contact.b->bearing_points_ += tally.bearing;
        sum.looks += tally.looks;
        sum.tests += tally.tests;
        sum.bearing += tally.bearing;
    }
    return sum;
}

void SoftExchange::forget(const Body& body) noexcept {
    std::erase_if(contact_, [&](const Contact& c) { return c.a == &body || c.b == &body; });
    std::erase_if(surface_, [&](const Surface& s) { return s.body == &body; });
}

SoftSurface& SoftExchange::surface_of(const Body& body) {
    const auto found = std::find_if(surface_.begin(), surface_.end(),
                                    [&](const Surface& s) { return s.body == &body; });
    if (found != surface_.end())
        return *found->surface;
    return *surface_
                .emplace_back(Surface{
                    &body, std::make_unique<SoftSurface>(body.contact_nodes_, body.mesh().node)})
                .surface;
}

void SoftExchange::meet(Body& a, Body& b) {
    const auto same = [&](const Contact& c) { return c.a == &a && c.b == &b; };
    if (std::any_of(contact_.begin(), contact_.end(), same))
        return;
    const auto found = std::find_if(last_.begin(), last_.end(), same);
    if (found != last_.end() && found->law)
        contact_.push_back(std::move(*found));
    else
        contact_.push_back({&a, &b, std::make_unique<SoftContact>(surface_of(a), surface_of(b))});
}

} // namespace ode::soft
