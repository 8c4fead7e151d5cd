/** @file
 * Soft bodies at rest: what lies still is not stepped. Conventions: softbody.h, which includes
 * this.
 *
 * A body that is disabled keeps its place and shape, costs nothing, is heard by nobody (observers
 * get no substeps of it) and is an obstacle to none: it wakes, together with all that it touches,
 * before something that moves comes within its reach, or when it is pushed, moved, pinned or freed.
 * Like ODE's own bodies it does not notice that a geom without a body, or one that the application
 * disables or destroys, is gone from under it: call dSoftBodyEnable().
 */
#ifndef ODE_SOFTBODY_REST_H
#define ODE_SOFTBODY_REST_H

#include <ode_softbody/softbody.h>

#ifdef __cplusplus
extern "C" {
#endif

DSOFT_API int dSoftBodyEnable(dSoftBodyID body);
/** Stops the body where it is, if it isn't nailed to a rigid body. */
DSOFT_API int dSoftBodyDisable(dSoftBodyID body);
DSOFT_API int dSoftBodyIsEnabled(dSoftBodyID body);

/** Whether the body disables itself when it has come to rest. At first as the ODE world has it
 * (dWorldGetAutoDisableFlag()). Bodies that touch fall asleep together, rigid ones with them; these
 * need ODE's flag too (dBodySetAutoDisableFlag()), or all stay awake. Bodies nailed to a rigid one
 * stay awake. */
DSOFT_API int dSoftBodySetAutoDisableFlag(dSoftBodyID body, int on);
DSOFT_API int dSoftBodyGetAutoDisableFlag(dSoftBodyID body);

/** What counts as rest. Start from dSoftRestDefault(): what it cuts off is below -90 dB of full
 * scale (20 Pa) at a metre from a body of some decimetres. */
typedef struct dSoftRest {
    unsigned struct_size;
    dReal speed;        /**< that no node exceeds [m/s]; default 1e-3 */
    dReal acceleration; /**< that no node exceeds [m/s^2]: tells ringing from creeping; default 0.1.
                             Implicit integrators are judged by speed alone */
    dReal time;         /**< for this long [s]; default 0.25 */
} dSoftRest;
DSOFT_API dSoftRest dSoftRestDefault(void);
DSOFT_API int dSoftBodySetRest(dSoftBodyID body, const dSoftRest* rest);

#ifdef __cplusplus
}
#endif

#endif
