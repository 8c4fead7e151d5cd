/** @file
 * Sound of soft bodies: surface vibration -> air pressure -> ears -> sink.
 *
 * Create a sound world over a soft world, a listener, and give the listener a sink. Then step ODE
 * as before. Without a listener nothing is computed.
 *
 * Conventions as in <ode_softbody/softbody.h>. Samples are pressures [Pa], except under the source
 * paper's own rule, whose unit is Pa m per m (see dSoundSetRadiation).
 */
#ifndef ODE_SOUND_SOUND_H
#define ODE_SOUND_SOUND_H

#include <ode_softbody/softbody.h>
#include <ode_sound/export.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dxSoundWorld* dSoundWorldID;
typedef struct dxSoundListener* dSoundListenerID;
typedef struct dxSoundSink* dSoundSinkID;
typedef struct dxSoundModal* dSoundModalID;

/* ---- World ------------------------------------------------------------------------------- */

/** Sound of all bodies of a soft world. Ends with dSoundWorldDestroy(). If the soft world ends
 * first, what still travels is played out and sinks are closed then, and nothing comes after. The
 * same happens at exit() to a world that nobody ended.
 *
 * Latency: frames leave at the end of the step in which they are complete, 2.1 ms (100 frames at
 * 48 kHz) after their own time; up to 6 ms where a body takes substeps of 0.17 to 0.53 ms, longer
 * ones leave images of themselves. Sound from further than 850 m away is lost. */
DSOUND_API dSoundWorldID dSoundWorldCreate(dSoftWorldID world);
/** Plays out what still travels, closes the sinks of all listeners, frees listeners. The sinks
 * themselves stay the caller's: a memory sink keeps its samples. */
DSOUND_API void dSoundWorldDestroy(dSoundWorldID world);

/** How surface motion becomes pressure:
 * "monopole"  accelerations over all faces, rho/(4 pi) sum a dv_n/dt(t - R/c) / R  [Pa] (default),
 *             with the air that a body carries along (its added mass), which makes sound directed.
 *             Flow round the body is solved for when it is first seen: 0.1 s for 300 triangles and
 *             more, once a body; an open surface goes without
 * "kirchhoff" all faces, pressure rho c v_n on the surface, rho/(4 pi) (1 + cos) [Pa]: for bodies
 *             large against the wavelength; a small one that shakes is 20 dB too loud
 * "transfer"  boundary elements, mode by mode, for bodies that are solved by modes [Pa]; others are
 *             heard by "monopole"
 * "rayleigh"  faces that look at the listener, baffled, rho/(2 pi)                 [Pa]; a face
 *             that turns away fades over cos = 0.05 .. -0.05, so that it doesn't click
 * "paper"     P01 equation 10 with its DC block: z v_n a cos(theta) / R            [Pa m]; under
 *             "sinc" sampling the DC block acts once an ear, under "paper" on every triangle
 * Bodies that move in their modes (tier.h) are heard by a table of the rule chosen, "monopole",
 * "kirchhoff" or "transfer", outside the sphere round them; made when one is first heard and kept
 * between runs (dSoftGetCacheDirectory()). Their
 * motion as a whole sounds as a sphere's of the same dipole does. Monopole: within 0.3 dB of a
 * pulsating sphere for ka <= 10, 1.1 dB of a shaking one, 3 dB of a bending bar (softsound bench
 * radiation); nearer than a sixth of a wavelength a shaking body is louder. Under "paper" sampling
 * it carries no air. A change while sound is under way cuts that off.
 * @return 0 for an unknown name, after listing the known ones. */
DSOUND_API int dSoundSetRadiation(dSoundWorldID world, const char* name);

/** How waves are sampled:
 * "sinc"   displacement differences, Kaiser-windowed sinc decimation and fractional delay (default)
 * "paper"  P01 equations 6-9 as written: velocity at every substep, Hann-windowed sinc of
 *          ceil(3/(fmax dt)), Gaussian splat two samples wide. */
DSOUND_API int dSoundSetSampling(dSoundWorldID world, const char* name);

