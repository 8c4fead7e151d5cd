#include "scenes/plate.h"

#include "scenes/moved_mesh.h"

namespace scenes {

ode::soft::MeshHandle graded_plate(int cells) {
    const ode::soft::MeshHandle even(
        made(dSoftMeshCreatePlate(kPlateSide, kPlateSide, kPlateThickness, cells, cells, 1)));
    return moved(even, [](double* x) {
        for (int k = 0; k < 2; ++k) {
            const double u = x[k] / (kPlateSide / 2);
            x[k] *= 1.25 - 0.25 * u * u;
        }
    });
}

} // namespace scenes
