// softsound bench live [--seconds S] [--load]: latency and gaps of the live path on OpenAL's null
// back end, which keeps a sound card's pace, with the configuration that sound/src/sink/README.md
// documents. --load keeps another thread busy all the time. Ends with 1 when a mark is missed.

#include "sink/openal_sink.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
constexpr int kRate = 48000, kStep = 200; // frames of one step, 4.2 ms
constexpr double kDelay = 0.018;          // accepted ahead [s]

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
    std::vector<float> frames(2 * kStep);
    std::size_t most = 0;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    for (double phase = 0.0; Clock::now() < end;) {
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
    std::printf("| %.0f s%s | 3 x %d | %.1f | %.1f | %lu |\n", seconds,
                load ? ", one core loaded" : "", sink.buffer_frames(), latency,
                1e3 * static_cast<double>(most) / kRate, gaps);
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
    std::printf("| run | queue [frames] | mean latency [ms] | longest [ms] | underruns |\n"
                "|---|---|---|---|---|\n");
    return run(seconds, load);
}
