#include <ode_sound/sound.hpp>
