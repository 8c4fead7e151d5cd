/** @file
 * Tetrahedral soft bodies for the Open Dynamics Engine.
 *
 * Create a soft world beside an ODE world, load a mesh, make a body of it, and go on calling
 * dSpaceCollide and dWorldStep as before. Bodies deform, collide with the geoms of the space both
 * ways, and report their motion substep by substep to whoever observes (ode_sound does).
 *
 * Conventions, as in ODE: SI units, world frame, outputs last, opaque ids, functions return 0 or
 * NULL on failure after a sentence through ODE's message handler (dSetMessageHandler). A NULL id is
 * a caller's bug and ends in dDebug; an id whose object has ended is told apart, and destroying it
 * once more does nothing. Bodies come, go and are placed between steps, outside of near callbacks.
 * Not thread-safe per world: call from the thread that steps it.
 */
#ifndef ODE_SOFTBODY_SOFTBODY_H
#define ODE_SOFTBODY_SOFTBODY_H

#include <ode_softbody/export.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dxSoftWorld* dSoftWorldID;
typedef struct dxSoftMesh* dSoftMeshID;
typedef struct dxSoftBody* dSoftBodyID;
typedef struct dxSoftModes* dSoftModesID;

/* ---- World ------------------------------------------------------------------------------- */

/** How the library learns that ODE's world is stepped. */
typedef enum dSoftHook {
    dSoftHookNone,       /**< it doesn't: call dSoftWorldStep() */
    dSoftHookInterposed, /**< dWorldStep and dWorldQuickStep are ours: linked before ODE, preloaded
                          */
    dSoftHookThreading   /**< the library came too late for that; a threading implementation before
                              the world's own announces the step, until the application sets
                              another. A sleeping rigid body hit then wakes a step late */
} dSoftHook;

/** A world of soft bodies living in an ODE world and colliding in one of its spaces.
 * It ends with dSoftWorldDestroy() or with the ODE world, whichever comes first. */
DSOFT_API dSoftWorldID dSoftWorldCreate(dWorldID world, dSpaceID space);
DSOFT_API void dSoftWorldDestroy(dSoftWorldID world);

/** Advances soft bodies and ODE's world together by h [s]. Needed only where dSoftWorldGetHook()
 * says dSoftHookNone; harmless elsewhere.
 * @param step  dWorldStep or dWorldQuickStep.
 * @return what `step` returned; 0 when h is not finite and positive. */
DSOFT_API int dSoftWorldStep(dSoftWorldID world, dReal h, int (*step)(dWorldID, dReal));

DSOFT_API dSoftHook dSoftWorldGetHook(dSoftWorldID world);
DSOFT_API dReal dSoftWorldGetTime(dSoftWorldID world); /**< [s] stepped since creation */

/** Work done and work skipped since creation. Start with struct_size = sizeof(dSoftWorldStats). */
typedef struct dSoftWorldStats {
    unsigned struct_size;
    unsigned long steps;          /**< ODE steps seen */
    unsigned long substeps;       /**< substeps taken */
    unsigned long element_steps;  /**< element forces evaluated */
    unsigned long contact_points; /**< contact points that bore force */
    unsigned long contact_tests;  /**< surface nodes tested against a rigid shape in a substep */
    unsigned long observer_calls; /**< substep views handed out */
    dReal seconds;                /**< wall time spent in substeps [s], observers included */
    dReal observer_seconds;       /**< wall time spent in observers [s] */
    unsigned long soft_pairs;     /**< pairs of soft bodies, and bodies with themselves, carried
                                       through a substep */
    unsigned long soft_looks;     /**< searches for near parts of such a pair's surfaces */
    unsigned long soft_tests;     /**< surface points tested against a triangle of such a pair */
} dSoftWorldStats;
DSOFT_API int dSoftWorldGetStats(dSoftWorldID world, dSoftWorldStats* stats);

/* ---- Mesh -------------------------------------------------------------------------------- */

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
/** Physical groups of the elements: 0 for a mesh without, which is one solid. */
DSOFT_API int dSoftMeshGetGroupCount(dSoftMeshID mesh);
/** Name of the i-th group, NULL past the last; borrowed while the mesh lives. */
DSOFT_API const char* dSoftMeshGetGroupName(dSoftMeshID mesh, int i);

/* ---- Material ---------------------------------------------------------------------------- */

