// Whether a body moves node by node or in its modes, and how it changes from one to the other.
#include "base/error.h"
#include "collide/rigid_shape.h"
#include "mesh/jacobian.h"
#include "modal/cache.h"
#include "modal/modal_decay.h"
#include "reduced/residual_flexibility.h"
#include "world/body.h"
#include "world/soft_world.h"

#include <ode/objects.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ode::soft {
namespace {

constexpr double kAudible = 22000;      ///< [Hz]
constexpr std::size_t kMostModes = 500; ///< a body with more is soft: it deforms rather than rings
// Modes up to here take part in contact, whose pulses are far shorter than the shortest period that
// is heard: with those heard alone, a blow errs by 16 % (tests/physics/tier/fall_test.cpp).
constexpr double kContactBand = 3.5 * kAudible;
constexpr double kLeastBand = 3 * kAudible; ///< where that takes more than kMostModes

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

// What moves slower than kGentle is pushed at kGentlePace, whose forces move no higher mode.
constexpr double kGentleBand = 2 * kAudible;
constexpr double kGentleAfter = 0.01; ///< without a blow [s]

// Contact in modes: 16 substeps to the period of the highest audible tone.
constexpr double kContactPace = 1 / (16 * kAudible);
// What lies or rolls has no blow to resolve: sound alone asks for its substep.
constexpr double kGentlePace = 1 / (4 * kAudible);
// Nodes are shown to observers eight times a period of the highest audible tone.
constexpr double kWatchedPace = 1 / (8 * kAudible);
constexpr double kGentle = 0.1; ///< [m/s]
constexpr double kEarly = 4;    ///< steps in which no blow may come, before modes take over

std::vector<Vec3> rest_normals(const TetMesh& mesh, const SurfaceNodes& surface) {
    std::vector<Vec3> out;
    for (const int node : surface.node) {
        Vec3 sum = Vec3::Zero();
        for (const int t : surface.fan(node)) {
            const auto& [a, b, c] = surface.triangle[static_cast<std::size_t>(t)];
            const Vec3& corner = mesh.node[static_cast<std::size_t>(a)];
            sum += (mesh.node[static_cast<std::size_t>(b)] - corner)
                       .cross(mesh.node[static_cast<std::size_t>(c)] - corner);
        }
        out.push_back(sum.stableNormalized());
    }
    return out;
}

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

/// Whether held nodes hold a body fast: three that are in no line.
bool hold_fast(const TetMesh& mesh, std::span<const int> held) {
    for (std::size_t i = 2; i < held.size(); ++i) {
        const Vec3& a = mesh.node[static_cast<std::size_t>(held[0])];
        const Vec3 one = mesh.node[static_cast<std::size_t>(held[1])] - a;
        const Vec3 two = mesh.node[static_cast<std::size_t>(held[i])] - a;
        if (one.cross(two).norm() > 1e-6 * one.norm() * two.norm())
            return true;
    }
    return false;
}

} // namespace

void Body::set_tier(TierChoice choice) noexcept {
    tier_choice_ = choice;
    unsampled_ = kSampled;
    if (choice == TierChoice::explicit_space)
        leave_modes();
}

std::shared_ptr<const ModalBasis> Body::find_basis() noexcept {
    try {
        ModalOptions options;
        options.order = mesh_.order;
        options.mass = MassKind::kLumped; // as the nodes move: a change of tier changes no pitch
        options.estimate = false;
        options.max_frequency = kContactBand;
        options.max_modes = kMostModes;
        options.clamped = pinned_;
        // A table of decays is the body's own: nothing to share.
        const std::string key =
            form_.damping_table.empty() ? content_hash(mesh_, solids_, options) : std::string();
        return world_.basis_cabinet().get(key, [&] {
            const ModalModel modes = cached_modes(mesh_, solids_, options);
            if (modes.mode_count() == 0 || modes.frequency.front() > kAudible)
                throw InputError("it has no vibration mode below 22 kHz");
            if (!modes.complete && modes.frequency.back() < kAudible)
                throw InputError(format("it has more than %zu modes below 22 kHz: it is too "
                                        "soft to be computed by them",
                                        kMostModes));
            if (modes.rigid_modes != (pinned_.empty() ? 6 : 0))
                throw InputError(format("it has %d motions without strain: it is not one piece "
                                        "that is free or held fast",
                                        modes.rigid_modes));
            std::vector<double> decay;
            if (form_.damping_table.empty())
                decay = modal_decays(mesh_, solids_, modes);
            else
                for (const double f : modes.frequency)
                    decay.push_back(form_.damping_table.decay(f));
            ModalBasis basis = make_basis(modes, mesh_.node, mass(), decay, kAudible, kGentleBand,
                                          !pinned_.empty());
            const std::vector<Vec3> normal = rest_normals(mesh_, contact_nodes_);
            const std::size_t kept[] = {std::min(basis.gentle_columns, basis.modes), basis.modes};
            auto residual = residual_flexibility(mesh_, solids_, options, modes,
                                                 {contact_nodes_.node, normal}, kept);
            basis.gentle_residual = std::move(residual[0]);
            basis.residual = std::move(residual[1]);
            return basis;
        });
    } catch (const std::exception& e) {
        if (tier_choice_ == TierChoice::modes)
            report(format("a soft body of %zu nodes stays in the explicit tier: %s",
                          mesh_.node.size(), e.what()));
        return nullptr;
    }
}

