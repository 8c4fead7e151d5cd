/* Stands in for the config.h that ODE's configure script writes: what ODE's private headers, as the
 * unit tests include them, need to know of a Linux system. */
#ifndef ODE_CONFORMANCE_CONFIG_H
#define ODE_CONFORMANCE_CONFIG_H

#define ODE_PLATFORM_LINUX
#define HAVE_ALLOCA_H 1
#define HAVE_GETTIMEOFDAY 1
#define HAVE_INTTYPES_H 1
#define HAVE_ISNAN 1
#define HAVE_ISNANF 1
#define HAVE_MALLOC_H 1
#define HAVE_STDINT_H 1
#define HAVE_SYS_TIME_H 1
#define HAVE_SYS_TYPES_H 1
#define HAVE_UNISTD_H 1

#include <alloca.h>
#include <inttypes.h>
#include <malloc.h>
#include <stdint.h>

#include "typedefs.h"

#endif
