// softsound bench audio: what the path from substeps to samples does to a sound, in either
// sampling, at three rates, against the marks. Ends with 1 when the default misses one; the source
// paper's own filters are measured beside it and have no marks to meet.

#include "bench/sound/audio_measures.h"
#include "mix/cpu_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace ode::sound::test {
namespace {

bool g_missed = false;

const char* verdict(bool kept, bool judged) {
    g_missed = g_missed || (judged && !kept);
    return kept ? "" : " !";
}

Settings settings_of(Sampling sampling, int rate) {
    Settings s = Rig::unit_settings();
    s.sampling = sampling;
    s.rate = rate;
    return s;
}

void filters(Sampling sampling, int rate, const Substeps& substeps) {
    const Settings s = settings_of(sampling, rate);
    const bool judged = sampling == Sampling::kSinc;
    const double begin = cpu_seconds();
    std::printf("| %s | %d | %s |", std::string(sampling_name(static_cast<int>(sampling))).c_str(),
                rate, substeps.name.c_str());
    double worst = 0.0;
    for (const double f : {1000.0, 10000.0, 20000.0}) {
        const double level = tone(s, substeps, f).level;
        worst = std::max(worst, std::abs(level));
        std::printf(" %+.2f |", level);
    }
    double alias = -300.0, at = 0.0;
    for (const double f : {24500.0, 28100.0, 47000.0, 71000.0, 101000.0, 150000.0})
        if (const double rest = tone(s, substeps, f).rest; rest > alias) {
            alias = rest;
            at = f;
        }
    std::printf(" %.0f dB of %.1f kHz |%s%s %.1f |\n", alias, 1e-3 * at,
                verdict(worst <= 0.5, judged), verdict(alias <= -90.0, judged),
                cpu_seconds() - begin);
    std::fflush(stdout);
}

void motion(Sampling sampling, int rate) {
    const Settings s = settings_of(sampling, rate);
    const bool judged = sampling == Sampling::kSinc;
    std::printf("| %s | %d |", std::string(sampling_name(static_cast<int>(sampling))).c_str(),
                rate);
    for (const double f : {1000.0, 5000.0, 10000.0, 15000.0, 19000.0}) {
        const double rest = distortion(s, f);
        std::printf(" %.0f%s |", rest, verdict(rest <= -90.0, judged));
    }
    const double doppler = doppler_error(s);
    const Arrival arrival = arrival_error(s);
    std::printf(" %.4f %%%s | %+.3f%s | %+.2f%s | %.2f |\n", 100.0 * doppler,
                verdict(doppler <= 1e-3, judged), arrival.samples,
                verdict(std::abs(arrival.samples) <= 1.0, judged), arrival.microseconds,
                verdict(std::abs(arrival.microseconds) <= 10.0, judged), latency(s));
    std::fflush(stdout);
}

void improper(Sampling sampling) {
    const Settings s = settings_of(sampling, 48000);
    std::printf("| %s |", std::string(sampling_name(static_cast<int>(sampling))).c_str());
    for (const Improper what : {Improper::kSourcePassesThroughEar, Improper::kSupersonicSource,
                                Improper::kEarTeleports, Improper::kSourceTeleports}) {
        const double most = loudest(s, what);
        std::printf(" %+.1f%s |", most, verdict(std::isfinite(most), sampling == Sampling::kSinc));
    }
    std::printf("\n");
    std::fflush(stdout);
}

int run(bool brief) {
    std::vector<Substeps> substeps = {
        {"0.6 us", 0.6e-6, 0.0}, {"0.6 us +-40 %", 0.6e-6, 0.4}, {"5 us", 5e-6, 0.0}};
    std::vector<int> rates = {44100, 48000, 96000};
    if (brief) {
        substeps.resize(1);
        rates = {48000};
    }
    std::printf(
        "| sampling | rate | substep | 1 kHz | 10 kHz | 20 kHz [dB, mark 0.5] | worst alias "
        "(mark -90) | CPU s |\n|---|---|---|---|---|---|---|---|\n");
    for (const Sampling sampling : {Sampling::kSinc, Sampling::kPaper})
        for (const int rate : rates)
            for (const Substeps& each : substeps)
                filters(sampling, rate, each);
    std::printf(
        "\nA point at 10 m/s, residual [dB, mark -90]; a tone at +-30 m/s (mark 0.1 %%); "
        "arrival [samples, mark 1]; interaural time [us, mark 10]; latency of the path "
        "[ms]:\n\n| sampling | rate | 1 kHz | 5 kHz | 10 kHz | 15 kHz | 19 kHz | Doppler | "
        "arrival | interaural | latency |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const Sampling sampling : {Sampling::kSinc, Sampling::kPaper})
        for (const int rate : rates)
            motion(sampling, rate);
    std::printf("\nLoudest sample [dB of the source at rest, 1 m away]; must be finite (the first "
                "two push much air):\n\n"
                "| sampling | source through the ear | source at 400 m/s, 1 m past | ear teleports "
                "| source teleports |\n|---|---|---|---|---|\n");
    for (const Sampling sampling : {Sampling::kSinc, Sampling::kPaper})
        improper(sampling);
    std::printf("\n%s\n", g_missed ? "MISSED: see !" : "default: all marks met");
    return g_missed ? 1 : 0;
}

} // namespace
} // namespace ode::sound::test

int main(int argc, char** argv) {
    const bool brief = argc == 2 && std::strcmp(argv[1], "--brief") == 0;
    if (argc > 1 && !brief) {
        const bool help = std::strcmp(argv[1], "--help") == 0;
        std::fprintf(
            help ? stdout : stderr,
            "softsound bench audio [--brief]: prints tables of the path's errors, a minute; "
            "--brief: one rate and substep\n");
        return help ? 0 : 1;
    }
    return ode::sound::test::run(brief);
}
