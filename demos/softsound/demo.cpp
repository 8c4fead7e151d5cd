#include "softsound/demo.h"

#include "softsound/command.h"

namespace softsound {

void add_demo(CLI::App& app, Common& common) {
    CLI::App& demo = *app.add_subcommand("demo", "Run a scene and hear, see and read its result");
    demo.require_subcommand(1);
    add_demo_bowl(demo, common);
}

} // namespace softsound
