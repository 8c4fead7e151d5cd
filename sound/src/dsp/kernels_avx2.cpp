#define ODE_SOUND_ISA_NAMESPACE avx2
#define ODE_SOUND_ISA_NAME "avx2"
#include "dsp/kernel_bodies.h"
