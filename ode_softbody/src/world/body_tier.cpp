// Whether a body moves node by node or in its modes, and how it changes from one to the other.
#include "base/error.h"
#include "collide/rigid_shape.h"
#include "world/body.h"
#include "world/modal_limits.h"
#include "world/soft_world.h"

#include <ode/objects.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ode::soft {
namespace {

constexpr double kWellWithin = 0.5; ///< of the tolerance, before modes take over: hysteresis
constexpr double kUrgent = 4;       ///< tolerances off: not even a contact is waited for
constexpr int kSampled = 8;         ///< steps between estimates of the error in modes
constexpr int kSettled = 2;         ///< steps between looks whether modes may take over
constexpr double kGrown = 1.5;      ///< of the displacement, that asks for one at once

// Relative error of the linear waveform against the non-linear one, by the largest displacement in
// thicknesses: of a bowl 0.1 over 20 ms (tests/physics/tier/free_strike_test.cpp), and up to 0.3
// over 50 ms.
constexpr double kErrorPerThickness = 0.3;
constexpr double kLeastError = 1.4e-3;
// The cubic tier's: 0.02 of a bowl struck in flight, 0.18 of one that falls on a floor
// (fall_test.cpp), whose high modes are not kept. Further bent, the polynomial is none of the
// solid's energy.
constexpr double kCubicErrorPerThickness = 0.18;
constexpr double kMostBent = 0.25;

// What moves slower than kGentle is pushed at kGentlePace, whose forces move no mode above
// kGentleBand.
constexpr double kGentleAfter = 0.01; ///< without a blow [s]

// Contact in modes: 16 substeps to the period of the highest audible tone.
constexpr double kContactPace = 1 / (16 * kAudible);
// What lies or rolls has no blow to resolve: sound alone asks for its substep.
constexpr double kGentlePace = 1 / (4 * kAudible);
// Nodes are shown to observers eight times a period of the highest audible tone.
constexpr double kWatchedPace = 1 / (8 * kAudible);
constexpr double kGentle = 0.1; ///< [m/s]
constexpr double kEarly = 4;    ///< steps in which no blow may come, before modes take over

/// Of ODE's body; none: the world's.
RigidMotion motion_of(dBodyID body) {
    RigidMotion motion;
    if (!body)
        return motion;
    motion.pose.position = Eigen::Map<const Vec3>(dBodyGetPosition(body));
    const dReal* r = dBodyGetRotation(body);
    motion.pose.rotation << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
    motion.velocity = Eigen::Map<const Vec3>(dBodyGetLinearVel(body));
    motion.spin = Eigen::Map<const Vec3>(dBodyGetAngularVel(body));
    return motion;
}

} // namespace

void Body::set_tier(TierChoice choice) noexcept {
    tier_choice_ = choice;
    unsampled_ = kSampled;
    if (choice == TierChoice::explicit_space)
        leave_modes();
}

void Body::forget_modes() noexcept {
    leave_modes();
    idle_modes_.reset();
    modes_known_ = cubic_known_ = false;
    unsampled_ = kSampled;
}

void Body::estimate_errors(ModalTier& modes) noexcept {
    const double swing = modes.motion().displacement_envelope(contact_nodes_.node);
    linear_error_ = linear_error_of(swing);
    cubic_error_ = cubic_error_of(swing);
}

double Body::linear_error_of(double displacement) const noexcept {
    return kLeastError + kErrorPerThickness * displacement / thickness_;
}

double Body::cubic_error_of(double displacement) const noexcept {
    const double bent = displacement / thickness_;
    return bent > kMostBent ? std::numeric_limits<double>::infinity()
                            : kLeastError + kCubicErrorPerThickness * bent;
}

