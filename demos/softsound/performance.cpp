#include "softsound/performance.h"

#include "softsound/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace softsound {

using SinkHandle = ode::sound::SinkHandle;

namespace {

/// CPU time of this process, all threads [s].
double cpu_seconds() {
    timespec t = {};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// What the left ear heard [Pa]; sinks hold it relative to full scale.
std::vector<float> left_ear(dSoundSinkID memory, double full_scale) {
    const float* first = nullptr;
    int channels = 0;
    const unsigned long frames = dSoundSinkGetSamples(memory, &first, &channels);
    std::vector<float> out(frames);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = static_cast<float>(full_scale) * first[i * static_cast<std::size_t>(channels)];
    return out;
}

void complain_of(dSoundSinkID sink) {
    if (const std::string error = dSoundSinkGetError(sink); !error.empty())
        throw std::runtime_error(error);
}

} // namespace

Stage make_stage(std::string name, double seconds, double step, std::array<double, 3> ear) {
    Stage stage;
    stage.name = std::move(name);
    stage.seconds = seconds;
    stage.step = step;
    std::copy(ear.begin(), ear.end(), stage.ear);
    return stage;
}

void add_stage(CLI::App& command, Stage& stage) {
    stage.out = stage.name + ".wav";
    stage.plot = stage.name + ".png";
    command.add_option("--out", stage.out, "Sound: 32-bit float WAV, stereo")
        ->type_name("FILE")
        ->capture_default_str();
    command.add_option("--plot", stage.plot, "Picture: waveform over spectrogram ('' for none)")
        ->type_name("FILE")
        ->capture_default_str();
    command.add_flag("--live", stage.live, "Play through OpenAL while simulating");
    command.add_option("--seconds", stage.seconds, "Simulated time [s]")
        ->check(CLI::Range(1e-3, 3600.0))
        ->capture_default_str();
    command
        .add_option("--threads", stage.threads,
                    "Threads that step large bodies, 0: one a core; changes no sample")
        ->check(CLI::Range(0, 64))
        ->capture_default_str();
    command.add_option("--radiation", stage.radiation, "How motion becomes pressure")
        ->check(CLI::IsMember({"monopole", "rayleigh", "paper", "kirchhoff", "transfer"}))
        ->capture_default_str();
    command.add_option("--sampling", stage.sampling, "How waves are sampled")
        ->check(CLI::IsMember({"sinc", "paper"}))
        ->capture_default_str();
    command
        .add_option("--full-scale", stage.full_scale, "Pressure that becomes 1.0 in the file [Pa]")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
}

Performance perform(scenes::World& world, const Stage& stage, bool quiet, const Act& act) {
    // Sinks outlive the sound world, which plays out into them when it ends.
    const SinkHandle file(scenes::made(dSoundSinkCreateFile(stage.out.c_str())));
    const SinkHandle memory(scenes::made(dSoundSinkCreateMemory()));
    const SinkHandle live(stage.live ? scenes::made(dSoundSinkCreateOpenAL()) : nullptr);
    ode::sound::WorldHandle sound(scenes::made(dSoundWorldCreate(world.soft())));
    if (!dSoftWorldSetThreads(world.soft(), stage.threads))
        throw scenes::Refused("no such threads");
    if (!dSoundSetRadiation(sound, stage.radiation.c_str()) ||
        !dSoundSetSampling(sound, stage.sampling.c_str()))
        throw scenes::Refused("no such sound");
    Performance p;
    dSoundSetRate(sound, p.rate);
    dSoundSetFullScale(sound, stage.full_scale);
    const dSoundListenerID ears = scenes::made(dSoundListenerCreate(sound));
    const dVector3 at = {0, 1, 0};
    const dVector3 up = {0, 0, 1};
    dSoundListenerSetPosition(ears, stage.ear[0], stage.ear[1], stage.ear[2]);
    dSoundListenerSetOrientation(ears, at, up);
    for (dSoundSinkID sink : {dSoundSinkID(file), dSoundSinkID(memory), dSoundSinkID(live)})
        if (sink && !dSoundListenerAddSink(ears, sink))
            throw scenes::Refused("no sink");

    if (act.begin)
        act.begin(sound);
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = cpu_seconds();
    const long steps = std::lround(std::ceil(stage.seconds / stage.step - 1e-9));
    {
        Progress progress(stage.name, static_cast<double>(steps), quiet);
        for (long i = 0; i < steps; ++i) {
            if (act.before_step)
                act.before_step(static_cast<double>(i) * stage.step);
            world.step(stage.step);
            if (live) // 0.1 s suits OpenAL Soft's default period
                dSoundSinkPace(live, 0.1);
            progress.at(static_cast<double>(i + 1));
        }
    }
    p.cpu = cpu_seconds() - cpu_start;
    p.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    p.seconds = static_cast<double>(steps) * stage.step;
    p.world.struct_size = sizeof p.world;
    dSoftWorldGetStats(world.soft(), &p.world);
    p.sound.struct_size = sizeof p.sound;
    dSoundGetStats(sound, &p.sound);
    if (act.end)
        act.end();
    if (live)
        p.live_kind = dSoundSinkGetKind(live);
    sound.reset(); // what still travels arrives
    p.left = left_ear(memory, stage.full_scale);
    complain_of(file);
    return p;
}

double sound_pressure_level(double pressure) { return 20 * std::log10(pressure / 20e-6); }

nlohmann::ordered_json as_json(const Performance& p) {
    return {{"seconds", p.seconds},
            {"cpu_seconds", p.cpu},
            {"cpu_seconds_per_second", p.cpu / p.seconds},
            {"wall_seconds", p.wall},
            {"steps", p.world.steps},
            {"substeps", p.world.substeps},
            {"element_steps", p.world.element_steps},
            {"audio_seconds", p.sound.seconds},
            {"audio_share", p.sound.seconds / p.cpu},
            {"frames", p.sound.frames},
            {"peak", p.sound.peak},
            {"peak_db_spl", p.sound.peak > 0
                                ? nlohmann::ordered_json(sound_pressure_level(p.sound.peak))
                                : nlohmann::ordered_json()},
            {"rms", p.sound.rms},
            {"underruns", p.sound.underruns}};
}

} // namespace softsound
