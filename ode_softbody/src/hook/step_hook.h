#pragma once

namespace ode::soft {

class SoftWorld;

/// How a soft world learns that its ODE world is stepped.
enum class Hook { none, interposed, threading };

/// Finds a way, and sees to it that the soft world ends with its ODE world.
/// Says, the first time, what to do when there is none.
void attach_hook(SoftWorld& world);

/// The way in use now; the application may have taken it away.
Hook hook_of(const SoftWorld& world);

/// Whether the soft world has lost its ODE world; it has then ended, its id is void.
bool end_if_orphaned(SoftWorld& world);

} // namespace ode::soft
