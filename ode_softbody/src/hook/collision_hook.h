#pragma once

#include <ode/common.h>

namespace ode::soft {

/// Whether this thread is inside dSpaceCollide or dSpaceCollide2 of this space or of one that holds
/// it: it is locked then, and ODE aborts when a geom of it comes, goes or moves. Known where calls
/// are interposed; else always false. @param space  NULL: none.
bool is_locked(dSpaceID space) noexcept;

} // namespace ode::soft