/** Isotropic solid: start from dSoftSolidDefault() or dSoftSolidPreset(), then change fields. */
typedef struct dSoftSolid {
    unsigned struct_size; /**< set by dSoftSolidDefault(); lets the struct grow */
    dReal young;          /**< [Pa], > 0 */
    dReal poisson;        /**< [-], -1 < poisson < 0.5 */
    dReal density;        /**< at rest [kg/m^3], > 0 */
    dReal phi;            /**< viscous counterpart of lambda [Pa s], >= 0 (P01 3.1) */
    dReal psi;            /**< viscous counterpart of mu [Pa s], >= 0 (P01 3.1) */
    dReal alpha;          /**< mass-proportional damping [1/s], >= 0 */
    dReal beta;           /**< stiffness-proportional damping [s], >= 0 */
} dSoftSolid;

DSOFT_API dSoftSolid dSoftSolidDefault(void); /**< steel */
/** Fills in a named material. @return 0 for an unknown name, after listing the known ones. */
DSOFT_API int dSoftSolidPreset(const char* name, dSoftSolid* solid);
/** Name of the i-th preset, NULL past the last. */
DSOFT_API const char* dSoftSolidPresetName(int i);

/* ---- Vibration modes --------------------------------------------------------------------- */

/** Called now and then during dSoftModesCompute(), on its thread.
 * @param stage  "assemble", "factorise", "modes", "verify" or "cubic"; stages may come again.
 * @param share  of this stage that is done, 0 to 1.
 * @param modes  found so far.
 * @return 0 to cancel. */
typedef int dSoftModesProgress(void* data, const char* stage, dReal share, int modes);

/** How modes are computed. Start from dSoftModesOptionsDefault(). */
typedef struct dSoftModesOptions {
    unsigned struct_size;
    int order;           /**< of the displacement in an element: 1, 2 or 3 (default), whatever the
                              mesh's. 3 costs some three times 2 and errs a tenth of it */
    int lumped;          /**< 1: diagonal mass; 0 (default): consistent, more accurate */
    int count;           /**< lowest modes only; 0 (default): all up to max_frequency */
    dReal max_frequency; /**< [Hz], default 22000; dInfinity needs a count */
    int rebuilt_curves;  /**< 1 (default): facets that meet at less than 50 degrees are taken for a
                              smooth surface, and its curvature is rebuilt; 0: facets are meant */
    int use_cache;       /**< 1 (default): results are kept in $ODE_SOFTBODY_CACHE, else
                              $XDG_CACHE_HOME/ode_softbody, else ~/.cache/ode_softbody */
    dReal tolerance;     /**< [cents]: refine until no band of the first `tolerance_count` modes is
                              wider; 0 (default): take the mesh as it is */
    int tolerance_count; /**< default 8 */
    int max_nodes;       /**< refinement to a tolerance stops here; default 200000 */
    dSoftModesProgress* progress; /**< may be NULL */
    void* progress_data;
} dSoftModesOptions;
DSOFT_API dSoftModesOptions dSoftModesOptionsDefault(void);

/** Natural frequencies and shapes of a body at rest: small vibrations, undamped, no prestress.
 * Each frequency comes with a band, measured by the change from one element order to the next: it
 * holds the exact frequency of the meshed body in some 95 of 100 cases. It says nothing about
 * material constants. The result belongs to the caller and needs the mesh no more.
 * @param solids   one for each physical group of the mesh, in order, or one for all.
 * @param clamped  nodes held still; edges and faces between them are, too. NULL and 0: free.
 * @return NULL after a sentence: bad input, too little memory, tolerance not met, cancelled. */
DSOFT_API dSoftModesID dSoftModesCompute(dSoftMeshID mesh, const dSoftSolid* solids,
                                         int solid_count, const int* clamped, int clamped_count,
                                         const dSoftModesOptions* options);
DSOFT_API void dSoftModesDestroy(dSoftModesID modes);

/** Elastic modes found; motions without strain are not among them. */
DSOFT_API int dSoftModesGetCount(dSoftModesID modes);
/** Frequencies [Hz], ascending; borrowed while the modes live. @return how many. */
DSOFT_API int dSoftModesGetFrequencies(dSoftModesID modes, const dReal** first);
/** Half-widths of the bands [cents, 1200 an octave]; borrowed. @return how many. */
DSOFT_API int dSoftModesGetErrorCents(dSoftModesID modes, const dReal** first);
/** Displacement of the mesh's nodes in a mode, mass-normalised [kg^-1/2]; borrowed.
 * @param first  out: x of node 0.  @param stride out: dReals from node to node.
 * @return node count; 0 for a mode that there isn't. */
