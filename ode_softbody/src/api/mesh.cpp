#include "api/boundary.h"
#include "api/handles.h"
#include "api/versioned.h"
#include "mesh/curve.h"
#include "mesh/generate.h"
#include "mesh/promote.h"
#include "mesh/quality.h"
#include "mesh/read.h"
#include "mesh/surface.h"

#include <cmath>

using namespace ode::soft;

namespace {

template <class Make>
dSoftMeshID make_mesh(const char* function, Make&& make) noexcept {
    return guarded(function, dSoftMeshID{}, [&] { return to_id(*new dxSoftMesh{make()}); });
}

int doubtful_edges(const TetMesh& mesh) {
    if (mesh.order != 1)
        return 0;
    TetMesh curved = promote_to_quadratic(mesh);
    return static_cast<int>(curve_surface(curved).doubtful);
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

void dSoftMeshDestroy(dSoftMeshID mesh) { delete LiveId<dxSoftMesh>::find(mesh); }

int dSoftMeshGetQuality(dSoftMeshID id, dSoftMeshQuality* out) {
    dxSoftMesh* mesh = live(id, __func__);
    if (!mesh)
        return 0;
    return guarded(__func__, 0, [&] {
        const MeshQuality q = measure_quality(mesh->mesh);
        dSoftMeshQuality all{};
        all.nodes = static_cast<int>(mesh->mesh.node.size());
        all.elements = static_cast<int>(mesh->mesh.element_count());
        all.surface_triangles = static_cast<int>(extract_surface(mesh->mesh).triangle.size());
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
        all.doubtful_edges = doubtful_edges(mesh->mesh);
        return copy_out("dSoftMeshGetQuality", all, out);
    });
}

int dSoftMeshScale(dSoftMeshID id, dReal factor) {
    dxSoftMesh* mesh = live(id, __func__);
    if (!mesh)
        return 0;
    return guarded(__func__, 0, [&] {
        if (!(factor > 0) || !std::isfinite(factor))
            throw InputError(format("the factor is %g: it must be finite and positive", factor));
        for (Vec3& x : mesh->mesh.node)
            x *= factor;
        return 1;
    });
}

int dSoftMeshGetOrder(dSoftMeshID id) {
    dxSoftMesh* mesh = live(id, __func__);
    if (!mesh)
        return 0;
    return mesh->mesh.order;
}

int dSoftMeshGetNodes(dSoftMeshID id, const dReal** first) {
    dxSoftMesh* mesh = live(id, __func__);
    if (!mesh)
        return 0;
    static_assert(sizeof(Vec3) == 3 * sizeof(dReal));
    if (first)
        *first = mesh->mesh.node.empty() ? nullptr : mesh->mesh.node.front().data();
    return static_cast<int>(mesh->mesh.node.size());
}

int dSoftMeshGetElements(dSoftMeshID id, const int** first) {
    dxSoftMesh* mesh = live(id, __func__);
    if (!mesh)
        return 0;
    if (first)
        *first = mesh->mesh.element.data();
    return static_cast<int>(mesh->mesh.element_count());
}

dSoftMeshID dSoftMeshCreateQuadratic(dSoftMeshID id) {
    dxSoftMesh* mesh = live(id, __func__);
    if (!mesh)
        return nullptr;
    return make_mesh(__func__, [&] {
        TetMesh straight = promote_to_quadratic(mesh->mesh);
        if (mesh->mesh.order == 2)
            return straight;
        TetMesh curved = straight;
        const CurveReport report = curve_surface(curved);
        // Half-curved elements are worse than flat ones: see to_tolerance.cpp.
        return report.moved > 4 * report.limited ? curved : straight;
    });
}

int dSoftMeshGetTriangles(dSoftMeshID id, const int** first) {
    dxSoftMesh* mesh = live(id, __func__);
    if (!mesh)
        return 0;
    return guarded(__func__, 0, [&] {
        if (mesh->surface.triangle.empty())
            mesh->surface = extract_surface(mesh->mesh);
        if (first)
            *first = mesh->surface.triangle.front().data();
        return static_cast<int>(mesh->surface.triangle.size());
    });
}

int dSoftMeshGetGroupCount(dSoftMeshID id) {
    dxSoftMesh* mesh = live(id, __func__);
    if (!mesh)
        return 0;
    return static_cast<int>(mesh->mesh.group_name.size());
}

const char* dSoftMeshGetGroupName(dSoftMeshID id, int i) {
    dxSoftMesh* mesh = live(id, __func__);
    if (!mesh)
        return nullptr;
    const auto& names = mesh->mesh.group_name;
    return i >= 0 && static_cast<std::size_t>(i) < names.size()
               ? names[static_cast<std::size_t>(i)].c_str()
               : nullptr;
}
