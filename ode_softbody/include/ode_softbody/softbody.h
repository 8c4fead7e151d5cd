/** @file
 * Tetrahedral soft bodies for the Open Dynamics Engine: the header that includes the others.
 *
 * Create a soft world beside an ODE world, load a mesh, make a body of it, and go on calling
 * dSpaceCollide and dWorldStep as before. Bodies deform, collide with the geoms of the space both
 * ways, and report their motion substep by substep to whoever observes (ode_sound does).
 *
 * Conventions, as in ODE: SI units, world frame, outputs last, opaque ids, functions return 0 or
 * NULL on failure after a sentence through ODE's message handler (dSetMessageHandler). A NULL id is
 * a caller's bug and ends in dDebug; an id whose object has ended is told apart, and destroying it
 * once more does nothing. Bodies come, go and are placed between steps, outside of near callbacks.
 * Not thread-safe per world: call from the thread that steps it (threads.h has it use more).
 */
#ifndef ODE_SOFTBODY_SOFTBODY_H
#define ODE_SOFTBODY_SOFTBODY_H

#include <ode_softbody/integrator.h>
#include <ode_softbody/mesh.h>
#include <ode_softbody/modes.h>
#include <ode_softbody/solid.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dxSoftWorld* dSoftWorldID;
typedef struct dxSoftBody* dSoftBodyID;

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
    unsigned long body_substeps;  /**< bodies moved by a substep: those at rest are not */
    unsigned long mirror_steps;   /**< steps of jointed rigid bodies near soft ones */
    unsigned long rigid_contacts; /**< contacts between rigid bodies that bore force in a substep */
    unsigned long modal_substeps; /**< of body_substeps, those of bodies in their modes */
} dSoftWorldStats;
DSOFT_API int dSoftWorldGetStats(dSoftWorldID world, dSoftWorldStats* stats);

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
 * mid-edge nodes come after its own. Mass is lumped in both (order 2: Hinton, Rock & Zienkiewicz),
 * because an explicit step divides by it node by node; the consistent mass, which is truer in
 * pitch, is for dSoftModesCompute(). @param order 1 or 2; 1 is refused for a mesh that has mid-edge
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

/** How the body is stepped, by name: "central-difference" (the default; "verlet" is the same),
 * "explicit-euler", "symplectic-euler", "modified-euler", "midpoint", "runge-kutta-4",
 * "backward-euler", "linearised-backward-euler", "trapezoidal", "tr-bdf2". The implicit ones, from
 * backward Euler on, take any substep, lose high frequencies or detune them by it, and allocate
 * memory in a step. */
DSOFT_API int dSoftBodySetIntegrator(dSoftBodyID body, const char* name);
DSOFT_API const char* dSoftBodyGetIntegrator(dSoftBodyID body); /**< borrowed until it is set */

/** How dSoftBodySetTolerance() chose. Start with struct_size = sizeof(dSoftChoice). */
typedef struct dSoftChoice {
    unsigned struct_size;
    int order;
    const char* material_model; /**< borrowed until it is set */
    const char* integrator;     /**< borrowed until it is set */
    dReal substep;              /**< [s] */
    dReal expected_cents;       /**< error of the worst of the eight lowest partials */
} dSoftChoice;

/** Chooses order, material model, integrator and substep: the cheapest that keeps the eight lowest
 * partials of the body, as it is pinned now, within a tolerance. The error of elements and steps is
 * estimated from the mesh's modes (a second for some 1000 elements; kept in the cache of
 * dSoftModesCompute), not that of the mesh's own shape or of the material. The model is "stvk", or
 * "stable-neo-hookean" for what is so soft that a fall strains it by per cents.
 * @param cents   > 0; 17 is a draft, 3 what a trained ear tells.
 * @param choice  out, or NULL.
 * @return 0 after a sentence where no choice is expected to be so right: the body then gets the
 * truest. Also 0, and nothing changes, where dSoftBodySetOrder() would refuse. */
DSOFT_API int dSoftBodySetTolerance(dSoftBodyID body, dReal cents, dSoftChoice* choice);

/** Damps the body mode by mode (1) instead of by viscous stress (0, the default). The same decay in
 * the linear range, and each mode to rounding, but the substep needn't shrink for it: for bodies
 * that ring it is the faster way. The modes up to 22 kHz (500 at most) are found at the first step,
 * and again when pins change: some seconds for 10 000 nodes, kept in the cache of
 * dSoftModesCompute. What is above them decays like the highest. Rigid motion is never damped. The
 * body must be one piece. On by itself, and not to be had off, with a loss factor or a table. */
DSOFT_API int dSoftBodySetModalDamping(dSoftBodyID body, int on);
DSOFT_API int dSoftBodyGetModalDamping(dSoftBodyID body); /**< whether modes damp the body */
/** Decay times of the body in place of those of its solids: T60 [s] at frequencies [Hz], ascending.
 * Between two, the decay rate is a power of frequency; beyond the ends it stays. Give one entry a
 * mode, or as many as were measured; dSoftT60FromDecay() takes them from Q or loss factor. Copied.
 * @param count  0: back to the solids' damping. */
DSOFT_API int dSoftBodySetDampingTable(dSoftBodyID body, const dReal* frequencies, const dReal* t60,
                                       int count);

/** Substep [s]: 0 lets the library choose 0.9 of the critical step (implicit integrators: 5.2 us).
 * Refused above the critical. */
