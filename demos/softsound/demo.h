#pragma once

#include "softsound/command.h"

namespace softsound {

// One function a demo, in the file of its name.
void add_demo_bar(CLI::App& demo, Common& common);
void add_demo_bowl(CLI::App& demo, Common& common); ///< bowl, bowl-glass, bowl-wood
void add_demo_chimes(CLI::App& demo, Common& common);
void add_demo_crinkle(CLI::App& demo, Common& common);
void add_demo_dice(CLI::App& demo, Common& common);
void add_demo_marble(CLI::App& demo, Common& common);
void add_demo_pendulum(CLI::App& demo, Common& common);
void add_demo_plate(CLI::App& demo, Common& common); ///< plate-center, plate-off
void add_demo_sheet(CLI::App& demo, Common& common); ///< sheet-stiff, sheet-soft
void add_demo_vibraphone(CLI::App& demo, Common& common);
void add_demo_xylophone(CLI::App& demo, Common& common);

} // namespace softsound
