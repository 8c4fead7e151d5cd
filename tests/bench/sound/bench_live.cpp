// softsound bench live [--seconds S] [--load]: latency and gaps of the live path on OpenAL's null
// back end, which keeps a sound card's pace, with the configuration that sound/src/sink/README.md
// documents. --load keeps another thread busy all the time. Ends with 1 when a mark is missed.
// Beside it a thread of the highest real-time priority on each processor sleeps for a millisecond
// at a time (where that is permitted): what it is late by, that processor itself stood still (a
// virtual one is kept waiting by its host). No program bridges a stand-still longer than its delay.

#include "sink/openal_sink.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sched.h>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
constexpr int kRate = 48000, kStep = 200; // frames of one step, 4.2 ms
constexpr double kDelay = 0.018;          // accepted ahead [s]

struct StandStill {
    std::vector<Clock::time_point> end; ///< of those longer than 10 ms
    double longest = 0;                 ///< [ms]
};

/// Beside everything else, until `over`.
void watch(unsigned processor, const std::atomic<bool>& over, StandStill& found) {
    cpu_set_t here;
    CPU_ZERO(&here);
    CPU_SET(processor, &here);
    sched_setaffinity(0, sizeof here, &here);
    sched_param parameters{};
    parameters.sched_priority = sched_get_priority_max(SCHED_FIFO);
    sched_setscheduler(0, SCHED_FIFO, &parameters);
    for (auto before = Clock::now(); !over;) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const auto now = Clock::now();
        const double late = std::chrono::duration<double, std::milli>(now - before).count() - 1.0;
        if (late > 10.0)
            found.end.push_back(now);
        found.longest = std::max(found.longest, late);
        before = now;
    }
}

int run(double seconds, bool load) {
    const std::string config = "/tmp/ode_sound_live." + std::to_string(getpid());
    std::ofstream(config) << "[general]\nperiod_size = 128\nperiods = 2\ndrivers = null\n";
    setenv("ALSOFT_CONF", config.c_str(), 1);
    setenv("ALSOFT_DRIVERS", "null", 1);
    ode::sound::OpenAlSink sink(ode::sound::OpenAlDevice::open_default());
    std::remove(config.c_str());
    if (!sink.open({kRate, 2})) {
        std::fprintf(stderr, "%s\n", sink.error());
        return 1;
    }
    std::atomic<bool> over{false};
    std::atomic<unsigned> work{0};
    std::thread busy([&] {
        while (load && !over)
            ++work;
    });
    const unsigned processors = std::max(std::thread::hardware_concurrency(), 1U);
    std::vector<StandStill> still(processors);
    std::vector<std::thread> watching;
    for (unsigned i = 0; i < processors; ++i)
        watching.emplace_back([&, i] { watch(i, over, still[i]); });
    std::vector<float> frames(2 * kStep);
    std::size_t most = 0;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    std::vector<Clock::time_point> underrun; // when seen
    for (double phase = 0.0; Clock::now() < end;) {
        while (underrun.size() < sink.underruns())
            underrun.push_back(Clock::now());
        for (float& f : frames)
            f = 0.1F * static_cast<float>(std::sin(phase += 0.05));
        sink.write(frames);
        most = std::max(most, sink.backlog());
        while (static_cast<double>(sink.backlog()) > kDelay * kRate)
            std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    const double latency = 1e3 * sink.latency();
    const unsigned long gaps = sink.underruns();
    over = true;
    busy.join();
    StandStill all;
    for (unsigned i = 0; i < processors; ++i) {
        watching[i].join();
        all.end.insert(all.end.end(), still[i].end.begin(), still[i].end.end());
        all.longest = std::max(all.longest, still[i].longest);
    }
    const auto of_machine = std::ranges::count_if(underrun, [&](auto when) {
        return std::ranges::any_of(all.end, [&](auto end_of) {
            return std::chrono::abs(when - end_of) < std::chrono::milliseconds(30);
        });
    });
    std::printf("| %.0f s%s | %zu | %.1f | %.1f | %lu, %ld | %zu, %.1f |\n", seconds,
                load ? ", one core loaded" : "", sink.period(), latency,
                1e3 * static_cast<double>(most) / kRate, gaps, of_machine, all.end.size(),
                all.longest);
    const bool kept = latency <= 20.0 && gaps == 0;
    std::printf("\nmarks: mean latency <= 20 ms, no underrun%s\n", kept ? "" : ": MISSED");
    sink.close();
    return kept ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    double seconds = 10.0;
    bool load = false;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--load") == 0) {
            load = true;
        } else if (std::strcmp(argv[i], "--seconds") == 0 && i + 1 < argc) {
            seconds = std::atof(argv[++i]);
        } else {
            const bool help = std::strcmp(argv[i], "--help") == 0;
            std::fprintf(help ? stdout : stderr, "softsound bench live [--seconds S] [--load]\n");
            return help ? 0 : 1;
        }
    }
    std::printf(
        "| run | period [frames] | mean latency [ms] | longest [ms] | underruns, of these at "
        "a stand-still | stand-stills > 10 ms, longest [ms] |\n|---|---|---|---|---|---|\n");
    return run(seconds, load);
}