/** What stands between hides: rays through a space of the application's, from groups of each
 * surface's triangles to each ear, 4000 a second of simulated time at most, none where nothing is
 * near the way. What hides or comes clear fades within 20 ms. "rayleigh" and "paper" lose just the
 * hidden triangles; rules that count all faces get quieter by the part that is hidden, since front
 * and back must go on to cancel. Soft bodies hide others, too, but no body itself; what goes round
 * an edge is not heard.
 * Rigid bodies that sound are hidden likewise while they ring, looked for within their mesh's box.
 * @param space          searched with those inside it; NULL: nothing hides (default). Must not end
 *                       before the sound world's listeners unless NULL is set first.
 * @param category_bits  a geom hides when it has one of these. */
DSOUND_API int dSoundSetOcclusion(dSoundWorldID world, dSpaceID space, unsigned long category_bits);

/** Air: density [kg/m^3] and speed of sound [m/s]; defaults 1.21 and 343 (20 C, 1 atm). */
DSOUND_API int dSoundSetAir(dSoundWorldID world, dReal density, dReal speed);

/** How loud a body is: a factor on its pressure, >= 0; default 1, 0 mutes it. Reached without a
 * click in 5 ms. A muted body is not gathered, so that it costs nothing. Ends with the body. */
DSOUND_API int dSoundSetBodyGain(dSoundWorldID world, dSoftBodyID body, dReal gain);
DSOUND_API dReal dSoundGetBodyGain(dSoundWorldID world, dSoftBodyID body);

/** Cost and level since creation. Start with struct_size = sizeof(dSoundStats). */
typedef struct dSoundStats {
    unsigned struct_size;
    unsigned long observed_substeps; /**< substep views looked at; 0 without a listener */
    unsigned long gathers;           /**< of these, surfaces gathered */
    unsigned long frames;            /**< audio frames rendered, all listeners */
    unsigned long underruns;         /**< of live sinks */
    dReal seconds;                   /**< CPU time spent on sound [s] */
    dReal peak;                      /**< largest |sample| at any ear [Pa] */
    dReal rms;                       /**< over all rendered frames and ears [Pa] */
    unsigned long rays;              /**< cast to see what is hidden */
    dReal latency; /**< longest mean time from the path's end to the driver of a live sink [s]; the
                        path's own, 2.1 ms at 48 kHz, comes before */
    unsigned long alarms;            /**< raised, see dSoundSetAlarm() */
    dReal alarm_time;                /**< of the last one [s]; 0: none */
    unsigned long mode_samples;      /**< modes given off, at each sample */
    unsigned long inaudible_samples; /**< modes left out: of soft bodies 20 dB below hearing at
                                          every ear, of rigid ones that ring at 1 m */
} dSoundStats;
DSOUND_API int dSoundGetStats(dSoundWorldID world, dSoundStats* stats);

/** A body has gone unstable; see dSoundSetAlarm(). After the substeps of a step; must not end the
 * body. @param time  when it was noticed [s]. */
typedef void dSoundAlarmCallback(void* data, dSoftBodyID body, dReal time);
/** The instability alarm: raised when what is heard of a body grows as no stable vibration does
 * (each mode of a stable one keeps to a two-term recurrence, and what alternates from substep to
 * substep must not grow; looked for in every substep of 0.15 ms and more, else every 0.15 ms), or
 * when its world takes back a step of it or stops it. Once a body, until it has been quiet for a
 * second. A message says so, dSoundStats counts, and the callback is called; NULL for none. Bodies
 * in their modes can't go unstable; under "paper" sampling nothing is listened for. */
DSOUND_API int dSoundSetAlarm(dSoundWorldID world, dSoundAlarmCallback* callback, void* data);

/* ---- Rigid bodies ------------------------------------------------------------------------- */

