// softsound bench NAME: runs the benchmark program built beside this one. Benchmarks look inside
// the library, so they are programs of their own that an installation need not have.

#include "softsound/command.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <unistd.h>

namespace softsound {
namespace {

int run_program(const std::string& name) {
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    std::string program = (self.parent_path() / ("bench_" + name)).string();
    if (error || access(program.c_str(), X_OK) != 0)
        throw std::runtime_error(program +
                                 " is not there: build it with the tests "
                                 "(cmake --build --preset release --target bench_" +
                                 name + ")");
    char* const arguments[] = {program.data(), nullptr};
    execv(program.c_str(), arguments);
    throw std::runtime_error(program + ": " + std::strerror(errno));
}

} // namespace

void add_bench(CLI::App& app, Common& common) {
    CLI::App& bench = *app.add_subcommand("bench", "Print a table of error and run time");
    bench.require_subcommand(1);
    bench
        .add_subcommand("pitch", "Cents of the first eight partials, by body, element and mesh; "
                                 "a few minutes")
        ->callback([&common] { common.action = [] { return run_program("pitch"); }; });
    bench
        .add_subcommand("coupling", "Soft against rigid bodies: impulse, energy, path, load; "
                                    "a minute")
        ->callback([&common] { common.action = [] { return run_program("coupling"); }; });
}

} // namespace softsound
