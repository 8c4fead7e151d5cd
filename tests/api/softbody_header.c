#include <ode_softbody/softbody.h>
