#include "softsound/demo.h"

#include "softsound/command.h"

#include <string>

namespace softsound {

void add_demo(CLI::App& app, Common& common) {
    CLI::App& demo = *app.add_subcommand("demo", "Run a scene and hear, see and read its result");
    add_demo_bowl(demo, common);
    add_demo_chimes(demo, common);
    add_demo_xylophone(demo, common);
    add_demo_dice(demo, common);
    add_demo_marble(demo, common);
    add_demo_bar(demo, common);
    add_demo_plate(demo, common);
    add_demo_vibraphone(demo, common);
    add_demo_pendulum(demo, common);
    add_demo_sheet(demo, common);
    add_demo_crinkle(demo, common);
    // The parser's own complaint would not name what was typed, nor what there is.
    demo.allow_extras();
    demo.callback([&demo] {
        if (!demo.get_subcommands().empty())
            return;
        std::string known;
        for (const CLI::App* scene : demo.get_subcommands([](const CLI::App*) { return true; }))
            known += " " + scene->get_name();
        const auto typed = demo.remaining();
        throw CLI::ValidationError(
            "demo", (typed.empty() ? "name a scene" : "no scene '" + typed[0] + "'") +
                        "; there are:" + known);
    });
}

} // namespace softsound
