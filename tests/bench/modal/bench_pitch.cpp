#include "bench/modal/pitch_table.h"

#include <CLI/CLI.hpp>
#include <iostream>

int main(int count, char** argument) {
    CLI::App app("Cents of the first eight partials, by body, element and mesh; a few minutes.");
    CLI11_PARSE(app, count, argument);
    ode::soft::print_pitch_table(std::cout);
}