DSOFT_API int dSoftModesGetShape(dSoftModesID modes, int mode, const dReal** first, int* stride);

/** The body that was solved. Start with struct_size = sizeof(dSoftModesInfo). */
typedef struct dSoftModesInfo {
    unsigned struct_size;
    int nodes;           /**< of the mesh as given */
    int elements;        /**< of the mesh as given */
    int solved_nodes;    /**< of the mesh after rebuilding and refinement */
    int refinements;     /**< cuts of each element into eight */
    int rigid_modes;     /**< motions without strain: 6 of a free body */
    int complete;        /**< 1: no mode below max_frequency is missing */
    dReal mass;          /**< [kg], like the rest of the body with its surface rebuilt */
    dReal volume;        /**< [m^3] */
    dReal center[3];     /**< of mass [m] */
    dReal inertia[3][3]; /**< about the centre of mass, mesh axes [kg m^2] */
    int curved_edges;    /**< surface edges that were given curvature */
    int limited_edges;   /**< whose curvature had to be cut down to keep elements valid */
    int doubtful_edges;  /**< round or corner? see dSoftMeshQuality */
} dSoftModesInfo;
DSOFT_API int dSoftModesGetInfo(dSoftModesID modes, dSoftModesInfo* info);

/* ---- Body -------------------------------------------------------------------------------- */

/** A body at rest in the mesh's own coordinates. Place it before the first step. */
DSOFT_API dSoftBodyID dSoftBodyCreate(dSoftWorldID world, dSoftMeshID mesh,
                                      const dSoftSolid* solid);
/** A body of several materials: solids[i] for the mesh's i-th physical group, in the order in which
 * its file names them. @param count of the groups, or 1 for one material throughout. */
DSOFT_API dSoftBodyID dSoftBodyCreateGroups(dSoftWorldID world, dSoftMeshID mesh,
                                            const dSoftSolid* solids, int count);
DSOFT_API void dSoftBodyDestroy(dSoftBodyID body);

DSOFT_API void dSoftBodySetData(dSoftBodyID body,
                                void* data); /**< yours; the library never looks */
DSOFT_API void* dSoftBodyGetData(dSoftBodyID body);

/* What a body is solved as: chosen before its first step, refused afterwards. Nodes of the mesh
 * keep their indices, places and velocities; the substep goes back to the library's choice. */

/** Order of the elements. 1: four nodes, cheap, and octaves sharp where the body is thin. 2: ten
 * nodes, in tune, for about twelve times the cost of the same mesh; a linear mesh is promoted, its
 * mid-edge nodes come after its own. @param order 1 or 2; 1 is refused for a mesh that has mid-edge
 * nodes itself. */
DSOFT_API int dSoftBodySetOrder(dSoftBodyID body, int order);
DSOFT_API int dSoftBodyGetOrder(dSoftBodyID body);
/** Constitutive law: "stvk" (St. Venant-Kirchhoff, the default: for what rings), "corotated"
 * (small strain, large rotation) or "stable-neo-hookean" (large strain, recovers from inversion).
 * At small strain all three are Hooke's. */
DSOFT_API int dSoftBodySetMaterialModel(dSoftBodyID body, const char* name);
DSOFT_API const char* dSoftBodyGetMaterialModel(dSoftBodyID body); /**< borrowed until it is set */
/** Gives a body of flat facets its round surface back, by moving mid-edge nodes; edges sharper than
 * 50 degrees stay sharp. Mass and centre of mass change a little. Needs order 2 of a linear mesh.
 * @param curved 1, or 0 for straight edges again.
 * @param moved  out, or NULL: surface edges that are curved now. */
DSOFT_API int dSoftBodySetCurved(dSoftBodyID body, int curved, int* moved);

/** Substep [s]: 0 lets the library choose 0.9 of the critical step. Refused above the critical. */
DSOFT_API int dSoftBodySetSubstep(dSoftBodyID body, dReal dt);
DSOFT_API dReal dSoftBodyGetSubstep(dSoftBodyID body);
/** Largest stable substep of the explicit step at rest [s]: a lower bound of it. */
DSOFT_API dReal dSoftBodyGetCriticalStep(dSoftBodyID body);

