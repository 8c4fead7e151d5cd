/** @file
 * How surfaces sound that slide and roll on each other, and hold what rings. Included by
 * <ode_sound/sound.h>.
 *
 * A contact joint that bears a load while it goes along a body's surface reads the heights of both
 * surfaces at the speed at which it goes along each: sliding, that of the one that is passed;
 * rolling (spheres, capsules, cylinders), both. Bodies ride over them on Hertz's contact stiffness,
 * and the force that this takes, up to the load and no more, drives the modes of both and jolts
 * them as a whole; friction goes with it as in ODE's joint. Slower than 5 mm/s nothing is heard.
 * Contacts of one pair count as one, at their middle.
 *
 * A contact that bears a load without sliding damps what rings, by the share of a mode's energy
 * that is in its springs (as above, and along the surface where there is friction) times its loss
 * factor: eta phi^2 k w / (2 (w^2 + phi^2 k)), k = (6 E*^2 N R)^(1/3), phi the mode's shape there.
 * The pitch stays.
 */
#ifndef ODE_SOUND_SURFACE_H
#define ODE_SOUND_SURFACE_H

#include <ode_sound/sound.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A geom's surface. Start from dSoundSurfaceDefault(). */
typedef struct dSoundSurface {
    unsigned struct_size;
    dReal roughness;      /**< root mean square of its heights [m], >= 0; default 5e-8 (polished:
                               N1 of ISO 1302; ground metal, polished wood 0.5e-6, planed wood
                               5e-6, stone 2e-5) */
    dReal longest;        /**< wavelength [m]; longer ones are no higher; default 5e-3 */
    dReal shortest;       /**< wavelength [m], > 0 and < longest; default 5e-5. In between power
                               falls with the square of the wave number */
    unsigned seed;        /**< of the random heights; the same gives the same */
    int count;            /**< of `profile`; 0 (default): random */
    const dReal* profile; /**< measured heights [m], `spacing` apart, over and over; copied */
    dReal spacing;        /**< [m], > 0 with a profile */
    dReal loss;           /**< factor of contacts with it, 0 to 1; default 0.1 (a dry joint of
                               metals 0.01 to 0.1, felt and fingers 1) */
} dSoundSurface;
DSOUND_API dSoundSurface dSoundSurfaceDefault(void);
/** @param geom  with or without a voice; NULL: all that nobody has told of. Heard of contacts that
 * begin after. @return 0 for numbers out of range, after a sentence. */
DSOUND_API int dSoundSetGeomSurface(dSoundWorldID world, dGeomID geom,
                                    const dSoundSurface* surface);

#ifdef __cplusplus
}
#endif

#endif
