#include "world/body.h"

#include "base/tasks.h"
#include "collide/ray.h"
#include "integrate/critical_step.h"
#include "integrate/mass_damping.h"
#include "world/soft_world.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

// Of a method without a limit: a quarter of a sample at 48 kHz. The trapezoidal rule is then (w
// h)^2 / 12 flat, which is a cent at 4 kHz.
constexpr double kImplicitStep = 1 / (4 * 48e3);

// Of coordinates: what rounding may heap up over millions of substeps, and still be no energy.
constexpr double kRounding = 1e-12;

// Mass-proportional damping is applied in portions: of at most this many substeps, so that it costs
// a few per cent, and of at most this loss, so that no portion is a blow.
constexpr double kDampingInterval = 16;
constexpr double kDampingLoss = 1e-3;

} // namespace

Body::~Body() {
    if (!geom_)
        return;
    forget_space(geom_);
    destroy_soft_geom(geom_);
}

Body* Body::behind(dGeomID geom) noexcept { return static_cast<Body*>(soft_geom_client(geom)); }

void Body::use_default_substep() noexcept {
    substep_ = is_explicit_ ? kSubstepSafety * longest_substep_ : kImplicitStep;
    caution_ = 1;
}

Vec3 Body::center_of_mass() const noexcept {
    const NodeState& now = state();
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < mass().size(); ++i)
        sum += mass()[i] * now.position[i];
    return sum / total_mass_;
}

Vec3 Body::linear_momentum() const noexcept {
    const NodeState& now = state();
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < mass().size(); ++i)
        sum += mass()[i] * now.velocity[i];
    return sum;
}

Vec3 Body::angular_momentum() const noexcept {
    const NodeState& now = state();
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < mass().size(); ++i)
        sum += mass()[i] * now.position[i].cross(now.velocity[i]);
    return sum;
}

double Body::kinetic_energy() const noexcept {
    const NodeState& now = state();
    double sum = 0;
    for (std::size_t i = 0; i < mass().size(); ++i)
        sum += mass()[i] * now.velocity[i].squaredNorm();
    return sum / 2;
}

double Body::elastic_energy() const noexcept { return model_->energy(state().position); }

void Body::move_to(const Vec3& center) noexcept {
    wake();
    leave_modes();
    budget_.restart();
    const Vec3 offset = center - center_of_mass();
    for (std::size_t i = 0; i < state_.position.size(); ++i)
        state_.position[i] += offset;
    moved();
}

void Body::rotate(const Quat& rotation) noexcept {
    wake();
    leave_modes();
    budget_.restart();
    const Mat3 turn = rotation.toRotationMatrix();
    const Vec3 center = center_of_mass();
    for (std::size_t i = 0; i < state_.position.size(); ++i) {
        state_.position[i] = center + turn * (state_.position[i] - center);
        state_.velocity[i] = turn * Vec3(state_.velocity[i]);
    }
    moved();
}

void Body::set_velocity(const Vec3& velocity) noexcept {
    wake();
    leave_modes();
    budget_.restart();
    for (std::size_t i = 0; i < state_.velocity.size(); ++i)
        state_.velocity[i] = is_pinned(static_cast<int>(i)) ? Vec3::Zero() : velocity;
}

void Body::add_spin(const Vec3& omega) noexcept {
    wake();
    leave_modes();
    budget_.restart();
    const Vec3 center = center_of_mass();
    for (std::size_t i = 0; i < state_.velocity.size(); ++i)
        if (!is_pinned(static_cast<int>(i)))
            state_.velocity[i] += omega.cross(state_.position[i] - center);
}

void Body::hold(int node) noexcept {
    const auto i = static_cast<std::size_t>(node);
    if (inverse_mass_[i] == 0)
        return;
    wake();
    forget_modes();
    inverse_mass_[i] = 0;
    modes_stale_ = true;
    budget_.restart();
    state_.velocity[i].setZero();
    pinned_.insert(std::lower_bound(pinned_.begin(), pinned_.end(), node), node);
}

void Body::pin(std::span<const int> nodes) noexcept {
    for (const int node : nodes)
        hold(node);
    each_middle([&](int a, int b, int middle) {
        if (is_held(a) && is_held(b))
            hold(middle);
    });
}

