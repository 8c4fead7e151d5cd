#include "scenes/vibraphone.h"

#include "scenes/moved_mesh.h"

#include <cmath>

namespace scenes {

namespace {

/// At a place along the bar [m].
double thickness(double x) {
    constexpr double kMiddle = 5.025e-3, kReach = 0.11; // [m]
    const double way = std::abs(x - kVibraphoneLength / 2) / kReach;
    return way < 1 ? kMiddle + (kVibraphoneHeight - kMiddle) * way * way * way : kVibraphoneHeight;
}

} // namespace

double vibraphone_underside(double x) { return kVibraphoneHeight / 2 - thickness(x); }

ode::soft::MeshHandle vibraphone_bar(int cells) {
    const ode::soft::MeshHandle straight(made(
        dSoftMeshCreateBar(kVibraphoneLength, kVibraphoneWidth, kVibraphoneHeight, cells, 2, 1)));
    return moved(straight, [](double* x) {
        const double top = kVibraphoneHeight / 2;
        x[2] = top - (top - x[2]) / kVibraphoneHeight * thickness(x[0]);
    });
}

} // namespace scenes