/** Moves the body as a rigid whole so that its centre of mass is here [m]. */
DSOFT_API int dSoftBodySetPosition(dSoftBodyID body, dReal x, dReal y, dReal z);
/** Turns the body about its centre of mass, from where it is. @param q w x y z, of length 1. */
DSOFT_API int dSoftBodyRotate(dSoftBodyID body, const dQuaternion q);
/** Gives all nodes one velocity [m/s]. */
DSOFT_API int dSoftBodySetLinearVel(dSoftBodyID body, dReal x, dReal y, dReal z);
/** Adds a spin about the centre of mass [rad/s] to the nodes' velocities. */
DSOFT_API int dSoftBodyAddAngularVel(dSoftBodyID body, dReal x, dReal y, dReal z);

/** Holds nodes where they are; of a promoted mesh also the middle of each edge whose ends are held.
 * @return number of nodes held. */
DSOFT_API int dSoftBodyPinNodes(dSoftBodyID body, const int* nodes, int count);
/** Frees all held nodes. */
DSOFT_API void dSoftBodyUnpin(dSoftBodyID body);

/** Nails nodes to a rigid body where they are now: they keep their places in its frame, it feels
 * their inertia and forces, and the two don't collide with each other. Of a promoted mesh the
 * middle of each edge between such nodes goes along. Choose the order and material model before.
 * Ends with dSoftBodyDetachNodes(), or with the rigid body, after a message.
 * @param rigid  NULL: the world, as dSoftBodyPinNodes().
 * @return number of nodes nailed to this rigid body; 0 on failure. */
DSOFT_API int dSoftBodyAttachNodes(dSoftBodyID body, dBodyID rigid, const int* nodes, int count);
/** Frees all nodes nailed to a rigid body, or to the world (NULL). @return how many. */
DSOFT_API int dSoftBodyDetachNodes(dSoftBodyID body, dBodyID rigid);

/** Force on a node [N] during the next step, added to what was added before. */
DSOFT_API int dSoftBodyAddForceAtNode(dSoftBodyID body, int node, dReal fx, dReal fy, dReal fz);

/** Contact of this body's surface. Start from dSoftContactDefault(). */
typedef struct dSoftContact {
    unsigned struct_size;
    dReal friction;  /**< Coulomb's coefficient [-], >= 0; dInfinity sticks */
    dReal stiffness; /**< penalty per area and depth [Pa/m]; 0: as stiff as the substep allows */
    dReal damping;   /**< time constant of normal and tangential damping [s], >= 0 */
} dSoftContact;
DSOFT_API dSoftContact dSoftContactDefault(void);
DSOFT_API int dSoftBodySetContact(dSoftBodyID body, const dSoftContact* contact);

/** Asked once a step for each pair of a soft body's geom and a rigid geom that come near each
 * other, after ODE has applied category bits, collide bits and dGeomDisable(). Must not change the
 * world.
 * @param contact  in: the soft body's own; out: how these two meet in this step, in N, m and s.
 * @return 0: they pass through each other in this step. */
typedef int dSoftContactCallback(void* data, dGeomID soft, dGeomID rigid, dSoftContact* contact);
/** Lets the application choose the contact of every pair; NULL: the soft bodies' own again. */
DSOFT_API int dSoftWorldSetContactCallback(dSoftWorldID world, dSoftContactCallback* callback,
                                           void* data);

/* Soft bodies of one world meet each other as they meet rigid ones. A pair's friction is the
 * geometric mean of both bodies' coefficients, its damping the mean, its stiffness the lesser. */

/** Whether the body may not pass through itself, as a sheet that folds; off by default. Parts
 * nearer to each other at rest than an edge of the mesh do not see each other. */
DSOFT_API void dSoftBodySetSelfContact(dSoftBodyID body, int on);
DSOFT_API int dSoftBodyGetSelfContact(dSoftBodyID body);

/** Positions and velocities of all nodes in the mesh's order; borrowed until the next step or
 * change of order.
 * @param first  out: x of node 0.
 * @param stride out: dReals from node to node.
 * @return node count. */
DSOFT_API int dSoftBodyGetPositions(dSoftBodyID body, const dReal** first, int* stride);
DSOFT_API int dSoftBodyGetVelocities(dSoftBodyID body, const dReal** first, int* stride);
/** Surface triangles, three node indices each, outward; borrowed while the body lives and
 * keeps its order.
 * @return triangle count. */
