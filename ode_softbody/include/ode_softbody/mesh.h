/** @file
 * Tetrahedral meshes: read from files, from arrays, or made. Conventions: softbody.h.
 */
#ifndef ODE_SOFTBODY_MESH_H
#define ODE_SOFTBODY_MESH_H

#include <ode_softbody/export.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dxSoftMesh* dSoftMeshID;

/** Reads linear or quadratic tetrahedra from Gmsh .msh (2.2, 4.1), TetGen .node/.ele, legacy .vtk
 * or Medit .mesh, chosen by the file's ending. The mesh belongs to the caller; bodies keep what
 * they need of it. */
DSOFT_API dSoftMeshID dSoftMeshLoad(const char* path);

/** Mesh from arrays. @param nodes xyz packed [m]. @param tets four node indices each, from 0. */
DSOFT_API dSoftMeshID dSoftMeshCreate(const dReal* nodes, int node_count, const int* tets,
                                      int tet_count);

/** Box of sides x, y, z [m] centred on the origin, cut into nx*ny*nz cells. */
DSOFT_API dSoftMeshID dSoftMeshCreateBox(dReal x, dReal y, dReal z, int nx, int ny, int nz);
/** Bar along x from 0 to length [m], width along y, thickness along z. */
DSOFT_API dSoftMeshID dSoftMeshCreateBar(dReal length, dReal width, dReal thickness, int nx, int ny,
                                         int nz);
/** Plate in the xy plane centred on the origin [m], thickness along z. */
DSOFT_API dSoftMeshID dSoftMeshCreatePlate(dReal length, dReal width, dReal thickness, int nx,
                                           int ny, int nz);
/** Spherical shell, lowest point at z = -radius, open towards +z from polar angle `opening` [rad].
 */
DSOFT_API dSoftMeshID dSoftMeshCreateBowl(dReal radius, dReal thickness, dReal opening, int rings,
                                          int around, int layers);
/** Tube along z from 0 to length [m]. */
DSOFT_API dSoftMeshID dSoftMeshCreateTube(dReal length, dReal outer_radius, dReal inner_radius,
                                          int along, int around, int layers);
/** Solid sphere round the origin [m], `refinement` cells from centre to surface. */
DSOFT_API dSoftMeshID dSoftMeshCreateSphere(dReal radius, int refinement);

DSOFT_API void dSoftMeshDestroy(dSoftMeshID mesh);

/** What a mesh is worth. Start with struct_size = sizeof(dSoftMeshQuality). */
typedef struct dSoftMeshQuality {
    unsigned struct_size;
    int nodes;
    int elements;
    int surface_triangles;
    int parts;          /**< pieces that share no node */
    int worst;          /**< element of min_quality */
    dReal min_quality;  /**< 1 regular tetrahedron, 0 flat */
    dReal volume;       /**< [m^3] */
    dReal min_edge;     /**< [m] */
    dReal max_edge;     /**< [m] */
    dReal bounds[6];    /**< xmin xmax ymin ymax zmin zmax [m], the order of dGeomGetAABB */
    int doubtful_edges; /**< facets meet there at 35 to 80 degrees: a round of too few facets, or a
                             corner? (less than about ten round; 0 on a second-order mesh) */
} dSoftMeshQuality;
DSOFT_API int dSoftMeshGetQuality(dSoftMeshID mesh, dSoftMeshQuality* quality);

/** Multiplies all coordinates by `factor`: 0.001 for a mesh drawn in millimetres. */
DSOFT_API int dSoftMeshScale(dSoftMeshID mesh, dReal factor);

/** 1: elements of four nodes; 2: of ten, as read from a second-order file. */
DSOFT_API int dSoftMeshGetOrder(dSoftMeshID mesh);
/** Nodes xyz packed [m], in the mesh's order; borrowed while the mesh lives unscaled.
 * @param first  out, unless NULL: x of node 0.
 * @return node count. */
DSOFT_API int dSoftMeshGetNodes(dSoftMeshID mesh, const dReal** first);
/** Node indices of the elements, 4 or 10 each by the order; borrowed while the mesh lives.
 * @param first  out, unless NULL.
 * @return element count. */
DSOFT_API int dSoftMeshGetElements(dSoftMeshID mesh, const int** first);
/** The same body in elements of ten nodes, the middles of edges after the nodes as given; facets
 * that meet at less than 50 degrees are taken for a smooth surface, whose curvature it gets back.
 * Groups are kept. Of a second-order mesh a copy. */
DSOFT_API dSoftMeshID dSoftMeshCreateQuadratic(dSoftMeshID mesh);
/** Surface triangles, three nodes each, outward; four a face of a second-order mesh. Borrowed while
 * the mesh lives. @param first  out, unless NULL. @return triangle count; 0 after a message for a
 * surface that can't be told: three elements on one face. */
DSOFT_API int dSoftMeshGetTriangles(dSoftMeshID mesh, const int** first);
/** Physical groups of the elements: 0 for a mesh without, which is one solid. */
DSOFT_API int dSoftMeshGetGroupCount(dSoftMeshID mesh);
/** Name of the i-th group, NULL past the last; borrowed while the mesh lives. */
DSOFT_API const char* dSoftMeshGetGroupName(dSoftMeshID mesh, int i);

#ifdef __cplusplus
}
#endif

#endif
