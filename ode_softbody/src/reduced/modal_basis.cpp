#include "reduced/modal_basis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ode::soft {
namespace {

// Weaker couplings turn a mode by less than a degree in the time that it takes to die away, at any
// spin that a body of metal survives.
constexpr double kLeastCoupling = 1e-3;

std::size_t whole_lanes(std::size_t modes) noexcept {
    return (modes + ModalBasis::kLanes - 1) / ModalBasis::kLanes * ModalBasis::kLanes;
}

void lay_out(const ModalModel& modes, ModalBasis& out) {
    out.shape.assign(3 * out.nodes() * out.columns, 0.0f);
    out.reach.assign(out.columns, 0.0);
    for (std::size_t k = 0; k < out.modes; ++k)
        for (std::size_t n = 0; n < out.nodes(); ++n) {
            const Vec3 phi = modes.shape_at(k, n);
            for (std::size_t axis = 0; axis < 3; ++axis)
                out.shape[(3 * n + axis) * out.columns + k] =
                    static_cast<float>(phi[static_cast<int>(axis)]);
            out.reach[k] = std::max(out.reach[k], phi.norm());
        }
}

void find_inertia(const ModalModel& modes, ModalBasis& out) {
    out.inertia_slope.assign(6 * out.columns, 0.0);
    out.inertia_share.assign(3 * out.columns, 0.0);
    for (std::size_t n = 0; n < out.nodes(); ++n) {
        const Vec3& x = out.rest[n];
        const double m = out.mass[n];
        out.inertia += m * (x.squaredNorm() * Mat3::Identity() - x * x.transpose());
        for (std::size_t k = 0; k < out.modes; ++k) {
            const Vec3 phi = modes.shape_at(k, n);
            const Mat3 slope =
                m * (2 * x.dot(phi) * Mat3::Identity() - x * phi.transpose() - phi * x.transpose());
            const std::array<double, 6> term{slope(0, 0), slope(1, 1), slope(2, 2),
                                             slope(0, 1), slope(0, 2), slope(1, 2)};
            for (std::size_t c = 0; c < 6; ++c)
                out.inertia_slope[c * out.columns + k] += term[c];
            for (std::size_t c = 0; c < 3; ++c)
                out.inertia_share[c * out.columns + k] += m * phi[static_cast<int>(c)];
        }
    }
}

/// Each mode with those that a spin could mix it with: neighbours in frequency.
void find_gyration(const ModalModel& modes, ModalBasis& out) {
    for (std::size_t i = 0; i < out.audible; ++i)
        for (std::size_t j = i + 1; j < out.audible; ++j) {
            if (out.omega[j] > 1.05 * out.omega[i])
                break;
            Vec3 coupling = Vec3::Zero();
            for (std::size_t n = 0; n < out.nodes(); ++n)
                coupling += out.mass[n] * modes.shape_at(i, n).cross(modes.shape_at(j, n));
            if (coupling.norm() > kLeastCoupling)
                out.gyration.push_back({static_cast<int>(i), static_cast<int>(j), coupling,
                                        (out.omega[j] - out.omega[i]) / coupling.norm()});
        }
    std::stable_sort(out.gyration.begin(), out.gyration.end(),
                     [](const auto& a, const auto& b) { return a.spin < b.spin; });
}

} // namespace

ModalBasis make_basis(const ModalModel& modes, std::span<const Vec3> position,
                      std::span<const double> mass, std::span<const double> decay,
                      double audible_limit, double gentle_limit, bool held) {
    ModalBasis out;
    out.modes = modes.mode_count();
    out.columns = whole_lanes(out.modes);
    const auto up_to = [&](double limit) {
        return static_cast<std::size_t>(
            std::upper_bound(modes.frequency.begin(), modes.frequency.end(), limit) -
            modes.frequency.begin());
    };
    out.audible = up_to(audible_limit);
    out.audible_columns = whole_lanes(out.audible);
    out.gentle_columns = whole_lanes(up_to(gentle_limit));
    out.rest.assign(position.begin(), position.end());
    out.mass.assign(mass.begin(), mass.end());
    out.held = held;
    Vec3 centre = Vec3::Zero();
    for (std::size_t n = 0; n < out.nodes(); ++n) {
        centre += mass[n] * out.rest[n];
        out.total_mass += mass[n];
    }
    for (Vec3& x : out.rest) {
        x -= centre / out.total_mass;
        out.radius = std::max(out.radius, x.norm());
    }
    out.omega.assign(out.columns, 1.0); // of padding: any, it never moves
    out.decay.assign(out.columns, 0.0);
    for (std::size_t k = 0; k < out.modes; ++k) {
        out.omega[k] = 2 * std::numbers::pi * modes.frequency[k];
        out.decay[k] = decay[k];
    }
    lay_out(modes, out);
    find_inertia(modes, out);
    find_gyration(modes, out);
    return out;
}

} // namespace ode::soft
