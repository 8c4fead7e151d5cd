// Rigid bodies that sound: what they err by, and what they cost. Ends with 1 when a mark is missed.
#include "scenes/chimes.h"
#include "support/rigid_ring.h"

#include <algorithm>
#include <complex>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <malloc.h>
#include <numbers>
#include <random>
#include <vector>

namespace {

using namespace ode;
using test::RigidRing;

bool missed = false;

void row(const char* what, const char* figure, const char* mark, bool kept) {
    std::printf("| %s | %s | %s%s |\n", what, figure, mark, kept ? "" : ": missed");
    std::fflush(stdout);
    missed = missed || !kept;
}
template <class... Numbers>
void row(const char* what, const char* mark, bool kept, const char* format, Numbers... numbers) {
    char text[300];
    std::snprintf(text, sizeof text, format, numbers...);
    row(what, text, mark, kept);
}

double cpu() {
    timespec t = {};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Of a frequency, Hann window from `from` for `length` [s].
std::complex<double> line(const std::vector<double>& p, double f, double from, double length) {
    std::complex<double> sum = 0;
    const auto first = static_cast<std::size_t>(from * RigidRing::kRate);
    const auto count = static_cast<std::size_t>(length * RigidRing::kRate);
    for (std::size_t i = 0; i < count && first + i < p.size(); ++i) {
        const double u = static_cast<double>(i) / static_cast<double>(count);
        const double t = static_cast<double>(first + i) / RigidRing::kRate;
        sum += p[first + i] * (1 - std::cos(2 * std::numbers::pi * u)) *
               std::polar(1.0, -2 * std::numbers::pi * f * t);
    }
    return 2.0 * sum / static_cast<double>(count);
}

void chimes() {
    dInitODE2(0);
    {
        scenes::World world;
        scenes::ChimeBodies bodies = scenes::build(world, {});
        const dSoftSolid metal = scenes::chime_metal();
        const sound::WorldHandle sound(dSoundWorldCreate(world.soft()));
        double worst = 0;
        for (const auto& tube : bodies.tube) {
            const dSoundModalID voice = dSoundModalCreate(tube.body, tube.mesh, &metal);
            std::vector<dReal> f(
                static_cast<std::size_t>(dSoundModalGetModes(voice, 0, nullptr, nullptr)));
            dSoundModalGetModes(voice, static_cast<int>(f.size()), f.data(), nullptr);
            const std::vector<double> theory = tube.theory.frequencies(4);
            std::size_t found = 0;
            for (std::size_t k = 0; k + 1 < f.size() && found < 4; ++k)
                if (soft::cents(f[k + 1], f[k]) < 1) // bending modes come in pairs
                    worst = std::max(worst, std::fabs(soft::cents(f[k++], theory[found++])));
        }
        row("six chimes of 524 to 1047 Hz, partials 1 to 4 against Timoshenko's tube, worst",
            "3 cents", worst <= 3, "%.2f cents", worst);
    }
    dCloseODE();
}

/// What is heard of one stroke on a bar in empty space.
std::vector<double> struck(double h, double seconds, std::vector<dReal>& f, std::vector<dReal>& t60,
                           double x = 0.083) {
    RigidRing app;
    const RigidRing::Bar bar = app.add_bar(0, 0, 0);
    f.resize(static_cast<std::size_t>(dSoundModalGetModes(bar.voice, 0, nullptr, nullptr)));
    t60.resize(f.size());
    dSoundModalGetModes(bar.voice, static_cast<int>(f.size()), f.data(), t60.data());
    app.step(h);
    // Hard: what is 20 dB below hearing is left out, up to 20 kHz.
    const dVector3 at = {x, 0.011, 0.01}, blow = {0, 6, -20};
    dSoundModalStrike(bar.voice, at, blow, 3e-5);
    app.run(seconds, h);
    app.sound.reset();
    return app.heard();
}

void frequencies_and_decay() {
    std::vector<dReal> f, t60;
    const std::vector<double> p = struck(0.005, 1.2, f, t60);
    double cents = 0, decay = 0;
    int heard = 0;
    for (std::size_t k = 0; k < f.size() && f[k] < 20000; ++k) {
        const double apart = std::clamp(0.4 * t60[k], 0.02, 0.4), length = 0.6 * apart;
        const double clear = 6 / length; // a Hann window's lobes are 60 dB down there
        const auto a = line(p, f[k], 0.02, length), b = line(p, f[k], 0.02 + apart, length);
        if (std::abs(b) < 2e-4 || (k && f[k] - f[k - 1] < clear) ||
            (k + 1 < f.size() && f[k + 1] - f[k] < clear))
            continue;
        ++heard;
        // Phase and level that a line at f has gained on its way.
        const double turn = std::arg(b / a) / (2 * std::numbers::pi * apart);
        cents = std::max(cents, std::fabs(soft::cents(f[k] + turn, f[k])));
        const double measured = 3 * apart / std::log10(std::abs(a) / std::abs(b));
        decay = std::max(decay, std::fabs(measured / t60[k] - 1));
    }
    row("a struck bar's lines against its modes, worst", "3 cents", cents <= 3 && heard > 5,
        "%.3f cents of %d", cents, heard);
    row("their T60 against the solid's, worst", "5 %", decay <= 0.05, "%.2f %%", 100 * decay);
}

double thrown(double h, double* onset) {
    RigidRing app;
    app.bounce = 0.6;
    dGeomSetPosition(dCreateSphere(app.space, 0.02), 0.07, 0, -0.02 - 0.5 * RigidRing::kThick);
    const RigidRing::Bar bar = app.add_bar(0, 0, 0.0777);
    dBodySetLinearVel(bar.body, 0, 0, -1);
    app.run(0.4, h);
    const std::vector<double> p = app.heard();
    double most = 0;
    for (const double s : p)
        most = std::max(most, std::fabs(s));
    std::size_t first = 0;
    while (std::fabs(p[first]) < 0.1 * most)
        ++first;
    *onset = static_cast<double>(first) / RigidRing::kRate;
    dReal f = 0;
    dSoundModalGetModes(bar.voice, 1, &f, nullptr);
    return 20 * std::log10(std::abs(line(p, f, 0.12, 0.18)));
}

void steps() {
    double onset = 0, other = 0;
    const double level = thrown(0.001, &onset);
    double late = 0, louder = 0;
    for (const double h : {0.005, 0.016}) {
        louder = std::max(louder, std::fabs(thrown(h, &other) - level));
        late = std::max(late, std::fabs(other - onset));
    }
    row("a bar thrown on a ball at steps of 1, 5 and 16 ms: level", "1 dB", louder < 1, "%.2f dB",
        louder);
    row("same, onset", "1 ms", late < 1e-3, "%.3f ms", 1e3 * late);
}

void linearity() {
    const std::vector<double> both = test::two_bars(true, true), a = test::two_bars(true, false),
                              b = test::two_bars(false, true);
    double off = 0, most = 0;
    for (std::size_t i = 0; i < both.size(); ++i) {
        off = std::max(off, std::fabs(both[i] - a[i] - b[i]));
        most = std::max(most, std::fabs(both[i]));
    }
    const double db = 20 * std::log10(off / most);
    row("two bodies less each alone", "-100 dB", db < -100, "%.0f dB", db);
}

void reciprocity() {
    const dVector3 place[2] = {{0.083, 0.011, 0.01}, {-0.031, -0.004, 0.01}}, push = {0, 0, -0.01};
    double moved[2];
    for (int i = 0; i < 2; ++i) {
        RigidRing app;
        const RigidRing::Bar bar = app.add_bar(0, 0, 0);
        app.step(0.005);
        dSoundModalStrike(bar.voice, place[i], push, 1e-4);
        app.run(0.015, 0.005);
        dVector3 v;
        dSoundModalGetVibration(bar.voice, place[1 - i], v);
        moved[i] = v[2];
    }
    const double off = std::fabs(moved[0] / moved[1] - 1);
    row("struck here and felt there, and the other way round", "1e-4", off < 1e-4, "%.1e", off);
}

void energy() {
    // A blow of ODE's: what it leaves in the modes against what the bodies have lost by it.
    double worst = 0;
    for (const double x : {0.0, 0.03, 0.07, 0.095})
        for (const double bounce : {0.1, 0.5, 0.8}) {
            RigidRing app;
            app.bounce = bounce;
            dGeomSetPosition(dCreateSphere(app.space, 0.02), x, 0, -0.03);
            const RigidRing::Bar bar = app.add_bar(0, 0, 0.02);
            dBodySetLinearVel(bar.body, 0, 0, -1);
            const auto kinetic = [&] {
                dMass m;
                dBodyGetMass(bar.body, &m);
                const dReal *v = dBodyGetLinearVel(bar.body), *w = dBodyGetAngularVel(bar.body);
                return 0.5 * m.mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) +
                       0.5 * (m.I[0] * w[0] * w[0] + m.I[5] * w[1] * w[1] + m.I[10] * w[2] * w[2]);
            };
            const double before = kinetic();
            double most = 0;
            for (int i = 0; i < 60; ++i) {
                app.step(0.001);
                most = std::max(most, RigidRing::status(bar.voice).energy);
            }
            worst = std::max(worst, most / (before - kinetic()));
        }
    row("energy in the modes over what the blow took from the bar, twelve blows, largest", "1",
        worst <= 1, "%.2f", worst);
}

struct Crowd {
    double cpu, sound; ///< [s/s]
    int modes;
    unsigned long blows;
    double memory; ///< a body [kB]
    dSoundStats stats;
};

/// Bars let fall into a bin; `heard`: with voices and ears.
Crowd crowd(int bodies, bool heard) {
    Crowd out{};
    RigidRing app(-9.81);
    app.bounce = 0.3;
    if (!heard)
        dSoundListenerDestroy(app.ears);
    dSoundListenerSetEarDistance(heard ? app.ears : dSoundListenerCreate(app.sound), 0.2);
    dCreatePlane(app.space, 0, 0, 1, 0);
    for (int side = 0; side < 4; ++side) {
        const double x = side == 0 ? 1 : side == 1 ? -1 : 0, y = side == 2 ? 1 : side == 3 ? -1 : 0;
        dCreatePlane(app.space, x, y, 0, -0.8);
    }
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-0.6, 0.6), turn(-1, 1);
    const auto in_use = [] { return static_cast<double>(mallinfo2().uordblks); };
    const dSoftSolid steel = RigidRing::metal();
    const double size[3] = {0.35, 0.04, 0.008};
    const soft::MeshHandle mesh(dSoftMeshCreateBox(size[0], size[1], size[2], 8, 1, 1));
    std::vector<dSoundModalID> voice;
    double before = 0;
    for (int i = 0; i < bodies; ++i) {
        const dBodyID body = dBodyCreate(app.world);
        dMass mass;
        dMassSetBox(&mass, steel.density, size[0], size[1], size[2]);
        dBodySetMass(body, &mass);
        dBodySetPosition(body, place(random), place(random), 0.2 + 0.012 * i);
        dQuaternion q = {turn(random), turn(random), turn(random), turn(random)};
        dNormalize4(q);
        dBodySetQuaternion(body, q);
        dGeomSetBody(dCreateBox(app.space, size[0], size[1], size[2]), body);
        if (heard)
            voice.push_back(dSoundModalCreate(body, mesh, &steel));
        if (i == 0) {
            app.step(0.005); // what is shared is made
            before = in_use();
        }
    }
    app.step(0.005);
    out.memory = (in_use() - before) / (bodies - 1) / 1024;
    out.stats.struct_size = sizeof out.stats;
    dSoundGetStats(app.sound, &out.stats); // what is worked out once a model is none of it
    const double start = cpu(), begun = out.stats.seconds;
    constexpr double kSeconds = 3;
    app.run(kSeconds, 0.005);
    out.cpu = (cpu() - start) / kSeconds;
    dSoundGetStats(app.sound, &out.stats);
    out.sound = (out.stats.seconds - begun) / kSeconds;
    for (const dSoundModalID own : voice)
        out.blows += RigidRing::status(own).blows;
    out.modes = heard ? dSoundModalGetModes(voice[0], 0, nullptr, nullptr) : 0;
    return out;
}

