#pragma once

#include "dsp/spectra.h"
#include "mix/scene.h"

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

namespace ode::sound::test {

constexpr double kTau = 2.0 * std::numbers::pi;

/// Surface of a body at rest.
struct Shape {
    std::vector<Vec3> node;
    std::vector<int> triangle;
};

/// Sphere of radius 1 round the origin: an icosahedron, each triangle cut in four `level` times.
Shape make_sphere(int level);
/// One flat square of side 1 in the xy plane, normal +z, n by n cells of two triangles.
Shape make_square(int n);

/// Where a body is: x = centre + scale * (rotation about z by `turn`) X.
struct Placement {
    Vec3 centre = Vec3::Zero();
    double scale = 1.0;
    double turn = 0.0;
};
using Motion = std::function<Placement(double time)>;

/// Keeps the frames of one listener, in full scale.
class Recorder final : public Sink {
public:
    bool open(const Format& format) override;
    std::size_t write(std::span<const float> interleaved) noexcept override;
    void close() noexcept override {}
    const char* error() const noexcept override { return ""; }
    const char* kind() const noexcept override { return "recorder"; }
    std::vector<double> ear[2];
};

/// Bodies of prescribed motion in front of one listener; steps of `step` seconds, substeps of `dt`.
class Rig {
public:
    explicit Rig(const Settings& settings = unit_settings(), double dt = 2e-6);

    /// Defaults with a full scale of 1 Pa, so that a recording is in pascals.
    static Settings unit_settings();

    int add(Shape shape, Motion motion); ///< @return its number
    void remove(int body);               ///< the body ends
    void wake(int body, bool awake) { bodies_[static_cast<std::size_t>(body)]->awake = awake; }

    void set_gain(int body, double gain) {
        scene.set_gain(bodies_[static_cast<std::size_t>(body)].get(), gain);
    }

    void run(double seconds);
    void finish() { scene.finish(); }

    /// Called before each step with its beginning [s].
    std::function<void(double time)> before_step;
    double step = 5e-3;

    double time() const noexcept { return time_; }
    int rate() const noexcept { return scene.settings().rate; }
    /// Frames from `begin` to `end` [s] of one ear [Pa].
    std::vector<double> heard(double begin, double end, int ear = 0) const;

    Scene scene;
    Listener* listener;
    std::shared_ptr<Recorder> tape = std::make_shared<Recorder>();
    Recorder& recorder = *tape;

private:
    struct Body {
        Shape shape;
        Motion motion;
        bool awake = true;
        Placement before;
        std::vector<double> position; // stride 4
        std::vector<double> velocity;
    };
    void place(Body& body, double time) const;

    double dt_;
    double time_ = 0.0;
    std::vector<std::unique_ptr<Body>> bodies_;
};

/// A small pulsating sphere as point source: volume flow q(t) = dV/dt with V = 4 pi a^3 s^3 / 3.
/// Amplitude of the displacement of its surface is `stroke` of its radius.
Motion pulsate(double radius, double stroke, double frequency, Vec3 centre = Vec3::Zero());

/// Amplitude of the flow [m^3/s] of pulsate() with this shape (its own volume, not a ball's).
double flow_amplitude(const Shape& shape, double radius, double stroke, double frequency);

inline double decibel(double ratio) { return 20.0 * std::log10(ratio); }

} // namespace ode::sound::test
