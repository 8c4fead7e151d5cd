#pragma once

#include "reduced/condense.h"

#include <filesystem>

namespace ode::soft {

/// condense(), looked up on disk first and kept there afterwards, as cached_modes() does.
/// @param directory  see cache_directory(); empty: no caching
CubicTerms::Coefficients cached_terms(const TetMesh& mesh, std::span<const Solid> solids,
                                      const ModalOptions& options, std::span<const double> mass,
                                      const CubicExtent& extent,
                                      const std::filesystem::path& directory);

} // namespace ode::soft
