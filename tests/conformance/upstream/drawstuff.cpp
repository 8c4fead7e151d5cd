// The loop of drawstuff's interface, without a window: a fixed number of frames, keys from a
// script, clocks that keep the same pace in every run. What was drawn and where the bodies went is
// written to a file when a loop ends.
//
//   CONFORMANCE_FRAMES  frames of each loop; default 300
//   CONFORMANCE_KEYS    "frame:keys" separated by commas: pressed before that frame
//   CONFORMANCE_REPORT  file to write, a line each: "frames", "things", "seen" and "sequence" (see
//                       picture.h), "state" of the bodies after every frame, "energy" [J], the most
//                       that the bodies had in a frame, and "body x y z" of each at last [m]

#include "bodies.h"
#include "picture.h"

#include <drawstuff/drawstuff.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <unistd.h>

namespace ode::conformance {
namespace {

constexpr double kFrame = 1.0 / 60; // [s]

const char* setting(const char* name, const char* otherwise) {
    const char* value = std::getenv(name);
    return value && *value ? value : otherwise;
}

bool stopped = false;
int frames = 0;
Fingerprint state;
double most_energy = -INFINITY;
float view_xyz[3] = {2, 0, 1}, view_hpr[3] = {180, 0, 0};

void report() {
    const char* path = setting("CONFORMANCE_REPORT", nullptr);
    std::FILE* out = path ? std::fopen(path, "w") : nullptr;
    if (!out)
        return;
    const auto hex = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
    std::fprintf(out, "frames %d\nthings %lu\nseen %016llx\nsequence %016llx\nstate %016llx\n",
                 frames, picture().things(), hex(picture().seen()), hex(picture().sequence()),
                 hex(state.value()));
    std::fprintf(out, "energy %.9g\n", most_energy);
    write_bodies(out);
    std::fclose(out);
}

void press_keys(const dsFunctions& demo) {
    const char* entry = setting("CONFORMANCE_KEYS", "");
    while (*entry && demo.command) {
        char* keys = nullptr;
        const long frame = std::strtol(entry, &keys, 10);
        if (*keys == ':')
            ++keys;
        const std::size_t count = std::strcspn(keys, ",");
        for (std::size_t i = 0; i < count && frame == frames; ++i)
            demo.command(keys[i]);
        entry = keys + count + (keys[count] == ',');
    }
}

[[noreturn]] void end(const char* kind, const char* format, va_list arguments) {
    std::fprintf(stderr, "%s: ", kind);
    std::vfprintf(stderr, format, arguments);
    std::fputc('\n', stderr);
    std::exit(1);
}

} // namespace
} // namespace ode::conformance

using namespace ode::conformance;

extern "C" {

void dsSimulationLoop(int, char**, int, int, dsFunctions* demo) {
    const int most = std::atoi(setting("CONFORMANCE_FRAMES", "300"));
    stopped = false;
    if (demo->start)
        demo->start();
    for (int left = most; left > 0 && !stopped; --left, ++frames) {
        press_keys(*demo);
        picture().begin_frame();
        demo->step(0);
        picture().end_frame();
        add_bodies(state);
        const double energy = energy_of_bodies();
        most_energy = energy > most_energy || std::isnan(energy) ? energy : most_energy;
    }
    report();
    if (demo->stop)
        demo->stop();
}

void dsStop() { stopped = true; }
double dsElapsedTime() { return kFrame; }

void dsSetViewpoint(float* xyz, float* hpr) {
    if (xyz)
        std::copy_n(xyz, 3, view_xyz);
    if (hpr)
        std::copy_n(hpr, 3, view_hpr);
}
void dsGetViewpoint(float* xyz, float* hpr) {
    std::copy_n(view_xyz, 3, xyz);
    std::copy_n(view_hpr, 3, hpr);
}

void dsPrint(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    std::vprintf(format, arguments);
    va_end(arguments);
}
void dsError(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    end("error", format, arguments);
}
void dsDebug(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    end("debug", format, arguments);
}

// Demos seed their random numbers from the clock and sleep to keep pace with it.
time_t time(time_t* out) noexcept {
    if (out)
        *out = 0;
    return 0;
}
int usleep(useconds_t) { return 0; }

} // extern "C"