template <class Visit>
void Body::each_middle(Visit visit) const {
    if (mesh_.node.size() == given_nodes_)
        return;
    for (std::size_t e = 0; e < mesh_.element_count(); ++e) {
        const auto n = mesh_.nodes_of(e);
        for (std::size_t i = 0; i < 6; ++i)
            visit(n[static_cast<std::size_t>(kTetEdge[i][0])],
                  n[static_cast<std::size_t>(kTetEdge[i][1])], n[4 + i]);
    }
}

std::vector<int> Body::nail(std::span<const int> nodes) {
    std::vector<std::uint8_t> taken(mesh_.node.size());
    std::vector<int> all;
    wake();
    forget_modes();
    modes_stale_ = true;
    budget_.restart();
    const auto take = [&](int node) {
        if (is_held(node))
            return;
        all.push_back(node);
        nailed_.push_back(node);
        inverse_mass_[static_cast<std::size_t>(node)] = 0;
        taken[static_cast<std::size_t>(node)] = 1;
    };
    for (const int node : nodes)
        take(node);
    each_middle([&](int a, int b, int middle) {
        if (taken[static_cast<std::size_t>(a)] && taken[static_cast<std::size_t>(b)])
            take(middle);
    });
    return all;
}

void Body::release(int node) noexcept {
    const auto i = static_cast<std::size_t>(node);
    wake();
    forget_modes();
    inverse_mass_[i] = 1 / mass()[i];
    modes_stale_ = true;
    budget_.restart();
    std::erase(nailed_, node);
}

void Body::set_nailed_mass(bool own) noexcept {
    for (const int node : nailed_) {
        const auto i = static_cast<std::size_t>(node);
        inverse_mass_[i] = own ? 1 / mass()[i] : 0;
    }
}

void Body::unpin() noexcept {
    for (const int node : pinned_)
        release(node);
    pinned_.clear();
}

void Body::add_force(int node, const Vec3& force) noexcept {
    wake();
    external_[static_cast<std::size_t>(node)] += force;
    has_external_ = true;
}

void Body::fit_velocity(double dt) noexcept {
    if (dt == last_dt_ || modes_)
        return;
    // A velocity half of another substep old would be a kick to every mode, largest for the
    // fastest: changing substeps would pump energy.
    // Nailed nodes hand on what they get, so that the sum of all changes stays zero.
    set_nailed_mass(true);
    const NodeInertia inertia{inverse_mass_};
    const auto take_force = [&] {
        std::copy_n(load_.data(), NodeArray::kStride * load_.size(), force_.data());
        if (last_dt_ > 0 && !meets_movable_)
            contacts_.each([&](std::size_t n, const auto& f) { force_[n] += f; });
    };
    if (last_dt_ > 0) {
        if (lags_ && meets_movable_)
            book_lag(dt);
        take_force();
        integrator_->end(*model_, inertia, last_dt_, state_, force_);
    }
    take_force();
    integrator_->begin(*model_, inertia, dt, state_, force_);
    set_nailed_mass(false);
    last_dt_ = dt;
}

void Body::take_load(const Vec3& gravity) noexcept {
    const std::span<const double> m = mass();
    for (std::size_t i = 0; i < load_.size(); ++i)
        load_[i] = m[i] * gravity;
    if (has_external_)
        for (std::size_t i = 0; i < load_.size(); ++i)
            load_[i] += external_[i];
    total_load_.setZero();
    double far2 = 0;
    for (std::size_t i = 0; i < load_.size(); ++i) {
        total_load_ += load_[i];
        far2 = std::max(far2, state_.position[i].squaredNorm());
    }
    const double rounding = kRounding * largest_frequency_ * std::sqrt(far2); // [m/s]
    // Nor is there harm in a body that all but rests: growth is out of it within a few substeps.
    constexpr double kStill = 1e-6; // [m/s]
    noise_ = total_mass_ * (rounding * rounding + kStill * kStill / 2) + elastic_noise_;
    load_at_look_ = load_now();
}

void Body::begin_substep(bool look) noexcept {
    if (modes_) {
        bearing_points_ = 0;
        contacts_.clear();
        looking_ = look;
        return;
    }
    in_ranges(load_.size(), kLeastNodes, [&](std::size_t first, std::size_t last) {
        const std::size_t at = NodeArray::kStride * first;
        std::copy_n(load_.data() + at, NodeArray::kStride * (last - first), force_.data() + at);
    });
    const StrainExtremes now = integrator_->evaluate(*model_, state_, force_);
    note(now);
    elastic_ = now.energy;
    bearing_points_ = 0;
    budget_.begin_substep();
    contacts_.clear();
    meets_movable_ = false;
    looking_ = look || budget_.is_suspicious(elastic_, swing_, noise_);
    if (!looking_)
        return;
    before_ = kinetic_sums(mass(), state_.velocity);
    add_load_sums(mass(), state_.position, load_, before_);
    frame_velocity_ = is_free() ? Vec3(before_.momentum / total_mass_) : Vec3(Vec3::Zero());
}