DSOFT_API int dSoftBodySetSubstep(dSoftBodyID body, dReal dt);
DSOFT_API dReal dSoftBodyGetSubstep(dSoftBodyID body);
/** Largest stable substep of the body's integrator at rest [s]: a lower bound of it. Infinite for
 * the implicit ones; 0 for those that let undamped vibrations grow at any step. */
DSOFT_API dReal dSoftBodyGetCriticalStep(dSoftBodyID body);
/** The same of the body as it is deformed and held now: it shrinks under stretch. Costs some
 * seventy products with the stiffness matrix. */
DSOFT_API dReal dSoftBodyEstimateCriticalStep(dSoftBodyID body);

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

/** How the soft bodies of a world keep each other, and themselves, apart:
 * "closest-point"  surface points against the other's triangles (default): for thin and fast bodies
 * "volume"         the source paper's penalty on the volume that each two tetrahedra have in common
 *                  (P01 3.1), with a potential: errs twenty times less in energy, for four to five
 *                  times the time. What moves farther in an impact than elements are thick passes.
 * May change between steps; friction then forgets. @return 0 for an unknown name, after listing the
 * known ones. */
DSOFT_API int dSoftWorldSetSoftContactMethod(dSoftWorldID world, const char* name);
DSOFT_API const char* dSoftWorldGetSoftContactMethod(dSoftWorldID world);

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
    dReal safe_substep;  /**< that the body bears at present [s]: less than `substep` while it is
                              stretched, or after it was taken back */
    dReal energy;        /**< kinetic and elastic at the last look [J]; without the flight of a body
                              that nothing holds */
    dReal energy_due;    /**< the least found lately, and the work done since by contacts, forces,
                              nails and (on a body that is held) gravity [J]. A body whose energy
                              swings beyond it, twice at least and ten times at most, is unstable */
    int rollbacks;       /**< times that it was taken back to the start of a step, since creation */
    int failed_solves;   /**< substeps for which its implicit integrator found no solution */
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
 * world, its bodies or its observers. A body that goes unstable is taken back to the start of ODE's
 * step with all others, and the step is redone at shorter substeps. Nobody sees a moment twice:
 * views go on where they had got to, `dt` since then, with the motion of the new attempt, which may
 * differ from the old by as much as the instability had grown to. Contacts' impulses of the failed
 * attempt reach no rigid body. */
typedef void dSoftSubstepCallback(void* data, const dSoftSubstep* substep);

/** One body that moves in its vibration modes (tier.h) at the end of a substep:
 * x = center + R (X + sum of shape_k amplitude_k), see dSoftBodyGetModalBasis(). Since the view
 * before, which may be as long ago as a step, it has rung undisturbed but for a push at the
 * beginning. Borrowed. */
typedef struct dSoftModalState {
    unsigned struct_size;
    dSoftBodyID body;
    dReal time; /**< [s] since the world's creation */
    dReal dt;   /**< [s] */
    int mode_count;
    const dReal* amplitude; /**< of each mode [kg^1/2 m] */
    const dReal* rate;      /**< its derivative [kg^1/2 m/s] */
    dVector3 center;        /**< of the frame: of a free body the centre of mass [m] */
    dMatrix3 rotation;      /**< from the frame to the world, as ODE stores it */
    dVector3 velocity;      /**< of the centre [m/s] */
    dVector3 spin;          /**< [rad/s] */
} dSoftModalState;
typedef void dSoftModalCallback(void* data, const dSoftModalState* state);

/** Called once a step, after its substeps and before ODE's own step.
 * @param time  at the end of the step [s]. */
typedef void dSoftStepCallback(void* data, dSoftWorldID world, dReal time);

/** Called when a body ends, before anything of it is gone. */
typedef void dSoftBodyEndCallback(void* data, dSoftBodyID body);

/** Called when the world ends, before its bodies do. */
typedef void dSoftWorldEndCallback(void* data, dSoftWorldID world);

struct dSoftRigidPushes;
/** Called before the bodies of a substep are shown, where soft bodies pushed rigid ones in it. */
typedef void dSoftRigidPushesCallback(void* data, const struct dSoftRigidPushes* pushes);

/** A set of callbacks; those left NULL are not called and cost nothing. */
typedef struct dSoftObserver {
    unsigned struct_size;
    void* data; /**< handed to every callback; also the observer's name for removal */
    dSoftSubstepCallback* on_substep;
    dSoftStepCallback* on_step;
    dSoftBodyEndCallback* on_body_end;
    dSoftWorldEndCallback* on_world_end;
    dSoftModalCallback* on_modal; /**< in place of on_substep for bodies in their modes, whose nodes
                                       are then worked out for nobody; NULL: on_substep is called
                                       for all bodies alike */
    dSoftStepCallback* on_moved;  /**< after ODE's own step, before dWorldStep returns: joints still
                                       are those of the step */
    dSoftRigidPushesCallback* on_rigid_pushes; /**< see rigid.h */
} dSoftObserver;

DSOFT_API int dSoftWorldAddObserver(dSoftWorldID world, const dSoftObserver* observer);
DSOFT_API int dSoftWorldAddSubstepObserver(dSoftWorldID world, dSoftSubstepCallback* callback,
                                           void* data);
/** Removes every observer registered with `data`. @return how many. */
DSOFT_API int dSoftWorldRemoveObserver(dSoftWorldID world, void* data);

#ifdef __cplusplus
}
#endif

#include <ode_softbody/rest.h>
#include <ode_softbody/rigid.h>
#include <ode_softbody/threads.h>
#include <ode_softbody/tier.h>

#endif
