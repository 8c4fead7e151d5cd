#pragma once

namespace ode::soft {

/// Whether this thread is inside dSpaceCollide or dSpaceCollide2, whose spaces are locked: ODE
/// aborts when a geom of theirs comes, goes or moves. Known where calls are interposed; else always
/// false.
bool within_collision() noexcept;

} // namespace ode::soft
