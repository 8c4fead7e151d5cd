#define ODE_SOUND_ISA_NAMESPACE avx512
#define ODE_SOUND_ISA_NAME "avx512"
#include "dsp/kernel_bodies.h"
