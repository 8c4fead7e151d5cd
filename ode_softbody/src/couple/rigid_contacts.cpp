#include "couple/rigid_contacts.h"

#include "couple/contact_law.h"

#include <cmath>
#include <numbers>

namespace ode::soft {
namespace {

constexpr double kStiffness = 1e7; ///< [N/m]
constexpr double kSame = 8e-3;     ///< a contact is known again within this [m]
constexpr double kFading = 4;      ///< of the offset [1/s]
// ODE finds a contact pressed by some newtons a few micrometres deep, or, by rounding, not at all.
constexpr double kGraze = 2e-5; ///< deeper, ODE can't have missed it: the bodies have moved on [m]
constexpr double kLoose = 1e-3; ///< it comes apart, or slides off, by this [m]
// Explicit friction of up to eight contacts on one body: 8 * 0.7 * 0.08 = 0.45 of the 4 that
// leapfrog bears; the dashpot takes 0.14 a contact beside it.
constexpr double kShare = 0.08; ///< of stiffness dt^2 compliance
constexpr double kTangentialDamping = 0.3;

/// Damping ratio at which a one-sided spring and dashpot whose force can't pull returns this share
/// of the speed (Schwager, Poeschel, Granular Matter 9 (2007), doi:10.1007/s10035-007-0065-z).
double damping_ratio(double restitution) noexcept {
    const auto returned = [](double zeta) {
        const double root = std::sqrt(std::fabs(1 - zeta * zeta));
        if (zeta < std::numbers::sqrt2 / 2)
            return std::exp(-zeta / root *
                            (std::numbers::pi - std::atan2(2 * zeta * root, 1 - 2 * zeta * zeta)));
        if (zeta < 1)
            return std::exp(-zeta / root * std::atan2(2 * zeta * root, 2 * zeta * zeta - 1));
        return zeta == 1 ? std::exp(-2.0)
                         : std::exp(-zeta / root * std::log((zeta + root) / (zeta - root)));
    };
    double low = 0;
    double high = 2; // returns 5 %
    for (int i = 0; i < 40; ++i) {
        const double middle = (low + high) / 2;
        (returned(middle) > restitution ? low : high) = middle;
    }
    return high;
}

} // namespace

void RigidContacts::begin_step() noexcept {
    for (Point& point : point_)
        point.seen = false;
}

double RigidContacts::depth_of(const Point& p, std::span<const RigidShadow> shadow) noexcept {
    const Vec3 apart = shadow[p.shadow[0]].motion().pose.to_world(p.local[0]) -
                       shadow[p.shadow[1]].motion().pose.to_world(p.local[1]);
    return p.found - p.normal.dot(apart);
}

Vec3 RigidContacts::place_of(const Point& p, std::span<const RigidShadow> shadow) noexcept {
    return shadow[p.shadow[0]].motion().pose.to_world(p.local[0]);
}

bool RigidContacts::is_grazing(const Point& p, std::span<const RigidShadow> shadow) noexcept {
    const Vec3 apart = shadow[p.shadow[0]].motion().pose.to_world(p.local[0]) -
                       shadow[p.shadow[1]].motion().pose.to_world(p.local[1]);
    const bool live = shadow[p.shadow[0]].live() || shadow[p.shadow[1]].live();
    return live && depth_of(p, shadow) < kGraze && apart.norm() < kLoose;
}

RigidContacts::Point* RigidContacts::find(const Point& fresh,
                                          std::span<const RigidShadow> shadow) noexcept {
    const Vec3 place = place_of(fresh, shadow);
    Point* nearest = nullptr;
    double least = kSame * kSame;
    for (Point& old : point_) {
        if (old.seen || old.body[0] != fresh.body[0] || old.body[1] != fresh.body[1])
            continue;
        old.shadow[0] = fresh.shadow[0];
        old.shadow[1] = fresh.shadow[1];
        const double distance2 = (place_of(old, shadow) - place).squaredNorm();
        if (distance2 < least && old.normal.dot(fresh.normal) > 0.9) {
            least = distance2;
            nearest = &old;
        }
    }
    return nearest;
}

void RigidContacts::meet(const dContact& contact, std::size_t first, std::size_t second,
                         std::span<const RigidShadow> shadow, double h, double dt) {
    const RigidShadow& a = shadow[first];
    const RigidShadow& b = shadow[second];
    const dSurfaceParameters& surface = contact.surface;
    const Vec3 place(contact.geom.pos[0], contact.geom.pos[1], contact.geom.pos[2]);
    Point p;
    p.body[0] = a.body();
    p.body[1] = b.body();
    p.shadow[0] = first;
    p.shadow[1] = second;
    p.local[0] = a.motion().pose.to_local(place);
    p.local[1] = b.motion().pose.to_local(place);
    p.normal = Vec3(contact.geom.normal[0], contact.geom.normal[1], contact.geom.normal[2]);
    p.found = contact.geom.depth;
    p.offset = p.found;
    p.stretch.setZero();
    p.friction = surface.mu;
    p.coulomb = (surface.mode & dContactApprox1_1) != 0;
    p.drive.setZero();
    if ((surface.mode & dContactMotion1) != 0 && (surface.mode & dContactFDir1) != 0)
        p.drive = surface.motion1 * Vec3(contact.fdir1[0], contact.fdir1[1], contact.fdir1[2]);
    p.seen = true;

    const double compliance = a.compliance(place, p.normal) + b.compliance(place, p.normal);
    const double bearable = kShare / (dt * dt * compliance);
    if ((surface.mode & dContactSoftCFM) != 0 && surface.soft_cfm > 0) {
        const double erp = (surface.mode & dContactSoftERP) != 0 ? surface.soft_erp : 0.2;
        p.stiffness = std::fmin(bearable, erp / (h * surface.soft_cfm));
        p.damping = (1 - erp) / surface.soft_cfm;
    } else {
        const Vec3 slip = a.motion().velocity_at(place) - b.motion().velocity_at(place);
        const bool bounces =
            (surface.mode & dContactBounce) != 0 && -slip.dot(p.normal) > surface.bounce_vel;
        p.stiffness = std::fmin(bearable, kStiffness);
        p.damping =
            2 * damping_ratio(bounces ? surface.bounce : 0) * std::sqrt(p.stiffness / compliance);
    }
    Point* old = find(p, shadow);
    if (!old) {
        point_.push_back(p);
        return;
    }
    // While ODE's own result stands, bodies move by its contacts: what these compressed is no
    // memory of this spring's, and would throw the pile apart.
    if (!a.live() && !b.live()) {
        *old = p;
        return;
    }
    if (old->stiffness <= bearable) { // one that bears keeps its law
        p.stiffness = old->stiffness;
        p.damping = old->damping;
    }
    p.offset = p.found - (depth_of(*old, shadow) - old->offset);
    p.stretch = old->stretch - p.normal.dot(old->stretch) * p.normal;
    *old = p;
}

void RigidContacts::begin_substep(std::span<RigidShadow> shadow, double dt) noexcept {
    const double fade = std::exp(-kFading * dt);
    for (Point& p : point_) {
        const RigidShadow& a = shadow[p.shadow[0]];
        const RigidShadow& b = shadow[p.shadow[1]];
        p.press = 0;
        p.compliance = 0;
        if (!a.moves() && !b.moves())
            continue;
        p.place = place_of(p, shadow);
        p.slip = a.motion().velocity_at(p.place) - b.motion().velocity_at(p.place);
        p.offset *= fade;
        p.depth = depth_of(p, shadow) - p.offset;
        p.compliance = a.compliance(p.place, p.normal) + b.compliance(p.place, p.normal);
    }
}

double RigidContacts::sweep(std::span<RigidShadow> shadow, double dt) noexcept {
    double change = 0;
    double sum = 0;
    for (Point& p : point_) {
        if (p.compliance == 0)
            continue;
        RigidShadow& a = shadow[p.shadow[0]];
        RigidShadow& b = shadow[p.shadow[1]];
        const Vec3 ahead = a.velocity_ahead(p.place, dt) - b.velocity_ahead(p.place, dt);
        const double press =
            NormalContact{.stiffness = p.stiffness,
                          .damping = p.damping,
                          .compliance = p.compliance,
                          .depth = p.depth,
                          .speed = -p.slip.dot(p.normal),
                          .ahead = -ahead.dot(p.normal) + dt * p.compliance * p.press}
                .press(dt)
                .force;
        const double more = press - p.press;
        p.press = press;
        sum += press;
        if (more == 0)
            continue;
        change += std::fabs(more);
        apply(p, more * p.normal, shadow);
    }
    return sum > 0 ? change / sum : 0;
}

void RigidContacts::apply(const Point& p, const Vec3& f, std::span<RigidShadow> shadow) noexcept {
    RigidShadow& a = shadow[p.shadow[0]];
    RigidShadow& b = shadow[p.shadow[1]];
    a.add_from_rigid({f, (p.place - a.motion().pose.position).cross(f)});
    b.add_from_rigid({-f, -(p.place - b.motion().pose.position).cross(f)});
}

std::size_t RigidContacts::drag(std::span<RigidShadow> shadow, double dt) noexcept {
    std::size_t bearing = 0;
    for (Point& p : point_) {
        if (p.compliance == 0)
            continue;
        if (p.press == 0) {
            p.stretch.setZero();
            continue;
        }
        ++bearing;
        const double grip = p.coulomb ? p.friction * p.press : p.friction;
        const double k = kTangential * p.stiffness;
        const Vec3 across = p.slip - p.slip.dot(p.normal) * p.normal - p.drive;
        p.stretch += dt * across;
        clamp_length(p.stretch, grip / k);
        Vec3 f = -k * p.stretch - 2 * kTangentialDamping * std::sqrt(k / p.compliance) * across;
        clamp_length(f, grip);
        apply(p, f, shadow);
    }
    return bearing;
}

} // namespace ode::soft