void Body::choose_tier() noexcept {
    if (tier_choice_ == TierChoice::explicit_space)
        return;
    if (!may_ring()) {
        leave_modes();
        return;
    }
    if (tier_choice_ != TierChoice::automatic) {
        const bool bends = tier_choice_ == TierChoice::cubic && may_bend();
        if (!modes_)
            enter_modes(bends);
        else if (bends != this->bends())
            bend(bends);
        choose_band(blow_ahead(1));
        return;
    }
    ++unsampled_;
    if (modes_) {
        choose_in_modes(blow_ahead(1));
        return;
    }
    if (unsampled_ < kSettled || bearing_points_ != 0)
        return;
    const double blow = blow_ahead(kEarly);
    bool cubic = !bears_in_modes(blow, *idle_modes_, false);
    if (cubic && !(bears_in_modes(blow, *idle_modes_, true) && may_bend()))
        return;
    unsampled_ = 0;
    level_velocity();
    ModalMotion& motion = idle_modes_->motion();
    motion.use_cubic(cubic);
    double lost = motion.take(state_, pinned_);
    estimate_errors(*idle_modes_);
    const double bearable = kWellWithin * waveform_tolerance_;
    if (!cubic && linear_error_ > bearable) {
        if (cubic_error_ > bearable || !may_bend())
            return;
        cubic = true;
        motion.use_cubic(true);
        lost = motion.take(state_, pinned_);
    }
    if (cubic && cubic_error_ > bearable)
        return;
    // What is in no mode would be lost with the change.
    if (lost > noise_ + bearable * bearable * (motion.vibration_energy() + lost))
        return;
    sampled_at_ = motion.largest_displacement();
    enter_modes(cubic);
}

void Body::choose_in_modes(double blow) noexcept {
    const bool linear = bears_in_modes(blow, *modes_, false);
    if (!linear && !bends()) {
        if (!bears_in_modes(blow, *modes_, true) || !may_bend()) {
            leave_modes();
            return;
        }
        bend(true);
    } else if (!linear && !bears_in_modes(blow, *modes_, true)) {
        leave_modes();
        return;
    }
    choose_band(blow);
    const double now = modes_->motion().largest_displacement();
    if (unsampled_ < kSampled && now < kGrown * sampled_at_)
        return;
    unsampled_ = 0;
    sampled_at_ = now;
    estimate_errors(*modes_);
    const double most = (bearing_points_ == 0 ? 1 : kUrgent) * waveform_tolerance_;
    if (bends() && cubic_error_ > most)
        leave_modes();
    else if (bends() && linear && linear_error_ < kWellWithin * waveform_tolerance_)
        bend(false);
    else if (!bends() && linear_error_ > waveform_tolerance_) {
        if (cubic_error_ <= waveform_tolerance_ && may_bend())
            bend(true);
        else if (linear_error_ > most)
            leave_modes();
    }
}

void Body::choose_band(double blow) noexcept {
    gentle_for_ = blow > kGentle ? 0 : gentle_for_ + world_.last_step();
    const ModalBasis& basis = modes_->motion().basis();
    const std::size_t band = gentle_for_ > kGentleAfter ? basis.gentle_columns : basis.columns;
    if (band != modes_->motion().band())
        set_band(band);
}

void Body::set_band(std::size_t columns) noexcept {
    const ModalBasis& basis = modes_->motion().basis();
    modes_->motion().set_band(columns);
    const ResidualFlexibility& residual =
        columns == basis.columns ? basis.residual : basis.gentle_residual;
    contact_nodes_.residual = residual.normal;
    contact_nodes_.residual_across = residual.across;
}

bool Body::bears_in_modes(double blow, ModalTier& modes, bool cubic) noexcept {
    if (blow <= kGentle)
        return true;
    const ModalBasis& basis = modes.motion().basis();
    if (basis.modes == kMostModes &&
        basis.omega[basis.modes - 1] < 2 * std::numbers::pi * kLeastBand)
        return false;
    // A blow displaces what it strikes by its speed over the lowest frequency at most.
    const double swing = (modes_ ? modes.motion().displacement_envelope(contact_nodes_.node) : 0) +
                         blow / basis.omega[0];
    return (cubic ? cubic_error_of(swing) : linear_error_of(swing)) <= waveform_tolerance_;
}

