// How a body is damped by its modes.
#include "base/error.h"
#include "integrate/critical_step.h"
#include "modal/cache.h"
#include "modal/modal_decay.h"
#include "world/body.h"
#include "world/soft_world.h"

#include <algorithm>

namespace ode::soft {
namespace {

constexpr double kAudible = 22000;      ///< [Hz] modes above decay like those up here
constexpr std::size_t kMostModes = 500; ///< of a large soft body: some 12 kB a node

/// Motions that supports at so many nodes leave to one piece that is not in a line.
int rigid_motions(std::size_t held) { return held == 0 ? 6 : held == 1 ? 3 : held == 2 ? 1 : 0; }

/// Of a mode in the most lossy of the solids [1/s].
double greatest_decay(std::span<const Solid> solids, double f) {
    double most = 0;
    for (const Solid& s : solids)
        most = std::max(most, RayleighDamping{s.alpha, viscous_time(s)}.decay(f) +
                                  decay_of_loss_factor(s.loss_factor, f));
    return most;
}

} // namespace

bool Body::has_loss_factor() const noexcept {
    return std::any_of(solids_.begin(), solids_.end(),
                       [](const Solid& s) { return s.loss_factor > 0; });
}

void Body::find_damped_modes() noexcept {
    modes_stale_ = false;
    modal_damping_.reset();
    try {
        ModalOptions options;
        options.order = mesh_.order;
        options.mass = MassKind::kLumped; // as the body moves
        options.estimate = false;
        options.max_frequency = kAudible;
        options.max_modes = kMostModes;
        options.clamped = pinned_;
        options.clamped.insert(options.clamped.end(), nailed_.begin(), nailed_.end());
        std::sort(options.clamped.begin(), options.clamped.end());
        const std::size_t held = options.clamped.size();
        const ModalModel modes = cached_modes(mesh_, solids_, options);
        if (modes.rigid_modes != rigid_motions(held))
            throw InputError(format("it has %d motions without strain, not %d as one piece held at "
                                    "%zu nodes: make a body of each piece, or pin more nodes",
                                    modes.rigid_modes, rigid_motions(held), held));
        const double top =
            modes.complete || modes.frequency.empty() ? kAudible : modes.frequency.back();
        const DampingTable& table = form_.damping_table;
        std::vector<double> decay;
        if (table.empty())
            decay = modal_decays(mesh_, solids_, modes);
        else
            for (const double f : modes.frequency)
                decay.push_back(table.decay(f));
        const double rest = table.empty() ? greatest_decay(solids_, top) : table.decay(top);
        modal_damping_ = std::make_unique<ModalDamping>(
            mass(), inverse_mass_, options.clamped, mesh_.node,
            DampedModes{modes, decay, rest, 1 / (2 * top)},
            pinned_.empty() ? std::span<const int>(nailed_) : std::span<const int>());
    } catch (const std::exception& e) {
        report(format("a soft body of %zu nodes rings undamped, because its modes can't be had: %s",
                      mesh_.node.size(), e.what()));
    }
}

} // namespace ode::soft
