#include "world/soft_exchange.h"

#include "couple/soft_contact.h"
#include "couple/volume_contact.h"
#include "world/body.h"

#include <algorithm>
#include <utility>

namespace ode::soft {

bool SoftExchange::before(const Pair& x, const Pair& y) noexcept {
    return std::pair(x.a->number_, x.b->number_) < std::pair(y.a->number_, y.b->number_);
}

void SoftExchange::begin_step(std::span<const std::unique_ptr<Body>> bodies, bool again) {
    if (again)
        for (Contact* contact : active_)
            contact->law->take_back();
    collect_pairs(bodies);
    merge_pairs();
    for (Contact* contact : active_) {
        const auto partner = [](Body& body) {
            return SoftPartner{surface_of(body), body.contact_law(), body.contact_substep()};
        };
        contact->law->begin_step(partner(*contact->pair.a), partner(*contact->pair.b));
        contact->law->keep();
        for (const Body* body : {contact->pair.a, contact->pair.b})
            if (!body->moves() && held_.size() < body->mass().size())
                held_.assign(body->mass().size(), 0.0);
    }
}

void SoftExchange::collect_pairs(std::span<const std::unique_ptr<Body>> bodies) {
    met_.clear();
    for (const std::unique_ptr<Body>& body : bodies) {
        if (body->self_contact() && body->moves())
            met_.push_back({body.get(), body.get()});
        for (const dGeomID geom : body->pair_) {
            Body* const other = Body::behind(geom);
            if (!other || &other->world() != &body->world() || other == body.get())
                continue;
            if (!body->moves() && !other->moves())
                continue;
            // ODE tells one of the two, whichever its space comes upon first.
            if (body->number_ < other->number_)
                met_.push_back({body.get(), other});
            else
                met_.push_back({other, body.get()});
        }
    }
    std::sort(met_.begin(), met_.end(), before);
    const auto same = [](const Pair& x, const Pair& y) { return x.a == y.a && x.b == y.b; };
    met_.erase(std::unique(met_.begin(), met_.end(), same), met_.end());
}

void SoftExchange::merge_pairs() {
    merged_.clear();
    auto known = contact_.begin();
    const auto keep_sleepers = [&](auto up_to) {
        for (; known != up_to; ++known)
            if (known->pair.a->asleep() || known->pair.b->asleep())
                merged_.push_back(std::move(*known));
    };
    for (const Pair& pair : met_) {
        keep_sleepers(std::find_if(known, contact_.end(),
                                   [&](const Contact& c) { return !before(c.pair, pair); }));
        if (known != contact_.end() && !before(pair, known->pair))
            merged_.push_back(std::move(*known++));
        else
            merged_.push_back({pair, make_contact(pair)});
    }
    keep_sleepers(contact_.end());
    std::swap(contact_, merged_);
    active_.clear();
    auto met = met_.begin();
    for (Contact& contact : contact_)
        if (met != met_.end() && !before(contact.pair, *met)) {
            active_.push_back(&contact);
            ++met;
        }
}

void SoftExchange::look_ahead() noexcept {
    for (const Contact* contact : active_)
        for (Body* body : {contact->pair.a, contact->pair.b})
            if (body->rings())
                body->modes_->set_pace(
                    std::min(body->modes_->pace(), body->contact_pace(body->max_speed())));
}

SoftContactTally SoftExchange::add_forces(double dt) {
    SoftContactTally sum;
    ++substep_;
    for (const Contact* contact : active_)
        for (Body* body : {contact->pair.a, contact->pair.b})
            if (body->rings())
                body->modes_->place_surface();
    for (const Contact* contact : active_) {
        const auto side = [&](Body& body) {
            const std::span<const double> inverse_mass =
                body.moves() ? body.contact_inverse_mass() : std::span<const double>(held_);
            return SoftSide{body.state_.position,
                            body.state_.velocity,
                            inverse_mass,
                            {body.force_, body.moves() ? &body.contacts_ : nullptr}};
        };
        const auto& [a, b] = contact->pair;
        const SoftContactTally tally = contact->law->add_force(side(*a), side(*b), dt, substep_);
        a->bearing_points_ += tally.bearing;
        a->meets_movable_ |= tally.bearing != 0;
        b->meets_movable_ |= tally.bearing != 0;
        if (b != a)
            b->bearing_points_ += tally.bearing;
        sum.looks += tally.looks;
        sum.tests += tally.tests;
        sum.bearing += tally.bearing;
    }
    return sum;
}

void SoftExchange::forget(const Body& body) noexcept {
    active_.clear();
    std::erase_if(contact_,
                  [&](const Contact& c) { return c.pair.a == &body || c.pair.b == &body; });
}

SoftSurface& SoftExchange::surface_of(Body& body) {
    if (!body.soft_surface_)
        body.soft_surface_ = std::make_unique<SoftSurface>(body.contact_nodes_, body.mesh().node);
    return *body.soft_surface_;
}

SoftVolume& SoftExchange::volume_of(Body& body) {
    if (!body.soft_volume_)
        body.soft_volume_ = std::make_unique<SoftVolume>(body.mesh(), surface_of(body));
    return *body.soft_volume_;
}

std::unique_ptr<PairContact> SoftExchange::make_contact(const Pair& pair) const {
    if (method_ == SoftContactMethod::volume)
        return std::make_unique<VolumeContact>(volume_of(*pair.a), volume_of(*pair.b));
    return std::make_unique<SoftContact>(surface_of(*pair.a), surface_of(*pair.b));
}

void SoftExchange::set_method(SoftContactMethod method) noexcept {
    if (method == method_)
        return;
    method_ = method;
    active_.clear();
    contact_.clear();
}

} // namespace ode::soft
