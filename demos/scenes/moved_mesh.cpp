#include "scenes/moved_mesh.h"

#include <vector>

namespace scenes {

ode::soft::MeshHandle moved(dSoftMeshID mesh, const std::function<void(double* place)>& move) {
    const dReal* x = nullptr;
    const int nodes = dSoftMeshGetNodes(mesh, &x);
    const int* element = nullptr;
    const int elements = dSoftMeshGetElements(mesh, &element);
    std::vector<double> place(x, x + 3 * static_cast<std::ptrdiff_t>(nodes));
    for (std::size_t i = 0; i < place.size(); i += 3)
        move(&place[i]);
    return ode::soft::MeshHandle(made(dSoftMeshCreate(place.data(), nodes, element, elements)));
}

} // namespace scenes
