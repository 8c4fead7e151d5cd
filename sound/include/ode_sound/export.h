#ifndef ODE_SOUND_EXPORT_H
#define ODE_SOUND_EXPORT_H

#include <ode/common.h>

#if defined(__GNUC__)
#define DSOUND_API __attribute__((visibility("default")))
#else
#define DSOUND_API
#endif

#endif