void Body::note(const StrainExtremes& now) noexcept {
    extremes_.min_jacobian = std::min(extremes_.min_jacobian, now.min_jacobian);
    extremes_.max_stretch = std::max(extremes_.max_stretch, now.max_stretch);
}

void Body::advance(double dt) noexcept {
    if (modes_) {
        advance_ringing(dt);
        return;
    }
    const double before = contact_work(dt);
    const StrainExtremes met =
        integrator_->step(*model_, NodeInertia{inverse_mass_}, dt, state_, force_);
    note(met);
    if (met.max_stretch == kFailedStep.max_stretch) {
        failed_solve_ = looking_ = true;
        ++failed_solves_;
    }
    book_contacts(before, dt);
    damp(dt);
    if (looking_)
        finish_look(dt);
}

void Body::damp(double dt) noexcept {
    if (modal_damping_) {
        const double before = nailed_energy();
        modal_damping_->advance(dt, state_);
        budget_.add_past_work(nailed_energy() - before);
    }
    if (max_alpha_ == 0)
        return;
    undamped_ += dt;
    if (undamped_ >= std::min(kDampingInterval * dt, kDampingLoss / max_alpha_)) {
        damp_deformation(mass(), inverse_mass_, pinned_, alpha_, undamped_, state_);
        undamped_ = 0;
    }
}

void Body::end_step() noexcept {
    if (!modes_) {
        relax_margin();
        watch_inversion();
        budget_.add_past_work(load_now() - load_at_look_);
    }
    if (!has_external_)
        return;
    external_.set_zero();
    has_external_ = false;
}

Aabb Body::aabb() noexcept {
    Aabb box = modes_ ? modes_->box() : Aabb::empty();
    if (!modes_)
        for (const int node : surface_.node)
            box.include(state_.position[static_cast<std::size_t>(node)]);
    // The pairs recorded now serve the whole step that follows; contact begins where the smooth
    // surface does.
    box.grow(max_speed() * world_.last_step() + contact_nodes_.shape.highest);
    return box;
}

void Body::on_pair(dGeomID other) noexcept {
    if (!world_.meeting_) { // the application collides its spaces; meet() will look again
        const dGeomID top = topmost(other);
        if (top != topmost(geom_))
            world_.other_spaces_.add(geom_, top);
        return;
    }
    if (std::find(pair_.begin(), pair_.end(), other) == pair_.end())
        pair_.push_back(other);
}

int Body::on_ray(dGeomID ray, int flags, dContactGeom* contact, int skip) noexcept {
    return collide_ray(geom_, ray, surface_.triangle, state().position, flags, contact, skip);
}

void Body::on_destroyed() noexcept {
    forget_space(geom_);
    geom_ = nullptr; // the application's id of the body stays good; it only meets nothing any more
}

void Body::moved() noexcept {
    if (geom_)
        mark_moved(geom_);
}

std::size_t Body::substep_work() const noexcept {
    // Measured: 50 ns; 3 us for 94 modes.
    constexpr std::size_t kQuadratic = 5, kModal = 3;
    constexpr std::size_t kEntries = 128; // of the cubic terms: 0.08 ns each
    if (modes_)
        return kModal * modes_->motion().band() +
               (bends() ? modes_->motion().cubic()->entries() / kEntries : 0);
    return mesh_.element_count() * (mesh_.order == 2 ? kQuadratic : 1);
}

double Body::cost() const noexcept {
    constexpr double kUnit = 1e-8; // [s]
    if (!moves())
        return 0;
    const double dt = modes_ ? std::min(modes_->pace(), world_.last_step()) : safe_substep();
    return kUnit * static_cast<double>(substep_work()) / dt;
}

double Body::max_speed() const noexcept {
    if (modes_)
        return modes_->motion().largest_speed();
    double fastest = 0;
    for (const int node : surface_.node)
        fastest = std::max(fastest, state_.velocity[static_cast<std::size_t>(node)].squaredNorm());
    return std::sqrt(fastest);
}

} // namespace ode::soft
