#include "collide/soft_geom.h"
#include "hook/next.h"

#include <ode_softbody/export.h>

// ODE's listing of a space, which this library defines too (see interposed.cpp): without soft
// geoms. Programs that draw or delete what they find in their space know the kinds of geom they
// have put there, and stop at others.

namespace ode::soft {
namespace {

/// Where the last call on this thread left off, so that a loop over a space stays linear.
struct Cursor {
    dSpaceID space = nullptr;
    int in_all = 0; ///< of the space's geoms when the loop began
    int hidden = 0; ///< soft ones of them: counting costs more than a geom
    int shown = -1; ///< index in the listing without soft geoms
    int real = -1;  ///< and in ODE's
};
thread_local Cursor last;

} // namespace
} // namespace ode::soft

using namespace ode::soft;

extern "C" {

DSOFT_API int dSpaceGetNumGeoms(dSpaceID space) {
    static const auto real = next_definition("dSpaceGetNumGeoms", &dSpaceGetNumGeoms);
    return real(space) - soft_geoms_in(space);
}

DSOFT_API dGeomID dSpaceGetGeom(dSpaceID space, int i) {
    static const auto count = next_definition("dSpaceGetNumGeoms", &dSpaceGetNumGeoms);
    static const auto real = next_definition("dSpaceGetGeom", &dSpaceGetGeom);
    const int in_all = count(space);
    if (last.space != space || last.in_all != in_all || i != last.shown + 1)
        last = {space, in_all, soft_geoms_in(space), -1, -1};
    if (last.hidden == 0) {
        last.shown = i;
        return real(space, i);
    }
    if (i < 0 || i >= in_all - last.hidden)
        return real(space, i < 0 ? i : in_all); // refused as ODE refuses
    dGeomID geom = nullptr;
    while (last.shown < i) {
        geom = real(space, ++last.real);
        if (!is_soft_geom(geom))
            ++last.shown;
    }
    return geom;
}

} // extern "C"