/** Gives a rigid body of ODE's its voice: it rings in the vibration modes of a mesh when contact
 * joints strike it. The application goes on as before; of contacts without feedback
 * (dJointSetFeedback) the library takes its own.
 *
 * The mesh's centre of mass lies in the body's position, its axes are the body's. Modes are found
 * once (some seconds for 1000 elements; kept as dSoftGetCacheDirectory() says), and shared
 * by bodies of the same mesh and solid. The mesh and the solid are the caller's, and may go.
 *
 * Contact: ODE's impulse of a step becomes a pulse of the length that Hertz's law gives for both
 * materials and curvatures, at the time within the step that depth and closing speed tell. That
 * time lies in the step before; while there are such bodies all sound therefore leaves one step of
 * ODE's later, not later in itself. Contacts that only bear load are silent until
 * they slide or roll (surface.h). What soft bodies do to it is no joint's: the voice gets that
 * force as it goes from substep to substep. Where joints are not seen being made
 * (dSoftHookThreading) the place is found by asking the geoms again, or from force and torque where
 * they have none.
 *
 * Lives until dSoundModalDestroy(), the sound world's end, or unheard from the body's end on.
 * @return NULL after a sentence: no sound world over a soft world of the body's world, modes can't
 * be had, mesh and body don't fit. */
DSOUND_API dSoundModalID dSoundModalCreate(dBodyID body, dSoftMeshID mesh, const dSoftSolid* solid);
/** What rings is faded out in 5 ms. */
DSOUND_API void dSoundModalDestroy(dSoundModalID modal);
/** NULL once the body has ended. */
DSOUND_API dBodyID dSoundModalGetBody(dSoundModalID modal);
/** Up to `count` frequencies [Hz], ascending, and the time in which each mode falls by 60 dB [s];
 * either may be NULL. @return how many modes there are. */
DSOUND_API int dSoundModalGetModes(dSoundModalID modal, int count, dReal* frequencies, dReal* t60);
/** A factor on the body's pressure, >= 0; default 1. Reached without a click in 5 ms. */
DSOUND_API int dSoundModalSetGain(dSoundModalID modal, dReal gain);
/** Strikes the body beside what ODE's contacts do, which its motion doesn't feel: a hammer that is
 * not there. Takes effect in the next step.
 * @param point    world [m]; the nearest point of the surface is struck.
 * @param impulse  world [N s].
 * @param contact  time that the hammer stays in touch [s], > 0. */
DSOUND_API int dSoundModalStrike(dSoundModalID modal, const dVector3 point, const dVector3 impulse,
                                 dReal contact);

/** Velocity [m/s, world] with which vibration moves the surface next to a point [m, world], at the
 * time that sound has been worked out for: a step ago. */
DSOUND_API int dSoundModalGetVibration(dSoundModalID modal, const dVector3 point,
                                       dVector3 velocity);

/** Start with struct_size = sizeof(dSoundModalStatus). */
typedef struct dSoundModalStatus {
    unsigned struct_size;
    int modes;           /**< that the body has, up to 22 kHz */
    unsigned long blows; /**< heard of contacts so far */
    dReal energy;        /**< of its vibration [J]; 0 without a listener */
    dReal mass;          /**< of the mesh in its material [kg] */
} dSoundModalStatus;
DSOUND_API int dSoundModalGetStatus(dSoundModalID modal, dSoundModalStatus* status);

/** What a geom without a voice is made of, for the time of contact: E and nu count.
 * @param geom  NULL: all that nobody has told of; stone (30 GPa) at first. */
DSOUND_API int dSoundSetGeomSolid(dSoundWorldID world, dGeomID geom, const dSoftSolid* solid);

/* ---- Listener ---------------------------------------------------------------------------- */

/** Two ears 0.2 m apart at the origin, looking along -z with +y up (OpenAL's default). */
DSOUND_API dSoundListenerID dSoundListenerCreate(dSoundWorldID world);
DSOUND_API void dSoundListenerDestroy(dSoundListenerID listener);
/** Midpoint between the ears [m]. May move at any time; the change is spread over the next step. */
DSOUND_API int dSoundListenerSetPosition(dSoundListenerID listener, dReal x, dReal y, dReal z);
/** View and up directions, of any length, not parallel; the ears lie on at x up. */
DSOUND_API int dSoundListenerSetOrientation(dSoundListenerID listener, const dVector3 at,
                                            const dVector3 up);