void cost() {
    const Crowd silent = crowd(200, false), loud = crowd(200, true);
    std::printf("| 200 bars of %d modes in a bin, 3 s, steps of 5 ms, two ears: ODE alone; sound; "
                "blows | %.1f %% of a core; %.1f %%; %lu | |\n",
                loud.modes, 100 * silent.cpu, 100 * loud.sound, loud.blows);
    const auto rung = static_cast<double>(loud.stats.mode_samples);
    const auto left_out = static_cast<double>(loud.stats.inaudible_samples);
    std::printf("| same, modes left out: 20 dB below hearing at 1 m | %.1f %% | |\n",
                100 * left_out / (rung + left_out));
    row("same, all", "30 % of a core", loud.cpu <= 0.3, "%.1f %%", 100 * loud.cpu);
    std::printf("| memory a body, model shared; ODE's body with it | %.1f kB; %.1f kB | |\n",
                loud.memory - silent.memory, loud.memory);
}

void quiet(int, const char*, va_list) {}

} // namespace

int main(int argc, char** argv) {
    dSetMessageHandler(quiet);
    const struct {
        const char* name;
        void (*run)();
    } part[] = {{"chimes", chimes},
                {"lines", frequencies_and_decay},
                {"steps", steps},
                {"linearity", linearity},
                {"reciprocity", reciprocity},
                {"energy", energy},
                {"cost", cost}};
    std::printf("| what | result | mark |\n|---|---|---|\n");
    // All, or those that are named.
    for (const auto& own : part) {
        bool wanted = argc < 2;
        for (int i = 1; i < argc; ++i)
            wanted = wanted || std::strcmp(argv[i], own.name) == 0;
        if (wanted)
            own.run();
    }
    return missed;
}