double Body::blow_ahead(double steps) noexcept {
    if (rigid_pair_.empty())
        return 0;
    RoughPlaces* const rough = modes_ ? &modes_->rough_places(true) : nullptr;
    const double ahead = steps * world_.last_step();
    const double highest = contact_nodes_.shape.highest;
    double fastest = 0;
    for (const RigidPair& pair : rigid_pair_) {
        const std::optional<RigidShape> shape = capture_shape(pair.geom);
        if (!shape)
            continue;
        const RigidMotion other = motion_of(shape->body);
        // The distance of other shapes takes more to tell.
        const bool told = shape->kind != ShapeKind::probed && shape->kind != ShapeKind::convex;
        const auto judge = [&](int node) {
            if (rough)
                rough->place(node);
            const auto n = static_cast<std::size_t>(node);
            const Vec3 x = state_.position[n];
            const Vec3 slip = Vec3(state_.velocity[n]) - other.velocity_at(x);
            if (!told) {
                fastest = std::max(fastest, slip.norm());
                return;
            }
            const SurfaceDistance gap = shape->distance_at(other.pose, x);
            const double closing = -gap.normal.dot(slip);
            if (gap.distance - highest < ahead * closing)
                fastest = std::max(fastest, closing);
        };
        if (!rough || !told) {
            std::for_each(contact_nodes_.node.begin(), contact_nodes_.node.end(), judge);
            continue;
        }
        // Most are out of reach by where the frame carries them.
        const double spin = (rough->frame().spin - other.spin).norm();
        const auto is_far = [&](const Vec3& x, double radius) {
            const Vec3 slip = rough->frame().velocity_at(x) - other.velocity_at(x);
            const double gap = shape->distance_at(other.pose, x).distance - radius - rough->off();
            return gap - highest >= ahead * (slip.norm() + spin * radius + rough->rush());
        };
        for (const NodeGroups::Group& group : rough->groups().groups()) {
            if (is_far(rough->frame().pose.to_world(group.center), group.radius))
                continue;
            for (const int i : rough->groups().members(group)) {
                const int node = contact_nodes_.node[static_cast<std::size_t>(i)];
                if (!is_far(rough->carried(node), 0))
                    judge(node);
            }
        }
    }
    return fastest;
}

void Body::level_velocity() noexcept {
    if (last_dt_ > 0) {
        std::copy_n(load_.data(), NodeArray::kStride * load_.size(), force_.data());
        contacts_.each([&](std::size_t n, const auto& f) { force_[n] += f; });
        integrator_->end(*model_, NodeInertia{inverse_mass_}, last_dt_, state_, force_);
    }
    last_dt_ = 0;
}

void Body::bend(bool on) noexcept {
    modes_->motion().use_cubic(on);
    modes_->moved(true);
    ++tier_changes_;
}

void Body::enter_modes(bool bends) noexcept {
    level_velocity();
    modes_ = std::move(idle_modes_);
    modes_->motion().use_cubic(bends);
    modes_->motion().take(state_, pinned_);
    modes_->moved(true);
    set_band(modes_->motion().basis().columns);
    gentle_for_ = 0;
    world_.exchange_.forget(*this);
    force_.set_zero();
    contacts_.clear();
    undamped_ = 0;
    ++tier_changes_;
}

void Body::leave_modes() noexcept {
    if (!modes_)
        return;
    modes_->motion().level();
    modes_->refresh();
    idle_modes_ = std::move(modes_);
    contact_nodes_.residual.clear();
    contact_nodes_.residual_across.clear();
    world_.exchange_.forget(*this);
    last_dt_ = 0;
    budget_.restart();
    ++tier_changes_;
}

void Body::begin_ringing_step(const Vec3& gravity) noexcept {
    modes_->motion().set_load(gravity, has_external_ ? &external_ : nullptr);
    modes_->keep();
    modes_->clear_near();
}

void Body::advance_ringing(double dt) noexcept {
    const bool pushed = !contacts_.empty();
    if (pushed) {
        modes_->motion().push(contacts_, state_, dt);
        contacts_.each([&](std::size_t n, const auto&) { force_[n].setZero(); });
    }
    modes_->motion().advance(dt);
    modes_->moved(pushed);
    if (!looking_)
        return;
    const double energy = modes_->motion().vibration_energy();
    in_budget_ = std::isfinite(energy) && std::isfinite(modes_->motion().rigid_energy());
}

void Body::pace(bool watched) noexcept {
    double longest = watched ? kWatchedPace : std::numeric_limits<double>::infinity();
    if (const CubicKicks* kicks = modes_->motion().cubic())
        longest = std::min(longest, kicks->longest());
    modes_->set_pace(longest);
}

double Body::contact_pace(double speed) const noexcept {
    return std::max(speed > kGentle ? kContactPace : kGentlePace, contact_substep());
}

} // namespace ode::soft