/** Distance between the ears [m], >= 0; 0 makes both hear the same. */
DSOUND_API int dSoundListenerSetEarDistance(dSoundListenerID listener, dReal distance);

/** One ear, in the middle (a microphone, mono), or two (default). Before its first sink, which gets
 * as many channels. @return 0 for other numbers, or when there are sinks. */
DSOUND_API int dSoundListenerSetEars(dSoundListenerID listener, int ears);

/** What a listener hears, since the last look. Start with struct_size = sizeof(dSoundLevel). */
typedef struct dSoundLevel {
    unsigned struct_size;
    dReal peak[2];    /**< of the left (or only) and right ear, before the limiter [Pa] */
    dReal rms[2];     /**< [Pa] */
    dReal least_gain; /**< by which the limiter held sound down [-]; 1: not at all */
} dSoundLevel;
/** Reads the meters and sets them back: call it as often as they are to be drawn. */
DSOUND_API int dSoundListenerGetLevel(dSoundListenerID listener, dSoundLevel* level);
/** Keeps what sinks get below `ceiling` times full scale, both ears by one gain, with a look-ahead
 * of 1.5 ms that is added to the latency. Meters show what was before. Off by default: files are
 * floats.
 * @param ceiling  above 0, e.g. 0.97; 0 for none. */
DSOUND_API int dSoundListenerSetLimiter(dSoundListenerID listener, dReal ceiling);

/** Sends what the listener hears to a sink, besides those it has. One sink serves one listener. */
DSOUND_API int dSoundListenerAddSink(dSoundListenerID listener, dSoundSinkID sink);
/** Sends what several listeners of one world hear to one sink, side by side: its first channels are
 * the ears of listeners[0], the next those of listeners[1], and so on (two listeners of two ears,
 * or four of one: four channels). Like dSoundListenerAddSink() for each. Limiters delay each their
 * own. A listener that ends is silent, from up to a second later on what the others hear goes on
 * without it.
 * @return 0, and nothing changed, after a message: a listener named twice or of another world, a
 * sink that serves a listener already or doesn't take as many channels (.flac 8, OpenAL 2). */
DSOUND_API int dSoundListenersAddSink(const dSoundListenerID* listeners, int count,
                                      dSoundSinkID sink);
/** Like dSoundListenerAddSink(), in place of those it has. NULL leaves none. */
DSOUND_API int dSoundListenerSetSink(dSoundListenerID listener, dSoundSinkID sink);

/* ---- Sinks ------------------------------------------------------------------------------- */

/** Level that becomes full scale (1.0) in files and on loudspeakers; default 20 Pa (120 dB SPL). */
DSOUND_API int dSoundSetFullScale(dSoundWorldID world, dReal pressure);

/** Sample rate [Hz] of everything rendered after; 8000..192000, default 48000. Before the first
 * listener. */
DSOUND_API int dSoundSetRate(dSoundWorldID world, int rate);

/** Takes samples and forgets them. */
DSOUND_API dSoundSinkID dSoundSinkCreateNull(void);
/** Keeps all samples in memory. */
DSOUND_API dSoundSinkID dSoundSinkCreateMemory(void);
/** Streams to a file named by its ending: .wav (32-bit float, RF64 from 4 GiB on) or .flac (24
 * bit). A path that cannot be written is refused here. A crash loses the last quarter second at
 * most. */
