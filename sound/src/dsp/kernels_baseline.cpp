#define ODE_SOUND_ISA_NAMESPACE baseline
#define ODE_SOUND_ISA_NAME "baseline"
#include "dsp/kernel_bodies.h"