DSOFT_API int dSoftBodyGetTriangles(dSoftBodyID body, const int** first);

DSOFT_API dReal dSoftBodyGetMass(dSoftBodyID body);                         /**< [kg] */
DSOFT_API void dSoftBodyGetCenterOfMass(dSoftBodyID body, dVector3 center); /**< [m] */
DSOFT_API void dSoftBodyGetMomentum(dSoftBodyID body, dVector3 linear, dVector3 angular);
/**< [kg m/s], [kg m^2/s] about the world's origin */

/** Energies [J]. */
typedef struct dSoftEnergy {
    dReal kinetic;
    dReal elastic;
} dSoftEnergy;
DSOFT_API dSoftEnergy dSoftBodyGetEnergy(dSoftBodyID body);

/** How a body fares. */
typedef struct dSoftStatus {
    unsigned struct_size;
    int stopped;         /**< 1: it went unstable, was reported and stands still */
    dReal substep;       /**< in use [s] */
    dReal critical_step; /**< [s] */
    dReal min_jacobian;  /**< least volume ratio of an element in the last step */
    dReal max_stretch;   /**< upper bound of the largest stretch in the last step */
    int contact_points;  /**< that bore force in the last substep */
} dSoftStatus;
DSOFT_API int dSoftBodyGetStatus(dSoftBodyID body, dSoftStatus* status);

/** Elastic vibration modes of the body at rest, in its order, solids and pins, ascending, rigid
 * ones left out.
 * @param frequencies  out: up to `count` frequencies [Hz].
 * @return how many were written. */
DSOFT_API int dSoftBodyGetModes(dSoftBodyID body, int count, dReal* frequencies);

/** The geom that stands for the body in its space. Do not destroy it. Under dSoftHookInterposed
 * dSpaceGetNumGeoms() and dSpaceGetGeom() pass over it. */
DSOFT_API dGeomID dSoftBodyGetGeom(dSoftBodyID body);
/** The body behind a geom, NULL if there is none. */
DSOFT_API dSoftBodyID dSoftGeomGetSoftBody(dGeomID geom);

/* ---- Observers --------------------------------------------------------------------------- */

/** One body at the end of a substep. All pointers are borrowed: they die on return. */
typedef struct dSoftSubstep {
    unsigned struct_size;
    dSoftBodyID body;
    dReal time;            /**< [s] since the world's creation */
    dReal dt;              /**< [s] */
    const dReal* position; /**< of every node [m], world frame, x y z and padding */
    const dReal* velocity; /**< of every node [m/s], half a substep back */
    int stride;            /**< dReals from node to node */
    int node_count;
    const int* triangle; /**< three nodes each, outward; same array for the body's life */
    int triangle_count;
} dSoftSubstep;

/** Called after each substep for each awake body, in order of registration. Must not change the
 * world, its bodies or its observers. */
typedef void dSoftSubstepCallback(void* data, const dSoftSubstep* substep);

/** Called once a step, after its substeps and before ODE's own step.
 * @param time  at the end of the step [s]. */
typedef void dSoftStepCallback(void* data, dSoftWorldID world, dReal time);

/** Called when a body ends, before anything of it is gone. */
typedef void dSoftBodyEndCallback(void* data, dSoftBodyID body);

/** Called when the world ends, before its bodies do. */
typedef void dSoftWorldEndCallback(void* data, dSoftWorldID world);

/** A set of callbacks; those left NULL are not called and cost nothing. */
typedef struct dSoftObserver {
    unsigned struct_size;
    void* data; /**< handed to every callback; also the observer's name for removal */
    dSoftSubstepCallback* on_substep;
    dSoftStepCallback* on_step;
    dSoftBodyEndCallback* on_body_end;
    dSoftWorldEndCallback* on_world_end;
} dSoftObserver;

DSOFT_API int dSoftWorldAddObserver(dSoftWorldID world, const dSoftObserver* observer);
DSOFT_API int dSoftWorldAddSubstepObserver(dSoftWorldID world, dSoftSubstepCallback* callback,
                                           void* data);
/** Removes every observer registered with `data`. @return how many. */
DSOFT_API int dSoftWorldRemoveObserver(dSoftWorldID world, void* data);

#ifdef __cplusplus
}
#endif

#endif
