#include "base/error.h"
#include "integrate/critical_step.h"
#include "integrate/largest_frequency.h"
#include "mesh/promote.h"
#include "mesh/quality.h"
#include "model/check_solid.h"
#include "model/make_model.h"
#include "world/body.h"
#include "world/soft_world.h"

#include <algorithm>
#include <numeric>

namespace ode::soft {
namespace {

/// A field of the corners on all nodes of a promoted mesh. A mid-edge node moves with the affine
/// motion of its element's corners, which on a straight edge is their mean.
NodeArray extended(const TetMesh& mesh, std::size_t corners, const NodeArray& field) {
    NodeArray out(mesh.node.size());
    for (std::size_t i = 0; i < corners; ++i)
        out[i] = field[i];
    if (mesh.node.size() == corners)
        return out;
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        const auto rest = [&](std::size_t a) -> const Vec3& {
            return mesh.node[static_cast<std::size_t>(n[a])];
        };
        const auto value = [&](std::size_t a) { return out[static_cast<std::size_t>(n[a])]; };
        Mat3 edges, change;
        for (int a = 0; a < 3; ++a) {
            const auto corner = static_cast<std::size_t>(a) + 1;
            edges.col(a) = rest(corner) - rest(0);
            change.col(a) = value(corner) - value(0);
        }
        const Mat3 gradient = change * edges.inverse();
        for (std::size_t i = 0; i < 6; ++i) {
            const auto a = static_cast<std::size_t>(kTetEdge[i][0]);
            const auto b = static_cast<std::size_t>(kTetEdge[i][1]);
            const Vec3 offset = rest(4 + i) - 0.5 * (rest(a) + rest(b));
            value(4 + i) = 0.5 * (value(a) + value(b)) + gradient * offset;
        }
    }
    return out;
}

/// Mass-proportional damping of each node [1/s]: the mean over its mass. One for all where it is
/// the same in all solids.
std::vector<double> nodal_alpha(const TetMesh& mesh, std::span<const Solid> solids,
                                std::span<const double> mass, double max_alpha) {
    if (std::all_of(solids.begin(), solids.end(),
                    [&](const Solid& s) { return s.alpha == max_alpha; }))
        return {max_alpha};
    // Nodal mass is linear in density; from 1 up, because no solid weighs nothing.
    std::vector<Solid> weighted(solids.begin(), solids.end());
    for (Solid& s : weighted)
        s.density *= 1 + s.alpha / max_alpha;
    const auto model = make_model(model_names()[0], mesh, weighted);
    std::vector<double> alpha(mass.size());
    for (std::size_t i = 0; i < alpha.size(); ++i)
        alpha[i] = max_alpha * std::clamp(model->mass()[i] / mass[i] - 1, 0.0, 1.0);
    return alpha;
}

} // namespace

Body::Body(SoftWorld& world, const TetMesh& mesh, std::span<const Solid> solids)
    : world_(world), given_nodes_(mesh.node.size()), given_order_(mesh.order),
      solids_(solids.begin(), solids.end()) {
    check_mesh(mesh, "mesh");
    for (const Solid& solid : solids_)
        check_solid(solid);
    TetMesh own = mesh;
    if (solids_.size() == 1)
        own.group.clear();
    form_.order = given_order_;
    NodeState rest{NodeArray(given_nodes_), NodeArray(given_nodes_)};
    for (std::size_t i = 0; i < given_nodes_; ++i)
        rest.position[i] = mesh.node[i];
    state_ = std::move(rest);
    external_ = NodeArray(given_nodes_);
    build(std::move(own), form_, has_loss_factor());
    geom_ = create_soft_geom(world.space(), *this);
}

CurveReport Body::set_form(const BodyForm& form) {
    if (stepped_)
        throw InputError("the body has been stepped already; choose its order, material model, "
                         "curvature and integrator before its first step");
    if (world_.attachments().has(*this))
        throw InputError("the body is attached to a rigid one; choose its order, material model, "
                         "curvature and integrator before that");
    if (form.order != 1 && form.order != 2)
        throw InputError(format("there are no elements of order %d; give 1 or 2", form.order));
    if (form.order < given_order_)
        throw InputError("the body's mesh has quadratic elements, which cannot be lowered; load a "
                         "linear mesh for order 1");
    if (form.curved && form.order == 1)
        throw InputError("linear elements cannot be curved; the body needs order 2");
    if (form.curved && given_order_ == 2)
        throw InputError("the body's mesh has mid-edge nodes of its own, which tell its curvature; "
                         "only a linear mesh can be curved");
    const bool by_modes = form.modal_damping || has_loss_factor() || !form.damping_table.empty();
    TetMesh mesh =
        given_order_ == 2 || mesh_.order == 1 ? mesh_ : demote_to_linear(mesh_, given_nodes_);
    if (form.order == 2)
        mesh = promote_to_quadratic(mesh);
    const CurveReport report = form.curved ? curve_surface(mesh) : CurveReport{};
    build(std::move(mesh), form, by_modes);
    form_ = form;
    form_.integrator = integrator_kind(form.integrator).name;
    moved();
    return report;
}

