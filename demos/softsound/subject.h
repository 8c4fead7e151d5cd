#pragma once

#include "scenes/world.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

/// The body that a demo is about: made of a mesh and a preset, held somewhere, and judged by its
/// lowest mode.
namespace softsound {

/// Of the presets' table. @throws scenes::Refused
dSoftSolid preset(const std::string& material);

/// Nodes of a body that a condition holds for, by their places now.
std::vector<int> nodes_where(dSoftBodyID body, const std::function<bool(const dReal*)>& condition);

/// How far its elements are off in pitch: the lowest mode of the body, as it moves, beside the
/// corrected cubic answer on the same shape (dSoftModesCompute), whose band it tells too. Keys
/// first_mode_hz, first_mode_exact_hz, first_mode_cents, first_mode_band_cents.
/// @param held  nodes of the mesh that are pinned
/// @throws scenes::Refused
nlohmann::ordered_json first_mode(dSoftBodyID body, dSoftMeshID mesh, const dSoftSolid& solid,
                                  std::span<const int> held);

} // namespace softsound
