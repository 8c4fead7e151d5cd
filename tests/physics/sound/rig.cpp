#include "physics/sound/rig.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

namespace ode::sound::test {

Shape make_sphere(int level) {
    const double g = std::numbers::phi;
    Shape s;
    for (const double a : {-1.0, 1.0})
        for (const double b : {-g, g}) {
            s.node.emplace_back(0.0, a, b);
            s.node.emplace_back(a, b, 0.0);
            s.node.emplace_back(b, 0.0, a);
        }
    for (Vec3& x : s.node)
        x.normalize();
    // Faces: triples at mutual edge distance, turned outward.
    const double edge = 4.0 / (1.0 + g * g) * 1.01; // squared, on the unit sphere
    const auto n = static_cast<int>(s.node.size());
    const auto at = [&](int i) { return s.node[static_cast<std::size_t>(i)]; };
    for (int i = 0; i < n; ++i)
        for (int j = i + 1; j < n; ++j)
            for (int k = j + 1; k < n; ++k) {
                if ((at(i) - at(j)).squaredNorm() > edge || (at(j) - at(k)).squaredNorm() > edge ||
                    (at(k) - at(i)).squaredNorm() > edge)
                    continue;
                const bool out = (at(j) - at(i)).cross(at(k) - at(i)).dot(at(i)) > 0.0;
                s.triangle.insert(s.triangle.end(), {i, out ? j : k, out ? k : j});
            }
    for (; level > 0; --level) {
        std::map<std::pair<int, int>, int> middle;
        const auto cut = [&](int a, int b) {
            const auto key = std::minmax(a, b);
            const auto [it, fresh] = middle.try_emplace(key, static_cast<int>(s.node.size()));
            if (fresh)
                s.node.push_back((at(a) + at(b)).normalized());
            return it->second;
        };
        std::vector<int> finer;
        for (std::size_t t = 0; t < s.triangle.size(); t += 3) {
            const int a = s.triangle[t], b = s.triangle[t + 1], c = s.triangle[t + 2];
            const int ab = cut(a, b), bc = cut(b, c), ca = cut(c, a);
            finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
        }
        s.triangle = std::move(finer);
    }
    return s;
}

Shape make_square(int n) {
    Shape s;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            s.node.emplace_back(static_cast<double>(i) / n - 0.5, static_cast<double>(j) / n - 0.5,
                                0.0);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            s.triangle.insert(s.triangle.end(), {a, b, d, a, d, c});
        }
    return s;
}

bool Recorder::open(const Format& format) { return format.channels == 2; }

std::size_t Recorder::write(std::span<const float> interleaved) noexcept {
    for (std::size_t i = 0; i < interleaved.size(); ++i)
        ear[i % 2].push_back(static_cast<double>(interleaved[i]));
    return interleaved.size() / 2;
}

Settings Rig::unit_settings() {
    Settings settings;
    settings.full_scale = 1.0;
    return settings;
}

Rig::Rig(const Settings& settings, double dt) : dt_(dt) {
    scene.set(settings);
    listener = &scene.add_listener(0.0);
    listener->add_sink(tape);
}

int Rig::add(Shape shape, Motion motion) {
    auto body = std::make_unique<Body>();
    body->position.assign(4 * shape.node.size(), 0.0);
    body->velocity = body->position;
    body->shape = std::move(shape);
    body->motion = std::move(motion);
    place(*body, time_);
    bodies_.push_back(std::move(body));
    return static_cast<int>(bodies_.size()) - 1;
}

void Rig::remove(int body) {
    auto& own = bodies_[static_cast<std::size_t>(body)];
    scene.end_body(own.get());
    own.reset();
}

void Rig::place(Body& body, double time) const {
    const Placement at = body.motion(time);
    const double c = at.scale * std::cos(at.turn), s = at.scale * std::sin(at.turn);
    for (std::size_t i = 0; i < body.shape.node.size(); ++i) {
        const Vec3& x = body.shape.node[i];
        const double now[3] = {at.centre[0] + c * x[0] - s * x[1],
                               at.centre[1] + s * x[0] + c * x[1], at.centre[2] + at.scale * x[2]};
        double velocity[3];
        for (std::size_t k = 0; k < 3; ++k)
            velocity[k] = (now[k] - body.position[4 * i + k]) / dt_;
        constexpr double kTeleport = 5000.0; // [m/s]: no motion, and no velocity
        const bool moved = std::hypot(velocity[0], velocity[1], velocity[2]) < kTeleport;
        for (std::size_t k = 0; k < 3; ++k) {
            if (moved)
                body.velocity[4 * i + k] = velocity[k];
            body.position[4 * i + k] = now[k];
        }
    }
}

void Rig::run(double seconds) {
    const auto steps = std::lround(seconds / step);
    const auto substeps = std::lround(step / dt_);
    for (long n = 0; n < steps; ++n) {
        if (before_step)
            before_step(time_);
        const double begin = time_;
        for (const auto& body : bodies_) {
            if (!body || !body->awake)
                continue;
            place(*body, begin);
            for (long k = 1; k <= substeps; ++k) {
                const double now = begin + static_cast<double>(k) * dt_;
                place(*body, now);
                scene.push(body.get(), body->shape.triangle,
                           {now, dt_, body->position.data(), body->velocity.data(), 4});
            }
        }
        time_ = begin + static_cast<double>(substeps) * dt_;
        scene.end_step(time_);
    }
}

std::vector<double> Rig::heard(double begin, double end, int ear) const {
    const std::vector<double>& all = recorder.ear[ear];
    const auto first = static_cast<std::size_t>(std::lround(begin * rate()));
    const auto last = static_cast<std::size_t>(std::lround(end * rate()));
    std::vector<double> part(last - first, 0.0);
    for (std::size_t i = first; i < std::min(last, all.size()); ++i)
        part[i - first] = all[i];
    return part;
}

Motion pulsate(double radius, double stroke, double frequency, Vec3 centre) {
    return [=](double t) {
        return Placement{centre, radius * (1.0 + stroke * std::sin(kTau * frequency * t)), 0.0};
    };
}

double flow_amplitude(const Shape& shape, double radius, double stroke, double frequency) {
    double volume = 0.0;
    const auto at = [&](std::size_t i) {
        return shape.node[static_cast<std::size_t>(shape.triangle[i])];
    };
    for (std::size_t t = 0; t < shape.triangle.size(); t += 3)
        volume += at(t).dot(at(t + 1).cross(at(t + 2))) / 6.0;
    return 3.0 * volume * radius * radius * radius * stroke * kTau * frequency;
}

} // namespace ode::sound::test
