#pragma once

#include "mesh/curve.h"
#include "modal/solve_modes.h"

#include <filesystem>

namespace ode::soft {

struct ToleranceOptions {
    /// Widest band of the first `partials` that is good enough [cents]; 0: the mesh as it is.
    double cents = 0;
    std::size_t partials = 8;
    /// Nodes of the finest mesh, with those of its edges' middles.
    std::size_t max_nodes = 200000;
    bool rebuild_curves = true;  ///< by curve_surface(), on a mesh of straight edges
    std::filesystem::path cache; ///< directory for cached_modes(); empty: none
};

struct TolerantModes {
    ModalModel model;      ///< shapes on the nodes of the mesh as given
    CurveReport curve;     ///< of the mesh as given
    int refinements = 0;   ///< uniform ones that were needed
    std::size_t nodes = 0; ///< of the mesh that was solved
};

/// Modes of a body that the user's mesh stands for: its curved surface is rebuilt where the mesh
/// gives facets, and elements are cut into eight until the bands are narrow enough.
///
/// Refinement narrows what the elements leave open. It can't tell the true surface: the band keeps
/// 0.3 of what the facets *as given* would change, on each refined mesh.
/// @param options  `estimate` is needed for a tolerance; supports are given on the mesh's nodes and
///                 hold the edges between them
/// @throws InputError also when the tolerance isn't met within the limits: names the band reached
TolerantModes modes_to_tolerance(const TetMesh& mesh, std::span<const Solid> solids,
                                 const ModalOptions& options, const ToleranceOptions& tolerance);

} // namespace ode::soft