void Body::build(TetMesh mesh, const BodyForm& form, bool damped_by_modes) {
    const IntegratorKind& method = integrator_kind(form.integrator);
    forget_modes();
    Surface surface = extract_surface(mesh);
    const std::vector<Solid> solids = stress_solids(damped_by_modes);
    auto model = make_model(form.model, mesh, solids);
    const auto least = std::min_element(model->mass().begin(), model->mass().end());
    if (!(*least > 0))
        throw InputError(
            format("node %td would have the mass %g kg; its elements are too distorted "
                   "for this order",
                   least - model->mass().begin(), *least));
    NodeState state{extended(mesh, given_nodes_, state_.position),
                    extended(mesh, given_nodes_, state_.velocity)};
    NodeArray external(mesh.node.size());
    for (std::size_t i = 0; i < given_nodes_; ++i)
        external[i] = external_[i];
    SurfaceNodes contact_nodes(mesh, surface, model->mass());
    max_alpha_ = 0;
    for (const Solid& solid : solids)
        max_alpha_ = std::max(max_alpha_, solid.alpha);
    alpha_ = nodal_alpha(mesh, solids, model->mass(), max_alpha_);

    mesh_ = std::move(mesh);
    surface_ = std::move(surface);
    model_ = std::move(model);
    contact_nodes_ = std::move(contact_nodes);
    state_ = std::move(state);
    checkpoint_.state = state_;
    external_ = std::move(external);
    force_ = NodeArray(mesh_.node.size());
    load_ = NodeArray(mesh_.node.size());
    integrator_ = method.make(mesh_.node.size());
    is_explicit_ = !method.implicit;
    lags_ = method.lags;
    total_mass_ = std::accumulate(mass().begin(), mass().end(), 0.0);
    std::vector<int> pinned = std::move(pinned_);
    std::erase_if(pinned, [&](int node) { return static_cast<std::size_t>(node) >= given_nodes_; });
    inverse_mass_.resize(mass().size());
    std::transform(mass().begin(), mass().end(), inverse_mass_.begin(),
                   [](double m) { return 1 / m; });
    pinned_.clear();
    // Unpinned: a bound for whatever is held later.
    const double frequency =
        largest_frequency(model_->stiffness(state_.position), inverse_mass_).upper;
    critical_step_ = critical_step_at(method, solids, frequency);
    // Where modes grow at any step, slowly at a short one: for comparison.
    longest_substep_ = critical_step_ > 0 ? critical_step_ : 0.1 * 2 / frequency;
    reset_watch(form.model, frequency);
    pin(pinned);
    use_default_substep();
    damped_by_modes_ = damped_by_modes;
    modal_damping_.reset();
    modes_stale_ = true;
}

std::vector<Solid> Body::stress_solids(bool damped_by_modes) const {
    std::vector<Solid> solids = solids_;
    if (damped_by_modes)
        for (Solid& s : solids)
            s.phi = s.psi = s.alpha = s.beta = 0;
    return solids;
}

double Body::critical_step_at(const IntegratorKind& method, std::span<const Solid> solids,
                              double frequency) const {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const Solid& solid : solids) {
        least = std::min(least, least_viscous_time(solid));
        most = std::max(most, viscous_time(solid));
    }
    return ode::soft::critical_step(method, frequency, least, most);
}

double Body::present_critical_step() const {
    const IntegratorKind& method = integrator_kind(form_.integrator);
    if (method.implicit)
        return std::numeric_limits<double>::infinity();
    const std::vector<Solid> solids = stress_solids(damped_by_modes_);
    return critical_step_at(
        method, solids, largest_frequency(model_->stiffness(state_.position), inverse_mass_).upper);
}

} // namespace ode::soft
