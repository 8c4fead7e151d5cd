#include <ode_softbody/softbody.hpp>
