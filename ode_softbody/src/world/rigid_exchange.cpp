#include "world/rigid_exchange.h"

#include "collide/rigid_shape.h"
#include "couple/surface_elasticity.h"
#include "world/body.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

// How long an island that was touched is substepped though it isn't near [s].
constexpr double kLinger = 0.1;

// Substeps of a body that rings, unpushed, between looks for how long it may leap: what is near a
// shape but not in it needs no look at each.
constexpr int kPatience = 4;

} // namespace

void RigidExchange::begin_step(dWorldID world, std::span<const std::unique_ptr<Body>> bodies,
                               double h, double dt) {
    if (stepped_) {
        std::swap(shadow_, before_);
        rigid_.keep();
    } else { // this step is redone
        for (Contact& contact : contact_)
            contact.law->take_back();
        rigid_.take_back();
        rigid_.keep();
    }
    stepped_ = false;
    h_ = h;
    shadow_.clear();
    dVector3 gravity;
    dWorldGetGravity(world, gravity);
    gather_islands(world, bodies, h, dt);
    lay_aside_sleepers();
    for (Contact& contact : contact_)
        contact.current = false;
    for (const std::unique_ptr<Body>& body : bodies) {
        if (!body->moves())
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
            ContactLaw law = pair.law;
            law.weight = body->total_mass() * std::hypot(gravity[0], gravity[1], gravity[2]);
            contact.law->begin_step(*shape, law, body->contact_inverse_mass(),
                                    body->contact_substep());
        }
    }
    std::erase_if(contact_, [](const Contact& contact) { return !contact.current; });
    for (Contact& contact : contact_)
        contact.law->keep();
    meet_rigid(h, dt);
    response_.assign(shadow_.size(), {});
}

void RigidExchange::lay_aside_sleepers() {
    const auto move_if = [](std::vector<Contact>& from, std::vector<Contact>& to, bool asleep) {
        for (Contact& contact : from)
            if (contact.body->asleep() == asleep)
                to.push_back(std::move(contact));
        std::erase_if(from, [](const Contact& contact) { return !contact.law; });
    };
    move_if(dormant_, contact_, false);
    move_if(contact_, dormant_, true);
}

void RigidExchange::gather_islands(dWorldID world, std::span<const std::unique_ptr<Body>> bodies,
                                   double h, double dt) {
    islands_.begin_step();
    for (const std::unique_ptr<Body>& body : bodies) {
        if (!body->moves())
            continue;
        for (const RigidPair& pair : body->rigid_pair_)
            islands_.reach(dGeomGetBody(pair.geom), record_);
    }
    for (const dBodyID body : lingering_)
        islands_.reach(body, record_);
    mirror_.begin_step(world, h, dt);
    for (const RigidIslands::Member& member : islands_.members())
        if (member.jointed)
            mirror_.include(member.body, islands_.islands()[member.island].propped);
    mirror_.build();
    for (const RigidIslands::Member& member : islands_.members())
        shadow_of(member.body, h, dt);
}

void RigidExchange::meet_rigid(double h, double dt) {
    rigid_.begin_step();
    for (const RigidIslands::Meeting& meeting : islands_.meetings()) {
        const std::size_t first = shadow_of(meeting.first, h, dt);
        const std::size_t second = shadow_of(meeting.second, h, dt);
        rigid_.meet(*meeting.contact, first, second, shadow_, h, dt);
    }
    if (rigid_.size() != 0)
        rigid_.end_meeting([&](dBodyID body) { return index_of(body); }, shadow_);
}

void RigidExchange::look_ahead(bool first) noexcept {
    // Each candidate's motion is summed from modes at every substep: the fewer the better.
    constexpr double kHorizon = 1e-4; ///< [s]
    const auto each = [&](auto visit) {
        for (Contact& contact : contact_)
            if (contact.body->rings())
                visit(contact, *contact.body, *contact.body->modes_);
    };
    bool looked = first;
    each([&](Contact& contact, Body& body, ModalTier& modes) {
        NodeContact& law = *contact.law;
        if (modes.was_pushed()) {
            law.note_push();
            contact.idle = 0;
        } else {
            ++contact.idle;
        }
        if (contact.idle >= kPatience && law.quiet_for() < body.contact_pace(law.closing_speed()))
            law.look_soon();
        if (!law.is_look_due())
            return;
        contact.idle = 0;
        law.set_horizon(kHorizon);
        law.look(body.state_.position, body.state_.velocity, shadow_[contact.shadow],
                 &modes.rough_places());
        looked = true;
    });
    if (looked) {
        each([](Contact&, Body&, ModalTier& modes) { modes.clear_near(); });
        each([](Contact& contact, Body&, ModalTier& modes) {
            contact.law->collect_nodes(modes.near());
        });
        each([](Contact&, Body&, ModalTier& modes) { modes.settle_near(); });
    }
    each([](Contact& contact, Body& body, ModalTier& modes) {
        const double pace = body.contact_pace(contact.law->closing_speed());
        modes.set_pace(std::min(modes.pace(), std::max(contact.law->quiet_for(), pace)));
    });
}