void Body::forget_modes() noexcept {
    leave_modes();
    idle_modes_.reset();
    modes_known_ = false;
    unsampled_ = kSampled;
}

bool Body::may_ring() noexcept {
    if (!nailed_.empty() || (!pinned_.empty() && !hold_fast(mesh_, pinned_)))
        return false;
    if (modes_ || modes_known_)
        return modes_ || idle_modes_;
    modes_known_ = true;
    if (const auto basis = find_basis()) {
        idle_modes_ = std::make_unique<ModalTier>(basis, contact_nodes_,
                                                  rest_normals(mesh_, contact_nodes_), state_);
        double volume = 0, area = 0;
        for (std::size_t e = 0; e < mesh_.element_count(); ++e)
            volume += element_volume(mesh_, e);
        for (const double a : contact_nodes_.area)
            area += a;
        thickness_ = 2 * volume / area;
    }
    return idle_modes_ != nullptr;
}

double Body::estimate_linear_error(ModalTier& modes) noexcept {
    return linear_error_of(modes.motion().displacement_envelope(contact_nodes_.node));
}

double Body::linear_error_of(double displacement) const noexcept {
    return kLeastError + kErrorPerThickness * displacement / thickness_;
}

void Body::choose_tier() noexcept {
    if (tier_choice_ == TierChoice::explicit_space)
        return;
    if (!may_ring()) {
        leave_modes();
        return;
    }
    if (tier_choice_ == TierChoice::modes) {
        if (!modes_)
            enter_modes();
        choose_band(blow_ahead(1));
        return;
    }
    ++unsampled_;
    if (modes_) {
        const double blow = blow_ahead(1);
        if (!bears_in_modes(blow, *modes_)) {
            leave_modes();
            return;
        }
        choose_band(blow);
        const double now = modes_->motion().largest_displacement();
        if (unsampled_ < kSampled && now < kGrown * sampled_at_)
            return;
        unsampled_ = 0;
        sampled_at_ = now;
        linear_error_ = estimate_linear_error(*modes_);
        if (linear_error_ > (bearing_points_ == 0 ? 1 : kUrgent) * waveform_tolerance_)
            leave_modes();
        return;
    }
    if (unsampled_ < kSettled || bearing_points_ != 0)
        return;
    const double blow = blow_ahead(kEarly);
    if (!bears_in_modes(blow, *idle_modes_))
        return;
    unsampled_ = 0;
    level_velocity();
    ModalMotion& motion = idle_modes_->motion();
    const double lost = motion.take(state_, pinned_);
    linear_error_ = estimate_linear_error(*idle_modes_);
    if (linear_error_ > kWellWithin * waveform_tolerance_)
        return;
    // What is in no mode would be lost with the change.
    const double bearable = kWellWithin * waveform_tolerance_;
    if (lost > noise_ + bearable * bearable * (motion.vibration_energy() + lost))
        return;
    sampled_at_ = motion.largest_displacement();
    enter_modes();
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

bool Body::bears_in_modes(double blow, ModalTier& modes) noexcept {
    if (blow <= kGentle)
        return true;
    const ModalBasis& basis = modes.motion().basis();
    if (basis.modes == kMostModes &&
        basis.omega[basis.modes - 1] < 2 * std::numbers::pi * kLeastBand)
        return false;
    // A blow displaces what it strikes by its speed over the lowest frequency at most.
    const double swing = (modes_ ? modes.motion().displacement_envelope(contact_nodes_.node) : 0) +
                         blow / basis.omega[0];
    return linear_error_of(swing) <= waveform_tolerance_;
}

double Body::blow_ahead(double steps) noexcept {
    if (rigid_pair_.empty())
        return 0;
    RoughPlaces* const rough = modes_ ? &modes_->rough_places() : nullptr;
    for (std::size_t i = 0; rough && i < contact_nodes_.node.size(); ++i)
        rough->place(contact_nodes_.node[i]);
    const double ahead = steps * world_.last_step();
    double fastest = 0;
    for (const RigidPair& pair : rigid_pair_) {
        const std::optional<RigidShape> shape = capture_shape(pair.geom);
        if (!shape)
            continue;
        const RigidMotion other = motion_of(shape->body);
        // The distance of other shapes takes more to tell.
        const bool told = shape->kind != ShapeKind::probed && shape->kind != ShapeKind::convex;
        for (const int node : contact_nodes_.node) {
            const auto n = static_cast<std::size_t>(node);
            const Vec3 x = state_.position[n];
            const Vec3 slip = Vec3(state_.velocity[n]) - other.velocity_at(x);
            if (!told) {
                fastest = std::max(fastest, slip.norm());
                continue;
            }
            const SurfaceDistance gap = shape->distance_at(other.pose, x);
            const double closing = -gap.normal.dot(slip);
            if (gap.distance - contact_nodes_.shape.highest < ahead * closing)
                fastest = std::max(fastest, closing);
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

void Body::enter_modes() noexcept {
    level_velocity();
    modes_ = std::move(idle_modes_);
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
    modes_->set_pace(watched ? kWatchedPace : std::numeric_limits<double>::infinity());
}

double Body::contact_pace(double speed) const noexcept {
    return std::max(speed > kGentle ? kContactPace : kGentlePace, contact_substep());
}

} // namespace ode::soft
