#pragma once

#include "mix/settings.h"
#include "source/struck_voice.h"
#include "transfer/table_cache.h"

#include <memory>

namespace ode::sound {

/// Whether there is a table of how modes sound by the rule that is set. Soft bodies in modes are
/// else heard by their nodes, rigid ones by "monopole".
bool hears_modes(const Settings& settings) noexcept;

/// How a body sounds by its modes, whoever moves them.
/// @param omega, decay  [rad/s] ascending, [1/s].
/// @param mesh   in the body's frame, which it turns about the origin of.
/// @param shape  x y z of every node, mode after mode [kg^-1/2].
/// @param cache  of tables; the default keeps none.
std::shared_ptr<const StruckVoiceModel>
make_voice_model(std::span<const double> omega, std::span<const double> decay,
                 const BoundaryMesh& mesh, std::span<const double> shape, const Settings& settings,
                 const TableCache& cache = {});

/// ModalVoiceModel::level by a table.
std::vector<double> mode_levels(const TransferTable& table, std::span<const double> omega);

/// A body's surface in numbers of its own.
struct SurfaceNumbers {
    std::vector<int> node; ///< of the body
    std::vector<std::array<int, 3>> triangle;

    /// @param triangle  three nodes of the body each.
    explicit SurfaceNumbers(std::span<const int> triangle, std::size_t nodes);
};

} // namespace ode::sound
