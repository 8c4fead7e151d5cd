/** @file
 * What ODE doesn't tell of its rigid bodies and contacts, for those who observe its steps.
 * Conventions: softbody.h, which includes this.
 */
#ifndef ODE_SOFTBODY_RIGID_H
#define ODE_SOFTBODY_RIGID_H

#include <ode_softbody/softbody.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The soft world that lives in an ODE world, NULL if there is none. */
DSOFT_API dSoftWorldID dSoftWorldFind(dWorldID world);

/** What a contact joint was made of. Start with struct_size = sizeof(dSoftRigidContact). */
typedef struct dSoftRigidContact {
    unsigned struct_size;
    dVector3 position; /**< [m] */
    dVector3 normal;   /**< into the first geom */
    dReal depth;       /**< [m] */
    dGeomID geom[2];
    dReal friction; /**< mu of the surface */
} dSoftRigidContact;
/** Of a live contact joint of the soft world's ODE world.
 * @return 0, without a message, where nobody saw the joint being made: before dSoftWorldCreate(),
 * and under any hook but dSoftHookInterposed. */
DSOFT_API int dSoftWorldGetRigidContact(dSoftWorldID world, dJointID joint,
                                        dSoftRigidContact* contact);

/** What a soft body did to a rigid one at one place in a substep, by contact or where it is nailed
 * to it; the soft body got the opposite. ODE's contact joints know nothing of it. */
typedef struct dSoftRigidPush {
    dBodyID body;
    dSoftBodyID soft;
    dVector3 position; /**< world [m] */
    dVector3 force;    /**< on the rigid body, world [N]: times `dt` its impulse */
    dVector3 center;   /**< of the rigid body then [m] */
    dMatrix3 rotation; /**< of it, as ODE stores it */
} dSoftRigidPush;
/** All of a substep. Rules for steps that are redone: dSoftSubstepCallback. Borrowed. */
typedef struct dSoftRigidPushes {
    unsigned struct_size;
    dSoftWorldID world;
    dReal time; /**< of the substep's end [s] since the world's creation */
    dReal dt;   /**< [s] */
    int count;
    const dSoftRigidPush* push;
} dSoftRigidPushes;

/** Notices the end of a rigid body, which ODE announces to nobody: a geom in no space, of the
 * soft bodies' class, that lasts as long as the body does. */
typedef struct dxSoftRigidWatch* dSoftRigidWatchID;
DSOFT_API dSoftRigidWatchID dSoftRigidWatchCreate(dBodyID body);
DSOFT_API void dSoftRigidWatchDestroy(dSoftRigidWatchID watch);
/** Whether the body has ended: its id is void. */
DSOFT_API int dSoftRigidWatchIsGone(dSoftRigidWatchID watch);

#ifdef __cplusplus
}
#endif

#endif
