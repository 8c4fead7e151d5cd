#ifndef ODE_SOFTBODY_EXPORT_H
#define ODE_SOFTBODY_EXPORT_H

#include <ode/common.h>

#if defined(__GNUC__)
#define DSOFT_API __attribute__((visibility("default")))
#else
#define DSOFT_API
#endif

#endif
