// softsound bench NAME: runs the benchmark program built beside this one. Benchmarks look inside
// the library, so they are programs of their own that an installation need not have.

#include "softsound/command.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <vector>

namespace softsound {
namespace {

int run_program(const std::string& name, std::vector<std::string> options = {}) {
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    std::string program = (self.parent_path() / ("bench_" + name)).string();
    if (error || access(program.c_str(), X_OK) != 0)
        throw std::runtime_error(program +
                                 " is not there: build it with the tests "
                                 "(cmake --build --preset release --target bench_" +
                                 name + ")");
    std::vector<char*> arguments{program.data()};
    for (std::string& option : options)
        arguments.push_back(option.data());
    arguments.push_back(nullptr);
    execv(program.c_str(), arguments.data());
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
    static bool brief = false;
    static std::string json;
    CLI::App& coupling = *bench.add_subcommand(
        "coupling", "Soft against rigid and soft bodies: impulse, energy, momenta, load, cost; "
                    "two minutes. Ends with 1 when a number is beyond its mark");
    coupling.add_flag("--brief", brief, "One or two of each kind, some seconds");
    coupling.add_option("--json", json, "Write the tables as data, - for the screen")
        ->type_name("FILE");
    coupling.callback([&common] {
        common.action = [] {
            std::vector<std::string> options;
            if (brief)
                options.emplace_back("--brief");
            if (!json.empty())
                options.insert(options.end(), {"--json", json});
            return run_program("coupling", options);
        };
    });
}

} // namespace softsound
