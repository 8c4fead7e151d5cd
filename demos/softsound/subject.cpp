#include "softsound/subject.h"

#include <cmath>

namespace softsound {

dSoftSolid preset(const std::string& material) {
    dSoftSolid solid = dSoftSolidDefault();
    if (!dSoftSolidPreset(material.c_str(), &solid))
        throw scenes::Refused("material");
    return solid;
}

std::vector<int> nodes_where(dSoftBodyID body, const std::function<bool(const dReal*)>& condition) {
    const dReal* first = nullptr;
    int stride = 0;
    std::vector<int> nodes;
    const int count = dSoftBodyGetPositions(body, &first, &stride);
    for (int i = 0; i < count; ++i)
        if (condition(first + static_cast<std::ptrdiff_t>(i) * stride))
            nodes.push_back(i);
    return nodes;
}

nlohmann::ordered_json first_mode(dSoftBodyID body, dSoftMeshID mesh, const dSoftSolid& solid,
                                  std::span<const int> held) {
    dReal own = 0;
    dSoftModesOptions options = dSoftModesOptionsDefault();
    options.count = 1;
    options.max_frequency = dInfinity;
    const ode::soft::ModesHandle modes(dSoftModesCompute(mesh, &solid, 1,
                                                         held.empty() ? nullptr : held.data(),
                                                         static_cast<int>(held.size()), &options));
    const dReal *exact = nullptr, *band = nullptr;
    if (dSoftBodyGetModes(body, 1, &own) != 1 || dSoftModesGetFrequencies(modes, &exact) < 1)
        throw scenes::Refused("modes");
    const int bands = dSoftModesGetErrorCents(modes, &band);
    return {{"first_mode_hz", own},
            {"first_mode_exact_hz", exact[0]},
            {"first_mode_cents", 1200 * std::log2(own / exact[0])},
            {"first_mode_band_cents", bands > 0 ? band[0] : HUGE_VAL}};
}

} // namespace softsound
