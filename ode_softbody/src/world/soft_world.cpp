#include "world/soft_world.h"

#include "base/error.h"
#include "base/stopwatch.h"
#include "world/rigid_sweep.h"

#include <ode/objects.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace ode::soft {
namespace {

// Substeps between looks at the bodies' energy, each of which costs about a tenth of a force. A
// body whose elastic energy alone exceeds what is due is looked at at once: see
// Body::begin_substep().
constexpr int kWatchInterval = 10;

// A step with more substeps takes minutes at best: it was meant otherwise.
constexpr double kMostSubsteps = 1e7;

// Work of a substep that is done side by side, in Body::substep_work(): 20 us.
constexpr std::size_t kWorthwhile = 2000;

bool none_moves(std::span<const std::unique_ptr<Body>> bodies) noexcept {
    return std::none_of(bodies.begin(), bodies.end(), [](const auto& b) { return b->moves(); });
}

/// Rigid bodies in a quadtree can't be listed: sleepers look for them there.
bool is_quadtree(dSpaceID space) noexcept {
    return dGeomGetClass(reinterpret_cast<dGeomID>(space)) == dQuadTreeSpaceClass;
}

} // namespace

SoftWorld::SoftWorld(dWorldID world, dSpaceID space) : world_(world), space_(space) {}

SoftWorld::~SoftWorld() {
    each_observer([&](Observer& observer) { observer.on_world_end(*this); });
    observer_.clear();
}

Body& SoftWorld::create_body(const TetMesh& mesh, std::span<const Solid> solids) {
    if (!space_)
        throw InputError("the space of the soft world is gone; make a soft world in another one");
    Body& body = *body_.emplace_back(std::make_unique<Body>(*this, mesh, solids));
    body.number_ = made_++;
    moving_.reserve(body_.size());
    body.set_auto_disable(dWorldGetAutoDisableFlag(world_) != 0);
    return body;
}

void SoftWorld::destroy_body(Body& body) noexcept {
    each_observer([&](Observer& observer) { observer.on_body_end(body); });
    exchange_.forget(body);
    attachments_.forget(body);
    soft_exchange_.forget(body);
    std::erase_if(body_, [&](const auto& b) { return b.get() == &body; });
}

int SoftWorld::step(double h, RealStep real_step) noexcept {
    if (stepping_)
        return real_step(world_, h);
    if (!begin_step(h))
        return 0;
    const int result = real_step(world_, h);
    end_step();
    return result;
}

bool SoftWorld::accepts(double h) const noexcept {
    if (!(h > 0 && std::isfinite(h))) {
        report(format("the step of %g s is refused; give a finite one above 0", h));
        return false;
    }
    const double substeps = h / common_substep(h);
    if (substeps > kMostSubsteps) {
        report(format("the step of %g s is refused, it would take %.3g substeps of %.3g s; make "
                      "shorter steps",
                      h, substeps, h / substeps));
        return false;
    }
    return true;
}

bool SoftWorld::begin_step(double h) noexcept {
    if (stepping_ || !accepts(h))
        return false;
    stepping_ = true;
    if (body_.empty() && observer_.empty()) { // not even the time is asked
        last_step_ = h;
        time_ += h;
        ++stats_.steps;
        return true;
    }
    // Where nothing moves and nobody watches the clock would be most of the cost.
    std::optional<Stopwatch> watch;
    if (!none_moves(body_) || !observer_.empty())
        watch.emplace();
    meet(h);
    for (bool again = false; !advance(h, again);)
        again = true;
    time_ += h;
    ++stats_.steps;
    if (watch)
        stats_.seconds += watch->seconds();
    if (!observer_.empty())
        watch_step();
    // Else there are no shadows of this step, or those of an attempt that failed.
    if (!none_moves(body_)) {
        slumber_.decide(body_, exchange_);
        exchange_.hand_over();
    }
    return true;
}

void SoftWorld::end_step() noexcept {
    if (!none_moves(body_))
        exchange_.write_back();
    for (const auto& body : body_)
        if (body->moves())
            body->moved();
    slumber_.carry_out();
    other_spaces_.clear();
    if (!observer_.empty())
        watch_move();
    stepping_ = false;
    drop_past_observers();
}

