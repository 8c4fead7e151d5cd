/** @file
 * The threads that a step may use. Conventions: softbody.h, which includes this.
 *
 * A step works on the thread that calls it, until more are given. Motion and sound are the same,
 * bit for bit, whatever their number and whoever runs them: bodies are moved side by side, and one
 * that is most of the work is cut into parts that depend on its mesh alone. Bodies of less than
 * 2400 linear or 2000 quadratic elements are not cut. Contacts and observers stay on the
 * calling thread.
 */
#ifndef ODE_SOFTBODY_THREADS_H
#define ODE_SOFTBODY_THREADS_H

#include <ode_softbody/softbody.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Gives the world threads of its own. They wait busily for some 50 us between parts of a step,
 * and sleep between steps.
 * @param threads  the caller's included: 1 (default) none besides it, 0 one a core, at most 64. */
DSOFT_API int dSoftWorldSetThreads(dSoftWorldID world, int threads);
/** @return threads of the last dSoftWorldSetThreads(); 0 where the application runs tasks. */
DSOFT_API int dSoftWorldGetThreads(dSoftWorldID world);

/** Work cut into parts: task(context, i) does part i. It doesn't block. */
typedef void dSoftTask(void* context, int index);
/** Has task(context, i) called for 0 <= i < count, in any order, on any threads, or does it at
 * once. Called by the thread that steps. @param data yours. @return what finish is to be given. */
typedef void* dSoftEnqueueTasks(dSoftTask* task, void* context, int count, void* data);
/** Returns when all of them are done; may do some itself. */
typedef void dSoftFinishTasks(void* handle, void* data);

/** Lets the application's own threads do the work: each enqueue is followed by its finish, some
 * times a substep, each with some microseconds of work. Instead of dSoftWorldSetThreads().
 * @param enqueue, finish  both, or NULL and NULL: the stepping thread works alone again. */
DSOFT_API int dSoftWorldSetTaskCallbacks(dSoftWorldID world, dSoftEnqueueTasks* enqueue,
                                         dSoftFinishTasks* finish, void* data);

#ifdef __cplusplus
}
#endif

#endif
