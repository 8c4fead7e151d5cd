#pragma once

#include "model/elastic_model.h"
#include "model/solid.h"

#include <memory>
#include <span>
#include <string_view>

namespace ode::soft {

struct TetMesh;

/// Names of the constitutive laws, the default first: "stvk", "corotated", "stable-neo-hookean".
std::span<const char* const> model_names() noexcept;

/// A mesh's solid under the law of that name, in elements of the mesh's order.
/// @param solid  one a group of the mesh; one in all if it has no groups.
/// @throws InputError for an unknown name, after the known ones, and what TetModel refuses.
std::unique_ptr<ElasticModel> make_model(std::string_view name, const TetMesh& mesh,
                                         std::span<const Solid> solid);

} // namespace ode::soft
