#pragma once

#include "softsound/command.h"

namespace softsound {

// One function a demo, in the file of its name.
void add_demo_bowl(CLI::App& demo, Common& common);
void add_demo_chimes(CLI::App& demo, Common& common);

} // namespace softsound