DSOUND_API dSoundSinkID dSoundSinkCreateFile(const char* path);
/** How a file is written. Start from dSoundFileDefault(). */
typedef struct dSoundFile {
    unsigned struct_size;
    int bits; /**< of a sample: 32 (float, .wav only), 24 or 16 (dithered); 0 (default): 32 for
                 .wav, 24 for .flac */
    int note; /**< 1: JSON beside it, of the same name: unit, full scale, rate, events; default 0 */
    unsigned speakers; /**< .wav: which loudspeaker each channel is meant for, as many bits as
                          channels in WAVE_FORMAT_EXTENSIBLE's order (0x33: front left, front right,
                          back left, back right); 0 (default): none, they are microphones. .flac of
                          1 to 8 channels has its own order. */
} dSoundFile;
DSOUND_API dSoundFile dSoundFileDefault(void);
/** dSoundSinkCreateFile() with a choice. */
DSOUND_API dSoundSinkID dSoundSinkCreateFileAs(const char* path, const dSoundFile* file);
/** Notes an event at the frame that the file sink gets next, for the JSON beside it.
 * @return 0 for sinks without a note, after a message. */
DSOUND_API int dSoundSinkMark(dSoundSinkID sink, const char* text);
/** Plays live on OpenAL's default device, in a context of its own, from a thread of its own. A
 * simulation slower than real time is heard with faded gaps (dSoundStats.underruns). A device that
 * is lost is waited for. No device at first: a message, and a null sink instead. */
DSOUND_API dSoundSinkID dSoundSinkCreateOpenAL(void);
/** The same in the OpenAL context that is current where this is called: the application's own, with
 * its device, rate and master gain. One more source is added to it; its current context, its
 * distance model and its error flag are left as they are (a thread of ours uses it through
 * alcSetThreadContext). Destroy the sink before the context. A device that is lost is not waited
 * for. @return NULL without a current context, after a message. */
DSOUND_API dSoundSinkID dSoundSinkCreateOpenALCurrent(void);
/** Plays out and closes. A listener that still has it lets it go. */
DSOUND_API void dSoundSinkDestroy(dSoundSinkID sink);

/** Which kind it is: "null", "memory", "file", "openal". */
DSOUND_API const char* dSoundSinkGetKind(dSoundSinkID sink);
/** Interleaved samples of a memory sink; borrowed until the next step. @return frames. */
DSOUND_API unsigned long dSoundSinkGetSamples(dSoundSinkID sink, const float** first,
                                              int* channels);
/** Frames taken and not yet played: by how much the simulation is ahead of the loudspeaker. A loop
 * faster than real time waits while this is longer than the delay it accepts; beyond 10 s samples
 * are lost. 0 for sinks other than OpenAL. */
DSOUND_API unsigned long dSoundSinkGetBacklog(dSoundSinkID sink);
/** Rate [Hz] that OpenAL's default device runs at, for dSoundSetRate(): sound of another rate is
 * resampled by OpenAL, which is heard. @return 0 without a device, after a message. */
DSOUND_API int dSoundGetDeviceRate(void);
/** Waits until no more than `delay` [s] of sound is ahead of the loudspeaker: for loops that run
 * faster than real time, once a step. At once where the sink has no clock, or the simulation is
 * slower than real time (its gaps are then faded; bodies in their modes are what makes it faster).
 * @return seconds waited. */
DSOUND_API dReal dSoundSinkPace(dSoundSinkID sink, dReal delay);
/** dSoundSinkPace() for all live sinks of a world's listeners, and what the policy asks for. Once a
 * step, between steps. */
DSOUND_API dReal dSoundPace(dSoundWorldID world, dReal delay);
/** What dSoundPace() does about a simulation slower than the loudspeaker:
 * "stretch"       nothing: gaps are faded, sound goes on where it stopped (default); gives bodies
 *                 the tiers back that were taken from them
 * "drop quality"  after an underrun all bodies that sound go to tier "auto"; after another, half a
 *                 second of the world's time later or more, to "modal" (tier.h). What is heard then
 *                 depends on the machine's speed.
 * @return 0 for an unknown name, after listing the known ones. */
DSOUND_API int dSoundSetPacePolicy(dSoundWorldID world, const char* name);
DSOUND_API const char* dSoundGetPacePolicy(dSoundWorldID world);
/** First failure in words the user can act on; "" while healthy. */
DSOUND_API const char* dSoundSinkGetError(dSoundSinkID sink);

#ifdef __cplusplus
}
#endif

#include <ode_sound/surface.h>

#endif