ContactTally RigidExchange::add_forces(double dt) noexcept {
    ContactTally sum;
    push_.clear();
    bool bears = false;
    bool drags = rigid_.size() != 0;
    for (Contact& contact : contact_) {
        Body& body = *contact.body;
        if (body.rings() && contact.law->quiet_for() >= dt) {
            contact.law->pass(dt);
            contact.idle = kPatience; // what is left of the quiet may be too short to use
            continue;
        }
        if (body.rings())
            body.modes_->place_near(dt);
        sum.tests += contact.law->find(body.state_.position, body.state_.velocity,
                                       shadow_[contact.shadow], dt);
        if (!contact.law->is_touching())
            continue;
        bears = true;
        RigidShadow& shadow = shadow_[contact.shadow];
        if (!shadow.can_move()) {
            const bool noted = watched_ && shadow.body();
            felt_.clear();
            contact.law->push_at_once(body.state_.position, forces_on(body, dt), shadow,
                                      noted ? &felt_ : nullptr);
            for (const RigidPush& push : felt_)
                note_push(body, contact.shadow, push);
        }
        response_[contact.shadow].wanted = true;
    }
    if (!bears && rigid_.size() == 0)
        return sum;
    rigid_.begin_substep(shadow_, dt);
    bool moves = rigid_.size() != 0;
    for (std::size_t i = 0; i < response_.size(); ++i)
        if (response_[i].wanted) {
            response_[i].begin(shadow_[i], dt);
            moves = moves || response_[i].moves();
        }
    const auto once = [&] {
        const double change = sweep(dt);
        return moves ? change : 0;
    };
    settle(once);
    if (rigid_.size() != 0)
        rigid_bearing_ += rigid_.drag(shadow_, dt);
    for (Contact& contact : contact_) {
        if (!contact.law->is_touching())
            continue;
        const std::size_t bearing =
            contact.law->drag(forces_on(*contact.body, dt), shadow_[contact.shadow]);
        contact.body->bearing_points_ += bearing;
        const RigidRole role = shadow_[contact.shadow].role();
        contact.body->meets_movable_ |=
            bearing != 0 && role != RigidRole::fixed && role != RigidRole::prescribed;
        sum.bearing += bearing;
        drags = drags || contact.law->has_friction();
    }
    if (moves && drags)
        settle(once);
    for (std::size_t i = 0; i < response_.size(); ++i)
        if (response_[i].wanted && response_[i].moves())
            response_[i].end(shadow_[i]);
    for (Contact& contact : contact_)
        if (contact.law->is_touching() && response_[contact.shadow].moves())
            contact.law->enter_books(forces_on(*contact.body, dt), response_[contact.shadow]);
    for (RigidResponse& response : response_)
        response.wanted = false;
    for (const Contact& contact : contact_)
        if (watched_ && contact.law->is_touching())
            note_pushes(contact);
    return sum;
}

void RigidExchange::note_pushes(const Contact& contact) noexcept {
    contact.law->each_push([&](const Vec3& place, const Vec3& force) {
        note_push(*contact.body, contact.shadow, {place, force});
    });
}

void RigidExchange::note_push(const Body& soft, std::size_t shadow, const RigidPush& push) {
    const RigidShadow& rigid = shadow_[shadow];
    if (watched_ && rigid.body() && push.force.squaredNorm() > 0)
        push_.push_back({rigid.body(), &soft, rigid.motion().pose, push});
}

double RigidExchange::sweep(double dt) noexcept {
    double change = 0;
    if (rigid_.size() != 0)
        change = rigid_.sweep(shadow_, dt);
    for (std::size_t i = 0; i < response_.size(); ++i)
        if (response_[i].wanted)
            response_[i].open(shadow_[i]);
    for (Contact& contact : contact_)
        if (contact.law->is_touching())
            contact.law->sweep(forces_on(*contact.body, dt), response_[contact.shadow]);
    for (std::size_t i = 0; i < response_.size(); ++i)
        if (response_[i].wanted) {
            response_[i].close(shadow_[i]);
            change = std::max(change, response_[i].change());
        }
    return change;
}

TouchForces RigidExchange::forces_on(Body& body, double dt) noexcept {
    return {body.contact_inverse_mass(),
            body.state_.velocity,
            {body.force_, &body.contacts_, body.rings() ? &body.modes_->joint() : nullptr},
            dt};
}

