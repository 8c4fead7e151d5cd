/** @file
 * Integrators by name, and what each makes of a vibration. Conventions: softbody.h.
 */
#ifndef ODE_SOFTBODY_INTEGRATOR_H
#define ODE_SOFTBODY_INTEGRATOR_H

#include <ode_softbody/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What is known of an integrator. Start with struct_size = sizeof(dSoftIntegratorInfo). */
typedef struct dSoftIntegratorInfo {
    unsigned struct_size;
    int order;    /**< of convergence; damping by viscosity lowers central difference's to 1 */
    int implicit; /**< 1: solves for the new state */
    int forces;   /**< evaluations of the material a substep; of an implicit one, an iteration */
} dSoftIntegratorInfo;

/** What an integrator makes of a vibration of angular frequency w and damping ratio zeta in a
 * substep h, read off its own code. */
typedef struct dSoftIntegratorResponse {
    unsigned struct_size;
    dReal amplification;      /**< factor on the amplitude a substep; above 1 it is unstable */
    dReal artificial_damping; /**< damping ratio that the integrator adds */
    dReal period_error;       /**< relative, T/T0 - 1; NaN where nothing swings */
} dSoftIntegratorResponse;

/** Name of the i-th integrator, NULL past the last; the first is the default. */
DSOFT_API const char* dSoftIntegratorName(int i);
DSOFT_API int dSoftIntegratorGetInfo(const char* name, dSoftIntegratorInfo* info);
/** @param omega_h       w h [rad], > 0.
 *  @param damping_ratio zeta, >= 0 and finite. */
DSOFT_API int dSoftIntegratorGetResponse(const char* name, dReal omega_h, dReal damping_ratio,
                                         dSoftIntegratorResponse* response);

#ifdef __cplusplus
}
#endif

#endif
