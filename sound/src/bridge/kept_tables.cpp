#include "bridge/kept_tables.h"

#include <ode/error.h>
#include <ode_softbody/softbody.h>

namespace ode::sound {

TableCache kept_tables() {
    const char* directory = dSoftGetCacheDirectory();
    return {directory ? directory : "",
            [](const std::string& sentence) { dMessage(0, "%s", sentence.c_str()); }};
}

} // namespace ode::sound
