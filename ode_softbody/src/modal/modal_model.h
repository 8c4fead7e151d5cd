#pragma once

#include "base/types.h"
#include "modal/assemble.h"

#include <span>
#include <vector>

namespace ode::soft {

/// The vibrating body as plain data: what sound, reduced dynamics and the disk cache need of it.
struct ModalModel {
    MassProperties body;           ///< in the mesh's frame
    std::size_t node_count = 0;    ///< of the mesh that was solved
    int rigid_modes = 0;           ///< motions without strain: 6 a free part, fewer when clamped
    bool complete = true;          ///< no mode below the frequency asked for is missing
    std::vector<double> frequency; ///< elastic modes [Hz], ascending
    /// Half-width of the band that holds the exact frequency of this geometry [cents], one a mode;
    /// empty when not asked for.
    std::vector<double> error_cents;
    /// Displacement of the mesh's own nodes, mass-normalised [kg^-1/2]: xyz of node 0, node 1, ...
    /// of mode 0, then mode 1, ...
    std::vector<double> shape;

    std::size_t mode_count() const noexcept { return frequency.size(); }
    std::span<const double> shape_of(std::size_t mode) const noexcept {
        return std::span<const double>(shape).subspan(mode * 3 * node_count, 3 * node_count);
    }
    Vec3 shape_at(std::size_t mode, std::size_t node) const noexcept {
        const double* s = shape.data() + 3 * (mode * node_count + node);
        return {s[0], s[1], s[2]};
    }
};

/// Brings modes into ascending order of frequency.
void sort_by_frequency(ModalModel& model);

} // namespace ode::soft
