// softsound bench NAME [OPTIONS]: runs the benchmark program built beside this one, with its own
// options. Benchmarks look inside the library, so they are programs of their own that an
// installation need not have.

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

int run_program(const std::string& name, std::vector<std::string> options) {
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    std::string program = (self.parent_path() / ("bench_" + name)).string();
    if (error || access(program.c_str(), X_OK) != 0)
        throw std::runtime_error(program +
                                 " is not there: build it with the tests "
                                 "(cmake --build --preset release --target bench_" +
                                 name + ")");
    std::vector<char*> arguments = {program.data()};
    for (std::string& option : options)
        arguments.push_back(option.data());
    arguments.push_back(nullptr);
    execv(program.c_str(), arguments.data());
    throw std::runtime_error(program + ": " + std::strerror(errno));
}

struct Benchmark {
    const char* name;    ///< as typed
    const char* program; ///< after "bench_"
    const char* what;
};
constexpr Benchmark kBenchmarks[] = {
    {"pitch", "pitch",
     "Cents of the first eight partials, by body, element and mesh; a few minutes"},
    {"coupling", "coupling",
     "Soft against rigid and soft bodies: impulse, energy, momenta, load, cost; two minutes"},
    {"error-vs-time", "error_vs_time",
     "Waveform, pitch and decay error against run time, by integrator, element and step; some "
     "minutes"},
    {"realtime", "realtime", "Run time of the tiers, each with its waveform error; a minute"},
    {"radiation", "radiation",
     "Radiation models in dB against closed forms and finer boundary elements, ka 0.05 to 10; "
     "three "
     "minutes. Ends with 1 when a mark is missed"},
    {"audio", "audio",
     "Response, aliases, distortion, Doppler shift, arrival and latency of the sound path; a "
     "minute. "
     "Ends with 1 when the default misses a mark"},
    {"modal", "modal",
     "Rigid bodies that sound: pitch, decay, steps, energy, reciprocity, cost of 200; a minute. "
     "Ends with 1 when a mark is missed"},
    {"table1", "table1",
     "The source paper's table 1 measured again, on its own terms and on ours; some minutes"},
    {"live", "live",
     "Latency and gaps of live sound on OpenAL's null back end; ten seconds. Ends with 1 when a "
     "mark "
     "is missed"},
    {"stability", "stability",
     "The stress suite: what recovers, what is told, what is refused; two minutes. Ends with 1 "
     "when "
     "a case does not end as asked"},
};

} // namespace

void add_bench(CLI::App& app, Common& common) {
    CLI::App& bench = *app.add_subcommand("bench", "Print a table of error and run time");
    bench.require_subcommand(1);
    for (const Benchmark& b : kBenchmarks) {
        CLI::App* command = bench.add_subcommand(b.name, b.what)->prefix_command();
        command->set_help_flag(); // the program's own
        command->callback([&common, &b, command] {
            common.action = [&b, options = command->remaining()] {
                return run_program(b.program, options);
            };
        });
    }
}

} // namespace softsound
