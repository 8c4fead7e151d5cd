#include "api/solid.h"

#include "api/versioned.h"
#include "base/error.h"
#include "model/materials.h"

#include <algorithm>
#include <string>

namespace ode::soft {
namespace {

dSoftSolid to_c(const Solid& s) noexcept {
    dSoftSolid c{};
    c.struct_size = sizeof c;
    c.young = s.young;
    c.poisson = s.poisson;
    c.density = s.density;
    c.phi = s.phi;
    c.psi = s.psi;
    c.alpha = s.alpha;
    c.beta = s.beta;
    c.loss_factor = s.loss_factor;
    return c;
}

} // namespace

Solid from_c(const dSoftSolid& given) {
    dSoftSolid c = to_c(Solid{});
    copy_in(given, "dSoftSolidDefault", &c);
    Solid s;
    s.young = c.young;
    s.poisson = c.poisson;
    s.density = c.density;
    s.phi = c.phi;
    s.psi = c.psi;
    s.alpha = c.alpha;
    s.beta = c.beta;
    s.loss_factor = c.loss_factor;
    return s;
}

std::vector<Solid> from_c(const dSoftSolid* given, int count, const TetMesh& mesh) {
    const std::size_t groups = std::max<std::size_t>(1, mesh.group_name.size());
    if (count != 1 && (count < 1 || static_cast<std::size_t>(count) != groups))
        throw InputError(format("%d solids for a mesh of %zu groups; give one a group, or one for "
                                "all",
                                count, groups));
    std::vector<Solid> all;
    // The application's struct may be shorter than ours.
    const auto* at = reinterpret_cast<const char*>(given);
    for (int i = 0; i < count; ++i, at += given->struct_size)
        all.push_back(from_c(*reinterpret_cast<const dSoftSolid*>(at)));
    return all;
}

} // namespace ode::soft

using namespace ode::soft;

dSoftSolid dSoftSolidDefault(void) { return to_c(find_material("steel")->solid); }

int dSoftSolidPreset(const char* name, dSoftSolid* solid) {
    const Material* material = find_material(name);
    if (!material) {
        std::string known;
        for (const Material& m : materials())
            known += std::string(known.empty() ? "" : ", ") + m.name;
        report(format("dSoftSolidPreset: no material '%s'; known are %s", name, known.c_str()));
        return 0;
    }
    *solid = to_c(material->solid);
    return 1;
}

const char* dSoftSolidPresetName(int i) {
    const auto all = materials();
    return i >= 0 && static_cast<std::size_t>(i) < all.size()
               ? all[static_cast<std::size_t>(i)].name
               : nullptr;
}
