/** @file
 * What a body is made of: elasticity, density, and damping in the ways it is told. Conventions:
 * softbody.h.
 */
#ifndef ODE_SOFTBODY_SOLID_H
#define ODE_SOFTBODY_SOLID_H

#include <ode_softbody/export.h>

#ifdef __cplusplus
extern "C" {
#endif

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
    dReal loss_factor;    /**< [-], 0 to 1, the same at all frequencies. Adds to the damping above,
                               and needs modes: see dSoftBodySetModalDamping() */
} dSoftSolid;

DSOFT_API dSoftSolid dSoftSolidDefault(void); /**< steel */
/** Fills in a named material. @return 0 for an unknown name, after listing the known ones. */
DSOFT_API int dSoftSolidPreset(const char* name, dSoftSolid* solid);
/** Name of the i-th preset, NULL past the last. */
DSOFT_API const char* dSoftSolidPresetName(int i);

/* ---- Damping ----------------------------------------------------------------------------- */

/* An amplitude that falls by exp(-d t) has the decay rate d [1/s]. It is told in four ways, of
 * which those with a frequency f [Hz] need it; right for Q above 5 or so. A number that isn't
 * positive gives 0 or infinity, as the formula does. */

/** T60 = ln(1000) / d: time to fall by 60 dB [s]. */
DSOFT_API dReal dSoftT60FromDecay(dReal decay);
DSOFT_API dReal dSoftDecayFromT60(dReal t60);
/** Quality factor Q = pi f / d. */
DSOFT_API dReal dSoftQFromDecay(dReal decay, dReal frequency);
DSOFT_API dReal dSoftDecayFromQ(dReal q, dReal frequency);
/** Loss factor eta = d / (pi f) = 1 / Q. */
DSOFT_API dReal dSoftLossFactorFromDecay(dReal decay, dReal frequency);
DSOFT_API dReal dSoftDecayFromLossFactor(dReal loss_factor, dReal frequency);
/** Of a solid at a frequency: (alpha + beta (2 pi f)^2) / 2 + pi f loss_factor, phi and psi aside.
 */
DSOFT_API dReal dSoftDecayFromSolid(const dSoftSolid* solid, dReal frequency);
/** Sets alpha and beta so that T60 is t1 [s] at f1 [Hz] and t2 at f2.
 * @return 0 after a sentence where no alpha, beta >= 0 do: T60 may not grow with frequency, nor
 * fall faster than its square. */
DSOFT_API int dSoftSolidSetT60(dSoftSolid* solid, dReal f1, dReal t1, dReal f2, dReal t2);

#ifdef __cplusplus
}
#endif

#endif
