#include <ode_sound/sound.h>
