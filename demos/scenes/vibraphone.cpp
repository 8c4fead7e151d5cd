#include "scenes/vibraphone.h"

#include <cmath>
#include <vector>

namespace scenes {

ode::soft::MeshHandle vibraphone_bar(int cells) {
    constexpr double kMiddle = 5.025e-3, kReach = 0.11; // [m]
    const ode::soft::MeshHandle straight(made(
        dSoftMeshCreateBar(kVibraphoneLength, kVibraphoneWidth, kVibraphoneHeight, cells, 2, 1)));
    const dReal* x = nullptr;
    const int nodes = dSoftMeshGetNodes(straight, &x);
    const int* element = nullptr;
    const int elements = dSoftMeshGetElements(straight, &element);
    std::vector<double> place(x, x + 3 * static_cast<std::ptrdiff_t>(nodes));
    for (std::size_t i = 0; i < place.size(); i += 3) {
        const double way = std::abs(place[i] - kVibraphoneLength / 2) / kReach;
        const double thick =
            way < 1 ? kMiddle + (kVibraphoneHeight - kMiddle) * way * way * way : kVibraphoneHeight;
        const double top = kVibraphoneHeight / 2;
        place[i + 2] = top - (top - place[i + 2]) / kVibraphoneHeight * thick;
    }
    return ode::soft::MeshHandle(made(dSoftMeshCreate(place.data(), nodes, element, elements)));
}

} // namespace scenes