void RigidExchange::advance(double dt) noexcept {
    wake_touched();
    for (RigidShadow& shadow : shadow_)
        shadow.advance(dt);
    if (mirror_.empty())
        return;
    mirror_.advance(dt);
    for (RigidShadow& shadow : shadow_)
        shadow.follow();
}

void RigidExchange::wake_touched() noexcept {
    for (std::size_t island = 0; island < islands_.islands().size(); ++island) {
        if (islands_.islands()[island].awake)
            continue;
        const auto roused = [&](const RigidIslands::Member& m) {
            return m.island == island &&
                   shadow_[static_cast<std::size_t>(index_of(m.body))].is_roused();
        };
        const auto members = islands_.members();
        if (std::none_of(members.begin(), members.end(), roused))
            continue;
        islands_.wake(island);
        for (const RigidIslands::Member& m : members)
            if (m.island == island)
                shadow_[static_cast<std::size_t>(index_of(m.body))].wake();
    }
}

void RigidExchange::note_awake(dBodyID body) {
    // Called while shadow_ is still of the step before.
    const RigidShadow* shadow = find_shadow(body);
    if (shadow && shadow->linger() > 0)
        lingering_.push_back(body);
}

void RigidExchange::enliven_touched() noexcept {
    for (std::size_t island = 0; island < islands_.islands().size(); ++island) {
        bool touched = false;
        bool live = false;
        double linger = 0;
        const auto each = [&](auto&& visit) {
            for (const RigidIslands::Member& m : islands_.members())
                if (m.island == island)
                    visit(shadow_[static_cast<std::size_t>(index_of(m.body))], m);
        };
        each([&](const RigidShadow& shadow, const RigidIslands::Member&) {
            touched |= shadow.touched();
            live |= shadow.touched() || shadow.live();
            linger = std::max(linger, shadow.linger() - h_);
        });
        if (!live)
            continue;
        // A body that was touched alone is written back by that alone.
        each([&](RigidShadow& shadow, const RigidIslands::Member& m) {
            if (m.jointed || islands_.islands()[island].propped)
                shadow.set_live(touched ? kLinger : linger);
        });
    }
    lingering_.clear();
}

void RigidExchange::hand_over() noexcept {
    enliven_touched();
    for (RigidShadow& shadow : shadow_)
        shadow.hand_over();
}

void RigidExchange::write_back() noexcept {
    for (RigidShadow& shadow : shadow_)
        shadow.write_back();
    mirror_.write_back();
    stepped_ = true;
}

void RigidExchange::forget(const Body& body) noexcept {
    for (std::vector<Contact>* list : {&contact_, &dormant_})
        std::erase_if(*list, [&](const Contact& contact) { return contact.body == &body; });
}

std::ptrdiff_t RigidExchange::island_of(dBodyID body) const noexcept {
    const auto members = islands_.members();
    const auto found =
        std::find_if(members.begin(), members.end(), [&](const auto& m) { return m.body == body; });
    return found == members.end() ? -1 : static_cast<std::ptrdiff_t>(found->island);
}

std::ptrdiff_t RigidExchange::index_of(dBodyID body) const noexcept {
    const auto found = std::find_if(shadow_.begin(), shadow_.end(),
                                    [&](const RigidShadow& s) { return s.body() == body; });
    return found == shadow_.end() ? -1 : found - shadow_.begin();
}

const RigidShadow* RigidExchange::find_shadow(dBodyID body) const noexcept {
    const std::ptrdiff_t i = index_of(body);
    return i < 0 ? nullptr : &shadow_[static_cast<std::size_t>(i)];
}

std::size_t RigidExchange::shadow_of(dBodyID body, double h, double dt) {
    const std::ptrdiff_t known = index_of(body);
    if (known >= 0)
        return static_cast<std::size_t>(known);
    MirroredBody* twin = body ? mirror_.find(body) : nullptr;
    RigidShadow& made = twin ? shadow_.emplace_back(*twin, h) : shadow_.emplace_back(body, h, dt);
    const auto before = std::find_if(before_.begin(), before_.end(), [&](const RigidShadow& s) {
        return body && s.body() == body;
    });
    const bool known_before = before != before_.end();
    if (known_before)
        made.remember(*before);
    const auto members = islands_.members();
    const auto member =
        std::find_if(members.begin(), members.end(), [&](const auto& m) { return m.body == body; });
    if (member != members.end()) {
        const RigidIslands::Island& island = islands_.islands()[member->island];
        if (island.propped && !twin)
            made.prop(known_before ? &*before : nullptr);
        if (island.awake && !(made.role() == RigidRole::free && !island.propped))
            made.wake();
    }
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
