#include "bridge/rigid_scrapes.h"

#include "bridge/rigid_bodies.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {
namespace {

/// What goes more slowly stands: ODE's friction lets all creep.
constexpr double kCreeps = 5e-3; // [m/s]

} // namespace

void RigidScrapes::bear(const RigidTouch& touch, RigidBody* const side[2], const void* partner,
                        double load) {
    for (Bearing& own : bearing_) {
        if (own.side[0] != side[0] || own.side[1] != side[1] || own.partner != partner)
            continue;
        const double part = load / (own.load + load);
        own.touch.position += part * (touch.position - own.touch.position);
        own.touch.normal = (own.touch.normal + part * (touch.normal - own.touch.normal));
        own.touch.normal.normalize();
        own.touch.impulse += touch.impulse;
        own.load += load;
        return;
    }
    bearing_.push_back({{side[0], side[1]}, partner, touch, load});
}

void RigidScrapes::forget(const RigidBody& body) noexcept {
    std::erase_if(contact_,
                  [&](const Contact& own) { return own.side[0] == &body || own.side[1] == &body; });
    bearing_.clear();
}

RigidScrapes::Contact* RigidScrapes::find(const Bearing& bearing) noexcept {
    const auto found = std::find_if(contact_.begin(), contact_.end(), [&](const Contact& own) {
        return own.side[0] == bearing.side[0] && own.side[1] == bearing.side[1] &&
               own.partner == bearing.partner;
    });
    return found != contact_.end() ? &*found : nullptr;
}

void RigidScrapes::aim(Contact& contact, const Bearing& bearing, const Travel& travel,
                       const Geoms& geoms) {
    const RigidTouch& touch = bearing.touch;
    const ContactPatch patch = patch_of(touch, bearing.side, geoms);
    ScrapeAim aim;
    aim.load = bearing.load;
    for (std::size_t s = 0; s < 2; ++s)
        aim.speed[s] = travel.along[s].norm();
    aim.stiffness = bearing_stiffness(bearing.load, patch.curvature, patch.modulus);
    aim.radius = bearing_radius(bearing.load, patch.curvature, patch.modulus);
    aim.mass = 1.0 / (touch.motion[0].yielding(touch.position, touch.normal) +
                      touch.motion[1].yielding(touch.position, touch.normal));
    aim.damping = 0.5 * patch.loss;
    contact.scrape.aim(aim);
    const Vec3 along = force_per_load(touch);
    for (std::size_t s = 0; s < 2; ++s) {
        RigidBody* const side = bearing.side[s];
        if (!side)
            continue;
        const RigidMotion& motion = touch.motion[s];
        const Vec3 own = motion.into_frame(s == 0 ? along : Vec3(-along));
        Felt& felt = contact.now[s];
        std::fill(felt.push.begin(), felt.push.end(), 0.0f);
        side->model->surface.project(patch.place[s], own, felt.push);
        felt.jerk = motion.jerk(motion.place_in_frame(touch.position), own);
    }
}

bool RigidScrapes::has_moved(const Contact& contact) noexcept {
    constexpr float kLittle = 1e-4f; // of the square: what steps by a per cent is not heard to
    for (std::size_t s = 0; s < 2; ++s) {
        const std::vector<float>&before = contact.before[s].push, &now = contact.now[s].push;
        float off = 0.0f, all = 0.0f;
        for (std::size_t k = 0; k < now.size(); ++k) {
            off += (now[k] - before[k]) * (now[k] - before[k]);
            all += now[k] * now[k];
        }
        const double jerk = (contact.now[s].jerk - contact.before[s].jerk).squaredNorm();
        if (off > kLittle * all ||
            jerk > static_cast<double>(kLittle) * contact.now[s].jerk.squaredNorm())
            return true;
    }
    return false;
}

std::span<float> RigidScrapes::row(std::size_t samples) {
    if (used_ == series_.size())
        series_.emplace_back();
    std::vector<float>& row = series_[used_++];
    row.resize(samples);
    return row;
}

void RigidScrapes::drive(Contact& contact, bool moved, std::int64_t begin, std::size_t samples,
                         double rate, const Voice& voice) {
    const std::span<float> now = row(samples);
    contact.scrape.run(static_cast<int>(samples), now.data());
    const auto lapse = static_cast<float>(1.0 / rate);
    for (float& force : now)
        force *= lapse;
    std::span<float> before;
    if (moved) { // from the place before to this one, so that nothing jumps
        before = row(samples);
        for (std::size_t i = 0; i < samples; ++i) {
            const float u = static_cast<float>(i + 1) / static_cast<float>(samples);
            before[i] = (1.0f - u) * now[i];
            now[i] *= u;
        }
    }
    for (std::size_t s = 0; s < 2; ++s) {
        if (!contact.side[s])
            continue;
        StruckVoice& own = voice(*contact.side[s]);
        if (moved)
            own.drive(begin, before, contact.before[s].push, contact.before[s].jerk);
        own.drive(begin, now, contact.now[s].push, contact.now[s].jerk);
    }
}

void RigidScrapes::end_step(double begin, double end, double rate, const Geoms& geoms,
                            const Voice& voice) {
    used_ = 0;
    const auto first = static_cast<std::int64_t>(std::floor(begin * rate));
    const auto samples = static_cast<std::size_t>(
        std::max(0.0, std::floor(end * rate) - static_cast<double>(first)));
    for (Contact& own : contact_)
        own.seen = false;
    for (const Bearing& bearing : bearing_) {
        const Travel travel = travel_of(bearing.touch, bearing.load);
        if (samples == 0 || !(travel.speed() > kCreeps))
            continue;
        Contact* known = find(bearing);
        const bool is_new = !known;
        if (is_new) {
            const dGeomID* geom = bearing.touch.geom;
            contact_.push_back(
                {{bearing.side[0], bearing.side[1]},
                 bearing.partner,
                 Scrape({geoms.skin(geom[0]).roughness, geoms.skin(geom[1]).roughness}, rate),
                 {},
                 {},
                 true});
            known = &contact_.back();
            for (std::size_t s = 0; s < 2; ++s)
                if (bearing.side[s])
                    known->before[s].push = known->now[s].push =
                        std::vector<float>(bearing.side[s]->push.size(), 0.0f);
        }
        known->seen = true;
        std::swap(known->before, known->now);
        aim(*known, bearing, travel, geoms);
        // One step may be an error of the solver's.
        if (!is_new)
            drive(*known, has_moved(*known), first, samples, rate, voice);
    }
    if (samples > 0)
        std::erase_if(contact_, [&](Contact& own) {
            if (own.seen)
                return false;
            if (own.scrape.load() > 0.0) { // at rest, or off
                own.scrape.release();
                drive(own, false, first, samples, rate, voice);
            }
            return true;
        });
    bearing_.clear();
}

} // namespace ode::sound