void SoftWorld::meet(double h) noexcept {
    attachments_.check();
    meeting_ = true;
    for (const auto& body : body_) {
        body->pair_.clear();
        // Its box covers the way of a step.
        if (body->geom() && body->moves() && h != last_step_)
            body->moved();
    }
    last_step_ = h;
    const bool sleepers_look = space_ && is_quadtree(space_);
    if (many_in_one_space())
        collide_all(space_);
    else
        for (const auto& body : body_)
            if (body->geom() && (body->moves() || (sleepers_look && body->asleep())) &&
                dGeomIsEnabled(body->geom()))
                collide_now(body->geom());
    other_spaces_.collide();
    if (space_ &&
        std::any_of(body_.begin(), body_.end(), [](const auto& body) { return !body->stopped(); }))
        sweep_rigid(space_, h, body_, exchange_);
    slumber_.rouse(body_);
    meeting_ = false;
    for (const auto& body : body_)
        if (body->moves())
            choose_pairs(*body, body->pair_, contact_chooser_, said_, body->rigid_pair_);
}

bool SoftWorld::many_in_one_space() const noexcept {
    constexpr std::size_t kMany = 16; // from here on ODE's own pairing is quicker
    const auto own = reinterpret_cast<dGeomID>(space_);
    return space_ && body_.size() >= kMany &&
           std::all_of(body_.begin(), body_.end(),
                       [&](const auto& body) {
                           return body->geom() && body->moves() && topmost(body->geom()) == own &&
                                  dGeomGetSpace(body->geom()) == space_;
                       }) &&
           is_flat(space_);
}

double SoftWorld::common_substep(double h) const noexcept {
    double least = h;
    for (const auto& body : body_)
        if (body->moves())
            least = std::min(least, body->safe_substep());
    constexpr double kRounding = 1e-12; // of a step that is a multiple
    return h / std::ceil(h / least * (1 - kRounding));
}

bool SoftWorld::all_ring() const noexcept {
    return std::all_of(body_.begin(), body_.end(),
                       [](const auto& b) { return b->rings() || !b->moves(); });
}

double SoftWorld::next_substep(double h, double done) const noexcept {
    if (!any_rings_ || !all_ring())
        return common_substep(h - done);
    const double least = common_substep(h);
    constexpr double kSlack = 1e-9; // of a substep: `done` is a sum of such
    for (double dt = h;; dt /= 2)
        if (dt <= least * (1 + kSlack)) {
            const double before = done / dt;
            if (std::fabs(before - std::round(before)) < kSlack * std::fmax(1.0, before))
                return dt;
        }
}

void SoftWorld::look_ahead(bool first) noexcept {
    if (!any_rings_)
        return;
    for (const auto& body : body_)
        if (body->rings())
            body->pace(nodes_watched_);
    exchange_.look_ahead(first);
    soft_exchange_.look_ahead();
}

bool SoftWorld::advance(double h, bool again) noexcept {
    if (none_moves(body_))
        return true;
    const TasksScope tasks(tasks_.get());
    dVector3 g;
    dWorldGetGravity(world_, g);
    for (const auto& body : body_)
        if (body->moves())
            body->begin_step({g[0], g[1], g[2]});
    any_rings_ = std::any_of(body_.begin(), body_.end(), [](const auto& b) { return b->rings(); });
    nodes_watched_ =
        any_rings_ && std::any_of(observer_.begin(), observer_.end(), [](const auto& o) {
            return o && o->wants_substeps() && !o->takes_modes();
        });
    exchange_.watch_pushes(std::any_of(observer_.begin(), observer_.end(),
                                       [](const auto& o) { return o && o->wants_pushes(); }));
    const double first = common_substep(h);
    attachments_.announce(exchange_);
    exchange_.begin_step(world_, body_, h, first);
    attachments_.begin_step(exchange_, h, first);
    soft_exchange_.begin_step(body_, again);
    double done = 0;
    look_ahead(true);
    while (done < h) {
        const double dt = next_substep(h, done);
        const long substeps = std::lround((h - done) / dt);
        for (const auto& body : body_)
            if (body->moves())
                body->fit_velocity(dt);
        const long taken = run_substeps(time_ + done, dt, substeps);
        if (taken == 0)
            return false;
        done = taken == substeps ? h : done + static_cast<double>(taken) * dt;
    }
    for (const auto& body : body_)
        if (body->moves())
            body->end_step();
    return true;
}

