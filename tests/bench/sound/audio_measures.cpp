#include "bench/sound/audio_measures.h"

#include <Eigen/Dense>

#include <algorithm>

namespace ode::sound::test {
namespace {

constexpr double kRadius = 2e-4, kStroke = 1e-5, kDistance = 0.5;

double point_source(double frequency) {
    return Air{}.density * kTau * frequency *
           flow_amplitude(make_sphere(1), kRadius, kStroke, frequency) / (2.0 * kTau * kDistance);
}

/// Delay of a tone whose displacement is sin(wt) [s].
double delay_of(const std::vector<double>& out, int rate, double begin, double frequency) {
    const std::complex<double> turn = std::polar(1.0, -kTau * frequency * begin);
    return -std::arg(phasor(out, rate, frequency) * turn / std::complex(0.0, 1.0)) /
           (kTau * frequency);
}

/// A point of flow cos(wt) without volume, sent to the ear in the sampling's own manner.
class FlyingPoint {
public:
    FlyingPoint(const Settings& settings) : settings_(settings), listener_(settings_, 0) {
        listener_.pose.ear_distance = 0.0;
        listener_.add_sink(tape_);
        listener_.begin_step(0.0, 0.0);
    }

    std::vector<double> fly(double start, double speed, double flow, double omega, double seconds) {
        const double rate = settings_.send_rate();
        const auto last = static_cast<std::int64_t>(seconds * rate);
        for (std::int64_t o = 0; o < last; ++o) {
            const double tau = static_cast<double>(o) / rate;
            const double x = speed * tau - start, now = flow * std::cos(omega * tau);
            if (settings_.sampling == Sampling::kPaper) {
                const Air& air = settings_.air;
                const double facet[FacetBlock::kFields] = {
                    air.density * air.speed * now, 1.0, x, 0.0, 0.0, 1.0, 0.0, 0.0};
                listener_.send(FacetBlock{o, 1, facet});
            } else {
                const double flows[4] = {now, 0.0, 0.0, 0.0};
                const double area[16] = {}, softening[4] = {1e-12, 1e-12, 1e-12, 1e-12};
                const double position[16] = {x, 0, 0, 0, x, 0, 0, 0, x, 0, 0, 0, x, 0, 0, 0};
                listener_.send(FlowBlock{o, 4, position, area, softening, flows, nullptr, nullptr,
                                         nullptr, nullptr, 1.0});
            }
            listener_.render(settings_.first_open_frame(tau));
        }
        return tape_->ear[0];
    }

private:
    Settings settings_;
    Listener listener_;
    std::shared_ptr<Recorder> tape_ = std::make_shared<Recorder>();
};

} // namespace

Tone tone(const Settings& settings, const Substeps& substeps, double frequency) {
    Scene scene;
    scene.set(settings);
    Listener& listener = scene.add_listener(0.0);
    const auto tape = std::make_shared<Recorder>();
    listener.add_sink(tape);
    listener.pose.centre = {0.0, 0.0, kDistance};
    listener.pose.ear_distance = 0.0;
    const Shape shape = make_sphere(1);
    std::vector<double> position(4 * shape.node.size(), 0.0), velocity(position);
    double t = 0.0, next_step = 5e-3;
    for (int n = 0; t < 0.1; ++n) {
        // Golden ratio: no period that a filter could like.
        const double wave = 2.0 * std::fmod(0.618034 * n, 1.0) - 1.0;
        const double dt = substeps.mean * (1.0 + substeps.spread * wave);
        t += dt;
        const double swing = kTau * frequency * t;
        const double scale = kRadius * (1.0 + kStroke * std::sin(swing));
        const double speed = kRadius * kStroke * kTau * frequency * std::cos(swing);
        for (std::size_t i = 0; i < shape.node.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                position[4 * i + k] = scale * shape.node[i][static_cast<Eigen::Index>(k)];
                velocity[4 * i + k] = speed * shape.node[i][static_cast<Eigen::Index>(k)];
            }
        scene.push(&shape, shape.triangle, {t, dt, position.data(), velocity.data(), 4});
        if (t >= next_step) {
            scene.end_step(t);
            next_step += 5e-3;
        }
    }
    const auto at = [&](double s) { return static_cast<std::ptrdiff_t>(s * settings.rate); };
    const std::vector<double> out(tape->ear[0].begin() + at(0.02), tape->ear[0].begin() + at(0.09));
    const double expected = point_source(frequency);
    return {decibel(std::abs(phasor(out, settings.rate, frequency)) / expected),
            decibel(band_rms(out, settings.rate, 20.0, 20000.0) * std::numbers::sqrt2 / expected)};
}

double distortion(const Settings& settings, double frequency) {
    const double start = 5.0, speed = 10.0, omega = kTau * frequency;
    const std::vector<double> all = FlyingPoint(settings).fly(start, speed, 1e-3, omega, 0.15);
    const double c = settings.air.speed, mach = speed / c, begin = 0.05;
    const auto at = [&](double s) { return static_cast<std::ptrdiff_t>(s * settings.rate); };
    const std::vector<double> out(all.begin() + at(begin), all.begin() + at(0.14));
    // U(t) = flow / (R (1 - M)) at t = tau + R/c, and its derivative: terms in 1/R to 1/R^3.
    Eigen::MatrixXd basis(static_cast<Eigen::Index>(out.size()), 6);
    for (Eigen::Index i = 0; i < basis.rows(); ++i) {
        const double t = begin + static_cast<double>(i) / settings.rate;
        const double tau = (t - start / c) / (1.0 - mach);
        for (int p = 1; p <= 3; ++p) {
            const double r = std::pow(start - speed * tau, p);
            basis(i, 2 * p - 2) = std::cos(omega * tau) / r;
            basis(i, 2 * p - 1) = std::sin(omega * tau) / r;
        }
    }
    const Eigen::Map<const Eigen::VectorXd> signal(out.data(), basis.rows());
    const Eigen::VectorXd left = signal - basis * basis.householderQr().solve(signal);
    return decibel(band_rms({left.data(), out.size()}, settings.rate, 20.0, 20000.0) /
                   band_rms(out, settings.rate, 20.0, 20000.0));
}

double doppler_error(const Settings& settings) {
    double worst = 0.0;
    for (const double v : {30.0, -30.0}) {
        const double frequency = 2000.0;
        const std::vector<double> all =
            FlyingPoint(settings).fly(v > 0.0 ? 10.0 : 3.0, v, 1e-3, kTau * frequency, 0.25);
        const std::vector<double> out(all.begin() + settings.rate / 20, all.end());
        const double expected = frequency / (1.0 - v / settings.air.speed);
        const double found = Spectrum(out, settings.rate).strongest(1000.0, 3000.0).frequency;
        worst = std::max(worst, std::abs(found / expected - 1.0));
    }
    return worst;
}

Arrival arrival_error(const Settings& settings) {
    const double frequency = 500.0;
    const auto heard = [&](const Vec3& centre, double ears, int ear) {
        Rig rig(settings);
        rig.listener->pose.ear_distance = ears;
        rig.add(make_sphere(1), pulsate(1e-3, 1e-3, frequency, centre));
        rig.run(0.1);
        return delay_of(rig.heard(0.02, 0.09, ear), rig.rate(), 0.02, frequency);
    };
    const double way = heard({0.0, 0.23, 0.0}, 0.0, 0) - 0.23 / settings.air.speed;
    const double ears = heard({0.2, 0.0, 0.0}, 0.2, 0) - heard({0.2, 0.0, 0.0}, 0.2, 1);
    return {way * settings.rate, 1e6 * (ears - 0.2 / settings.air.speed)};
}

double latency(const Settings& settings) {
    double most = 0.0;
    for (double t = 1.0; t < 1.001; t += 1e-6)
        most =
            std::max(most, t - static_cast<double>(settings.first_open_frame(t)) / settings.rate);
    return 1e3 * most;
}

double loudest(const Settings& settings, Improper what) {
    const auto run = [&](bool improper) {
        Rig rig(settings);
        rig.listener->pose.ear_distance = 0.0;
        rig.listener->pose.centre = {0.0, 1.0, 0.0};
        const bool moves = improper && what != Improper::kEarTeleports;
        rig.add(make_sphere(1), [=](double t) {
            Placement at = pulsate(1e-2, 1e-4, 1000.0)(t);
            if (moves && what == Improper::kSourcePassesThroughEar)
                at.centre = {20.0 * (t - 0.1), 1.0, 0.0};
            if (moves && what == Improper::kSupersonicSource)
                at.centre = {400.0 * (t - 0.1), 0.0, 0.0};
            if (moves && what == Improper::kSourceTeleports && t > 0.1)
                at.centre = {0.0, -1.0, 0.0};
            return at;
        });
        rig.before_step = [&](double t) {
            if (improper && what == Improper::kEarTeleports && t > 0.1)
                rig.listener->pose.centre = {0.0, -3.0, 0.0};
        };
        rig.run(0.25);
        double most = 0.0;
        for (const double s : rig.heard(0.04, 0.24))
            most = std::isfinite(s) ? std::max(most, std::abs(s)) : std::nan("");
        return most;
    };
    return decibel(run(true) / run(false));
}

} // namespace ode::sound::test
