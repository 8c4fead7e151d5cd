/** @file
 * How a soft body's motion is computed: node by node, or in its vibration modes. Conventions:
 * softbody.h, which includes this.
 *
 * In modes a body is a rigid frame with small vibrations in it, each carried over any time by its
 * exact solution. That costs a few microseconds a substep of contact, and nothing between contacts.
 * It is right as far as vibrations are small against the body's thickness. What is heard of it ends
 * at 22 kHz; contact sees its modes up to 77 kHz, and the rest as it yields at rest (residual
 * flexibility). Both tiers move on the same elements with the same masses, so that pitch and decay
 * stay when a body changes tier; momentum is handed over exactly.
 */
#ifndef ODE_SOFTBODY_TIER_H
#define ODE_SOFTBODY_TIER_H

#include <ode_softbody/softbody.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Chooses between:
 * "explicit"  every node, substep by substep, by its integrator: any strain (default)
 * "modal"     modes wherever they can be had: a body of one piece, free or held fast by pins, with
 *             at most 500 modes up to 22 kHz, and nailed to no rigid body; else explicit
 * "cubic"     modes, of which the lowest 36 act on one another as the solid's energy up to the
 *             fourth power of their amplitudes has it, for "stvk" materials; what else moves along
 *             is heard too. A few seconds to find, some microseconds a substep
 * "auto"      the first of modal, cubic and explicit whose waveform is expected within
 *             dSoftBodySetWaveformTolerance() of the explicit one's; the body changes to and from
 *             explicit when it isn't in contact
 * Takes effect with the next step. Modes are found once (fractions of a second to seconds), shared
 * by like bodies and kept, see dSoftGetCacheDirectory().
 * @return 0 for an unknown name, after listing the known ones. */
DSOFT_API int dSoftBodySetTier(dSoftBodyID body, const char* name);
/** The name chosen. */
DSOFT_API const char* dSoftBodyGetTier(dSoftBodyID body);

/** How far "auto" lets the waveform be from the explicit one's.
 * @param relative  L2 error of velocities below 22 kHz, of the first tens of milliseconds of a
 *                  ring; 0.025 by default, 0 < relative <= 1. Below 0.0014 there are no modes.
 * @return 0 for a number that isn't one, with a message. */
DSOFT_API int dSoftBodySetWaveformTolerance(dSoftBodyID body, dReal relative);
DSOFT_API dReal dSoftBodyGetWaveformTolerance(dSoftBodyID body);

/** Start with struct_size = sizeof(dSoftTierStatus). */
typedef struct dSoftTierStatus {
    unsigned struct_size;
    const char* tier; /**< at present: "explicit", "modal", "cubic", or "asleep" (rest.h); static */
    int modes;        /**< that it moves in; 0 in the explicit tier */
    dReal waveform_error; /**< of linear modes, as last estimated, relative; infinite when never */
    int changes;          /**< of tier, since creation */
    dReal cubic_error;    /**< as waveform_error, of the cubic tier */
    int kept;             /**< modes that are kept non-linear; 0 but in the cubic tier */
    dReal cost;           /**< CPU seconds a simulated second at present, contacts left out; an
                               estimate of 20 % or so on a current core */
} dSoftTierStatus;
DSOFT_API int dSoftBodyGetTierStatus(dSoftBodyID body, dSoftTierStatus* status);

/** The modes that a body moves in, by rising frequency; in the cubic tier, among them, shapes that
 * follow products of modes at once and have the frequency of these. Start with struct_size =
 * sizeof(dSoftModalBasis). All is borrowed while the body moves in them, and the same for all
 * bodies that share them. */
typedef struct dSoftModalBasis {
    unsigned struct_size;
    int mode_count;
    int node_count;
    const void* identity; /**< equal for bodies that share their modes */
    const dReal* omega;   /**< of each mode, undamped [rad/s] */
    const dReal* decay;   /**< of its amplitude [1/s] */
    const dReal* rest;    /**< x y z of each node in the frame [m] */
    const float* shape;   /**< mode k at node n along axis a: shape[(3 n + a) * stride + k],
                               mass-normalised [kg^-1/2] */
    int stride;           /**< of shape, in floats */
} dSoftModalBasis;
/** @return 0 while the body is in the explicit tier. */
DSOFT_API int dSoftBodyGetModalBasis(dSoftBodyID body, dSoftModalBasis* basis);

#ifdef __cplusplus
}
#endif

#endif
