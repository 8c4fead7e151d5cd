#pragma once

#include "modal/solve_modes.h"

#include <filesystem>
#include <string>

namespace ode::soft {

/// Where models are kept: $ODE_SOFTBODY_CACHE, else $XDG_CACHE_HOME/ode_softbody, else
/// ~/.cache/ode_softbody. Empty (no caching) when ODE_SOFTBODY_CACHE is set to nothing, or when
/// there is no home.
std::filesystem::path cache_directory();

/// 32 hexadecimal digits over everything that decides a model: mesh, materials, options and the
/// version of the solver. Equal digits, equal model; not meant to resist forgery.
std::string content_hash(const TetMesh& mesh, std::span<const Solid> solids,
                         const ModalOptions& options);

/// solve_modes(), looked up on disk first and kept there afterwards.
///
/// A file that is damaged, cut short or of another version is told through report() and computed
/// anew. Files are written under a name of their own and renamed into place, so that two processes
/// at once are safe: both compute, either result is whole. A directory that can't be written is
/// told and otherwise ignored.
ModalModel cached_modes(const TetMesh& mesh, std::span<const Solid> solids,
                        const ModalOptions& options = {});

/// The same in a given directory; empty: no caching.
ModalModel cached_modes(const TetMesh& mesh, std::span<const Solid> solids,
                        const ModalOptions& options, const std::filesystem::path& directory);

} // namespace ode::soft
