#include "model/make_model.h"

#include "base/error.h"
#include "mesh/tet_mesh.h"
#include "model/corotated.h"
#include "model/stable_neo_hookean.h"
#include "model/stvk_linear.h"
#include "model/stvk_quadratic.h"

#include <algorithm>
#include <array>
#include <string>

namespace ode::soft {
namespace {

using Make = std::unique_ptr<ElasticModel> (*)(const TetMesh&, std::span<const Solid>);

template <class Linear, class Quadratic>
std::unique_ptr<ElasticModel> make(const TetMesh& mesh, std::span<const Solid> solid) {
    if (mesh.order == 1)
        return std::make_unique<Linear>(mesh, solid);
    return std::make_unique<Quadratic>(mesh, solid);
}

constexpr std::array kNames = {"stvk", "corotated", "stable-neo-hookean"};
constexpr std::array<Make, kNames.size()> kMakers = {
    make<StvkLinear, StvkQuadratic>, make<CorotatedLinear, CorotatedQuadratic>,
    make<StableNeoHookeanLinear, StableNeoHookeanQuadratic>};

} // namespace

std::span<const char* const> model_names() noexcept { return kNames; }

std::unique_ptr<ElasticModel> make_model(std::string_view name, const TetMesh& mesh,
                                         std::span<const Solid> solid) {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) {
        std::string known;
        for (const char* n : kNames)
            known += std::string(known.empty() ? "" : ", ") + n;
        throw InputError(format("no material model '%.*s'; known are %s",
                                static_cast<int>(name.size()), name.data(), known.c_str()));
    }
    return kMakers[static_cast<std::size_t>(found - kNames.begin())](mesh, solid);
}

} // namespace ode::soft
