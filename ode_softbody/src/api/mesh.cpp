#include "api/boundary.h"
#include "api/handles.h"
#include "api/versioned.h"
#include "mesh/generate.h"
#include "mesh/quality.h"
#include "mesh/read.h"
#include "mesh/surface.h"

using namespace ode::soft;

namespace {

template <class Make>
dSoftMeshID make_mesh(const char* function, Make&& make) noexcept {
    return guarded(function, dSoftMeshID{}, [&] { return new dxSoftMesh{make()}; });
}

} // namespace

dSoftMeshID dSoftMeshLoad(const char* path) {
    require_id(path, __func__);
    return make_mesh(__func__, [&] { return read_mesh(path); });
}

dSoftMeshID dSoftMeshCreate(const dReal* nodes, int node_count, const int* tets, int tet_count) {
    require_id(nodes, __func__);
    require_id(tets, __func__);
    return make_mesh(__func__, [&] {
        if (node_count < 4 || tet_count < 1)
            throw InputError(
                format("%d nodes and %d tetrahedra make no solid: give at least 4 and 1",
                       node_count, tet_count));
        TetMesh mesh;
        for (int i = 0; i < node_count; ++i)
            mesh.node.emplace_back(nodes[3 * i], nodes[3 * i + 1], nodes[3 * i + 2]);
        mesh.element.assign(tets, tets + 4 * static_cast<std::size_t>(tet_count));
        check_mesh(mesh, "mesh");
        return mesh;
    });
}

dSoftMeshID dSoftMeshCreateBox(dReal x, dReal y, dReal z, int nx, int ny, int nz) {
    return make_mesh(__func__, [&] { return make_box({x, y, z}, nx, ny, nz); });
}

dSoftMeshID dSoftMeshCreateBar(dReal length, dReal width, dReal thickness, int nx, int ny, int nz) {
    return make_mesh(__func__, [&] { return make_bar(length, width, thickness, nx, ny, nz); });
}

dSoftMeshID dSoftMeshCreatePlate(dReal length, dReal width, dReal thickness, int nx, int ny,
                                 int nz) {
    return make_mesh(__func__, [&] { return make_plate(length, width, thickness, nx, ny, nz); });
}

dSoftMeshID dSoftMeshCreateBowl(dReal radius, dReal thickness, dReal opening, int rings, int around,
                                int layers) {
    return make_mesh(__func__,
                     [&] { return make_bowl(radius, thickness, opening, rings, around, layers); });
}

dSoftMeshID dSoftMeshCreateTube(dReal length, dReal outer_radius, dReal inner_radius, int along,
                                int around, int layers) {
    return make_mesh(__func__, [&] {
        return make_tube(length, outer_radius, inner_radius, along, around, layers);
    });
}

dSoftMeshID dSoftMeshCreateSphere(dReal radius, int refinement) {
    return make_mesh(__func__, [&] { return make_sphere(radius, refinement); });
}

void dSoftMeshDestroy(dSoftMeshID mesh) { delete mesh; }

int dSoftMeshGetQuality(dSoftMeshID id, dSoftMeshQuality* out) {
    require_id(id, __func__);
    return guarded(__func__, 0, [&] {
        const MeshQuality q = measure_quality(id->mesh);
        dSoftMeshQuality all{};
        all.nodes = static_cast<int>(id->mesh.node.size());
        all.elements = static_cast<int>(id->mesh.element_count());
        all.surface_triangles = static_cast<int>(extract_surface(id->mesh).triangle.size());
        all.parts = static_cast<int>(q.parts);
        all.worst = static_cast<int>(q.worst);
        all.min_quality = q.min_quality;
        all.volume = q.volume;
        all.min_edge = q.min_edge;
        all.max_edge = q.max_edge;
        for (int axis = 0; axis < 3; ++axis) {
            all.bounds[2 * axis] = q.low[axis];
            all.bounds[2 * axis + 1] = q.high[axis];
        }
        return copy_out("dSoftMeshGetQuality", all, out);
    });
}
