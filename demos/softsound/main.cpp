#include "softsound/command.h"

#include "scenes/world.h"

#include <cstdarg>
#include <cstdio>
#include <iostream>

namespace {

// The library's sentences, in the manner of a command-line program.
void say(int, const char* text, va_list arguments) {
    std::fflush(stdout);
    std::fputs("softsound: ", stderr);
    std::vfprintf(stderr, text, arguments);
    std::fputc('\n', stderr);
}

/// ODE for the program's life.
struct Ode {
    Ode() {
        dInitODE2(0);
        dSetMessageHandler(say);
    }
    ~Ode() { dCloseODE(); }
    Ode(const Ode&) = delete;
    Ode& operator=(const Ode&) = delete;
};

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Sounding soft bodies for the Open Dynamics Engine");
    app.set_version_flag("--version", SOFTSOUND_VERSION);
    app.require_subcommand(1);
    softsound::Common common;
    softsound::add_demo(app, common);
    softsound::add_inspect(app, common);
    softsound::add_integrators(app, common);
    softsound::add_modes(app, common);
    softsound::add_strike(app, common);
    softsound::add_bench(app, common);
    CLI11_PARSE(app, argc, argv);

    const Ode ode;
    try {
        return common.action();
    } catch (const scenes::Refused&) {
        return 1; // the library has said why
    } catch (const std::exception& error) {
        std::cerr << "softsound: " << error.what() << '\n';
        return 1;
    }
}
