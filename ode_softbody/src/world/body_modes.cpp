// The modes that a body can move in, and what isn't linear of them.
#include "base/error.h"
#include "mesh/jacobian.h"
#include "modal/cache.h"
#include "modal/modal_decay.h"
#include "reduced/residual_flexibility.h"
#include "reduced/terms_cache.h"
#include "world/body.h"
#include "world/modal_limits.h"
#include "world/soft_world.h"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace ode::soft {
namespace {

// Kept non-linear: a blow on the floor moves many (20 leave 3.3 % of it wrong, 36 2.3 %). What
// rings has fewer active.
constexpr std::size_t kKept = 36;
constexpr std::size_t kMostLoads = std::size_t{1} << 26; ///< numbers, half a gigabyte

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

ModalOptions Body::modal_options() const {
    ModalOptions options;
    options.order = mesh_.order;
    options.mass = MassKind::kLumped; // as the nodes move: a change of tier changes no pitch
    options.estimate = false;
    options.max_frequency = kContactBand;
    options.max_modes = kMostModes;
    options.clamped = pinned_;
    return options;
}

std::shared_ptr<const ModalBasis> Body::find_basis() noexcept {
    try {
        const ModalOptions options = modal_options();
        // A table of decays is the body's own: nothing to share.
        const std::string key =
            form_.damping_table.empty() ? content_hash(mesh_, solids_, options) : std::string();
        return world_.bases().get(key, [&] {
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
        if (tier_choice_ != TierChoice::automatic)
            report(format("a soft body of %zu nodes stays in the explicit tier: %s",
                          mesh_.node.size(), e.what()));
        return nullptr;
    }
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

namespace {

CubicTerms::Sounding sounding_modes(const ModalBasis& basis, const CubicTerms& terms) {
    CubicTerms::Sounding out;
    const std::size_t heard = basis.audible + terms.following();
    const auto omega = [&](int c) {
        const auto k = static_cast<std::size_t>(c);
        return k < basis.audible ? basis.omega[k]
                                 : std::min(terms.follow_frequency()[k - basis.audible],
                                            2 * std::numbers::pi * kAudible);
    };
    out.order.resize(heard);
    std::iota(out.order.begin(), out.order.end(), 0);
    std::stable_sort(out.order.begin(), out.order.end(),
                     [&](int a, int b) { return omega(a) < omega(b); });
    out.shape.resize(3 * basis.nodes() * heard);
    for (std::size_t c = 0; c < heard; ++c) {
        const auto k = static_cast<std::size_t>(out.order[c]);
        out.omega.push_back(omega(out.order[c]));
        out.decay.push_back(k < basis.audible ? basis.decay[k] : 0);
        for (std::size_t r = 0; r < 3 * basis.nodes(); ++r)
            out.shape[r * heard + c] = k < basis.audible
                                           ? basis.shape[r * basis.columns + k]
                                           : terms.shape()[r * terms.columns() + k - basis.audible];
    }
    return out;
}

} // namespace

std::shared_ptr<const CubicTerms> Body::find_cubic() noexcept {
    try {
        if (form_.model != "stvk")
            throw InputError(format("its material is %s; the cubic tier knows what a St. "
                                    "Venant-Kirchhoff solid (\"stvk\") does, and no other",
                                    form_.model.c_str()));
        const ModalBasis& basis = (modes_ ? modes_ : idle_modes_)->motion().basis();
        CubicExtent extent;
        extent.kept = std::min(kKept, basis.audible);
        extent.driven = basis.audible - extent.kept;
        const std::size_t pairs = extent.kept * (extent.kept + 1) / 2;
        if (3 * mesh_.node.size() * pairs > kMostLoads)
            throw InputError(format("its %zu nodes are too many for it", mesh_.node.size()));
        const ModalOptions options = modal_options();
        return world_.cubics().get(content_hash(mesh_, solids_, options), [&] {
            const double unit = thickness_ / basis.reach[0];
            CubicTerms terms(
                cached_terms(mesh_, solids_, options, mass(), extent, cache_directory()), unit);
            terms.set_sounding(sounding_modes(basis, terms));
            return terms;
        });
    } catch (const std::exception& e) {
        if (tier_choice_ == TierChoice::cubic)
            report(format("a soft body of %zu nodes does without the cubic tier: %s",
                          mesh_.node.size(), e.what()));
        return nullptr;
    }
}

bool Body::may_bend() noexcept {
    if (!may_ring())
        return false;
    ModalMotion& motion = (modes_ ? modes_ : idle_modes_)->motion();
    if (!cubic_known_) {
        cubic_known_ = true;
        if (auto terms = find_cubic())
            motion.set_cubic(std::move(terms));
    }
    return motion.has_cubic();
}

} // namespace ode::soft