void SoftWorld::list_moving() noexcept {
    moving_.clear();
    std::size_t all = 0, most = 0;
    for (const auto& body : body_)
        if (body->moves()) {
            moving_.push_back(body.get());
            all += body->substep_work();
            most = std::max(most, body->substep_work());
        }
    // A body that is most of the work is cut in pieces itself.
    side_by_side_ = tasks_ && all >= kWorthwhile && most <= all / 2;
}

long SoftWorld::run_substeps(double start, double dt, long substeps) noexcept {
    list_moving();
    const bool observed = std::any_of(observer_.begin(), observer_.end(), [](const auto& o) {
        return o && (o->wants_substeps() || o->wants_pushes());
    });
    long looked = 0;
    for (long i = 1; i <= substeps; ++i) {
        const bool look = i % kWatchInterval == 0 || i == 1 || i == substeps;
        each_moving([&](Body& body) { body.begin_substep(look); });
        const ContactTally tally = exchange_.add_forces(dt);
        stats_.contact_tests += tally.tests;
        stats_.contact_points += tally.bearing;
        attachments_.bind(exchange_, dt);
        const SoftContactTally soft = soft_exchange_.add_forces(dt);
        stats_.soft_pairs += soft_exchange_.pairs();
        stats_.soft_looks += soft.looks;
        stats_.soft_tests += soft.tests;
        stats_.contact_points += soft.bearing;
        exchange_.advance(dt);
        each_moving([&](Body& body) {
            if (look && body.auto_disable())
                body.watch_rest(static_cast<double>(i - looked) * dt);
            body.advance(dt);
        });
        for (const Body* body : moving_) {
            stats_.element_steps += body->rings() ? 0 : body->mesh().element_count();
            stats_.modal_substeps += body->rings();
        }
        stats_.body_substeps += moving_.size();
        attachments_.follow(exchange_);
        ++stats_.substeps;
        if (look)
            looked = i;
        if (!all_sound())
            return 0;
        if (observed)
            show_substep(start + static_cast<double>(i) * dt, dt);
        if (any_rings_ && i < substeps) {
            look_ahead(false);
            const double wanted = common_substep(static_cast<double>(substeps) * dt);
            if (wanted < 0.99 * dt || (wanted > 3.99 * dt && all_ring()))
                return i;
        }
        if (look && std::any_of(body_.begin(), body_.end(),
                                [](const auto& b) { return b->moves() && b->adapt_margin(); }))
            return i;
    }
    return substeps;
}

bool SoftWorld::all_sound() noexcept {
    const auto is_unsound = [](const auto& body) {
        return body->moves() && body->was_looked_at() && !body->is_sound();
    };
    if (std::none_of(body_.begin(), body_.end(), is_unsound))
        return true;
    for (std::size_t i = 0; i < body_.size(); ++i) {
        Body& body = *body_[i];
        if (!is_unsound(body_[i]))
            continue;
        const std::string trouble = body.trouble();
        if (body.take_care()) {
            // A body that needs care again and again is told of ever more rarely.
            if ((body.rollbacks() & (body.rollbacks() - 1)) == 0)
                report(format("soft body %zu goes unstable in the step from t = %g s: %s; the step "
                              "is redone at %g s",
                              i, time_, trouble.c_str(), body.safe_substep()));
            continue;
        }
        report(format("soft body %zu went unstable in the step from t = %g s: %s; it is stopped. "
                      "Give it a smaller substep, a stiffer material or a gentler blow",
                      i, time_, trouble.c_str()));
    }
    for (const auto& body : body_)
        if (body->moves())
            body->roll_back();
    for (const auto& body : body_)
        if (body->is_given_up() && !body->stopped())
            body->stop();
    not_shown_until_ = std::max(not_shown_until_, shown_);
    return false;
}

} // namespace ode::soft
