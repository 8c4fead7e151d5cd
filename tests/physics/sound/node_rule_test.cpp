// A body sounds alike by its modes and by its nodes: the table against the nodes themselves.
#include "physics/sound/rig.h"
#include "source/node_rule.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <complex>

namespace ode::sound::test {
namespace {

constexpr double kAlwaysHeard = 1e30; ///< level of a mode

constexpr double kStroke = 1e-6; // [m]
const Vec3 kEar(0.7, 0.5, 0.9);

/// A flattened egg, so that no direction is like another.
BoundaryMesh egg() {
    const Shape sphere = make_sphere(2);
    BoundaryMesh mesh;
    for (const Vec3& x : sphere.node)
        mesh.node.emplace_back(0.08 * x.x() * (1.0 + 0.2 * x.z()), 0.06 * x.y(), 0.04 * x.z());
    for (std::size_t t = 0; t + 2 < sphere.triangle.size(); t += 3)
        mesh.triangle.push_back(
            {sphere.triangle[t], sphere.triangle[t + 1], sphere.triangle[t + 2]});
    return mesh;
}

using Field = std::function<Vec3(const Vec3&)>;

struct Heard {
    std::shared_ptr<Recorder> recorder = std::make_shared<Recorder>();
    Scene scene;
    explicit Heard(Radiation radiation) {
        Settings settings = Rig::unit_settings();
        settings.radiation = radiation;
        scene.set(settings);
        Listener& listener = scene.add_listener(0.0);
        listener.pose.centre = kEar;
        listener.pose.ear_distance = 0.0;
        listener.add_sink(recorder);
    }
    /// Of the tone at its end.
    std::complex<double> amplitude(double frequency) const {
        const std::vector<double>& ear = recorder->ear[0];
        const auto periods = static_cast<std::size_t>(0.008 * frequency);
        const auto count = static_cast<std::size_t>(
            std::lround(static_cast<double>(periods) * 48000.0 / frequency));
        std::complex<double> sum = 0.0;
        for (std::size_t i = ear.size() - count; i < ear.size(); ++i)
            sum += ear[i] * std::polar(2.0 / static_cast<double>(count),
                                       -kTau * frequency * static_cast<double>(i) / 48000.0);
        return sum;
    }
};

constexpr double kTime = 0.025;

std::complex<double> by_nodes(Radiation radiation, const Field& field, double frequency) {
    Heard heard(radiation);
    const BoundaryMesh mesh = egg();
    std::vector<int> triangle;
    for (const auto& t : mesh.triangle)
        triangle.insert(triangle.end(), t.begin(), t.end());
    std::vector<double> position(4 * mesh.node.size(), 0.0), velocity(position.size(), 0.0);
    constexpr double kSubstep = 2.5e-6;
    const double w = kTau * frequency;
    for (int i = 1; i * kSubstep < kTime; ++i) {
        const double t = i * kSubstep;
        const double half = t - kSubstep / 2;
        for (std::size_t n = 0; n < mesh.node.size(); ++n) {
            const Vec3 u = kStroke * field(mesh.node[n]);
            for (std::size_t k = 0; k < 3; ++k) {
                const auto axis = static_cast<Eigen::Index>(k);
                position[4 * n + k] = mesh.node[n][axis] + std::sin(w * t) * u[axis];
                velocity[4 * n + k] = w * std::cos(w * half) * u[axis];
            }
        }
        heard.scene.push(&heard, triangle,
                         SurfaceView{t, kSubstep, position.data(), velocity.data(), 4});
        if (i % 400 == 0)
            heard.scene.end_step(t);
    }
    return heard.amplitude(frequency);
}

/// @param whole  moves the body as a whole, instead of the field; null: the field is a mode.
std::complex<double> by_voice(const BoundaryMesh& mesh, Radiation radiation, const Field& field,
                              double frequency, const RigidSound::Six* whole) {
    Heard heard(radiation);
    const Settings& settings = heard.scene.settings();
    const Leaning leaning = radiation_leaning(radiation);
    ModalSurface surface{mesh, {frequency}, {}};
    for (const Vec3& x : surface.mesh.node) {
        const Vec3 u = whole ? Vec3(Vec3::Zero()) : field(x);
        surface.shape.insert(surface.shape.end(), u.data(), u.data() + 3);
    }
    const auto model = std::make_shared<const ModalVoiceModel>(
        ModalVoiceModel{{kTau * frequency},
                        {0.0},
                        node_table(surface, leaning, settings.air, settings.send_rate()),
                        rigid_sound(surface.mesh, Vec3::Zero(), settings.air),
                        {kAlwaysHeard}});
    const int triangle[3] = {0, 0, 0};
    const double step = whole ? 2.5e-6 : 1e-3;
    const double w = kTau * frequency;
    for (int i = 1; i * step < kTime; ++i) {
        const double t = i * step;
        const double q = whole ? 0.0 : kStroke * std::sin(w * t);
        const double v = whole ? 0.0 : kStroke * w * std::cos(w * t);
        ModalView view{t, step, {&q, 1}, {&v, 1}, Vec3::Zero(), Eigen::Matrix3d::Identity()};
        if (whole) {
            view.velocity = kStroke * w * std::cos(w * t) * whole->head<3>();
            view.spin = kStroke * w * std::cos(w * t) * whole->tail<3>();
        }
        heard.scene.push(&heard, triangle, view, [&] { return model; });
        if (whole && i % 400 != 0)
            continue;
        heard.scene.end_step(t);
    }
    return heard.amplitude(frequency);
}

class NodeRule : public testing::TestWithParam<std::tuple<Radiation, double>> {};

TEST_P(NodeRule, HearsModesAsNodesAreHeard) {
    const auto [radiation, frequency] = GetParam();
    const std::array<Field, 3> fields = {
        [](const Vec3& x) { return Vec3(x / 0.05); },
        [](const Vec3& x) { return Vec3(x.x() * x.x() / 0.003, 0.0, x.x() / 0.05); },
        [](const Vec3& x) { return Vec3(std::sin(90.0 * x.y()), 0.3, std::cos(70.0 * x.x())); }};
    // Nodes lean by 1/R where a wave leans by 1/R (1 + 1/ikR): it tells where the rest cancels.
    const double most = radiation == Radiation::kMonopole ? 0.08 : 0.16;
    for (const Field& field : fields) {
        const std::complex<double> nodes = by_nodes(radiation, field, frequency);
        const std::complex<double> voice = by_voice(egg(), radiation, field, frequency, nullptr);
        std::printf("%g Hz: %.3f dB, %.2f degrees\n", frequency, decibel(std::abs(voice / nodes)),
                    360.0 / kTau * std::arg(voice / nodes));
        EXPECT_LT(std::abs(voice - nodes), most * std::abs(nodes));
    }
}

INSTANTIATE_TEST_SUITE_P(Tones, NodeRule,
                         testing::Combine(testing::Values(Radiation::kMonopole,
                                                          Radiation::kKirchhoff),
                                          testing::Values(250.0, 1000.0, 4000.0, 12000.0)));

constexpr double kBall = 0.05; // [m]

BoundaryMesh ball() {
    const Shape sphere = make_sphere(3);
    BoundaryMesh mesh;
    for (const Vec3& x : sphere.node)
        mesh.node.emplace_back(kBall * x);
    for (std::size_t t = 0; t + 2 < sphere.triangle.size(); t += 3)
        mesh.triangle.push_back(
            {sphere.triangle[t], sphere.triangle[t + 1], sphere.triangle[t + 2]});
    return mesh;
}

class WholeBody : public testing::TestWithParam<double> {};

// A shaking sphere, p = i w rho a^3 U cos (1 + ikr) e^{-ik(r-a)} / (r^2 (2 + 2ika - k^2 a^2)).
TEST_P(WholeBody, OfASphereIsTheClosedForm) {
    const double frequency = GetParam();
    const RigidSound::Six way{1, 0, 0, 0, 0, 0};
    const std::complex<double> heard = by_voice(ball(), Radiation::kMonopole, {}, frequency, &way);
    const double w = kTau * frequency, k = w / Air{}.speed, r = kEar.norm(), a = kBall;
    const std::complex<double> i(0.0, 1.0);
    const std::complex<double> expected =
        i * w * Air{}.density * std::pow(a, 3) * kStroke * w * (kEar.x() / r) * (1.0 + i * k * r) *
        std::exp(-i * k * (r - a)) / (r * r * (2.0 + 2.0 * i * k * a - k * k * a * a));
    std::printf("ka %.2f: %.2f dB, %.1f degrees\n", k * a, decibel(std::abs(heard / expected)),
                360.0 / kTau * std::arg(heard / expected));
    EXPECT_NEAR(decibel(std::abs(heard / expected)), 0.0, 0.8);
    // Means over a grid sample lag by half of it.
    const double lag = w / (2.0 * 96000.0);
    EXPECT_NEAR(std::arg(heard / expected * std::polar(1.0, lag)), 0.0, 0.15);
}

// Other shapes are likened to a sphere: right while small, within 6 dB beyond.
TEST_P(WholeBody, OfAnEggIsNearTheNodes) {
    const double frequency = GetParam();
    const RigidSound::Six way{1, 2, 0.5, 0, 0, 0};
    const auto field = [&](const Vec3&) { return Vec3(way.head<3>()); };
    const std::complex<double> nodes = by_nodes(Radiation::kMonopole, field, frequency);
    const std::complex<double> heard = by_voice(egg(), Radiation::kMonopole, {}, frequency, &way);
    std::printf("%g Hz: %.2f dB\n", frequency, decibel(std::abs(heard / nodes)));
    EXPECT_NEAR(decibel(std::abs(heard / nodes)), 0.0, frequency > 1000.0 ? 6.0 : 1.2);
}

INSTANTIATE_TEST_SUITE_P(Tones, WholeBody, testing::Values(250.0, 1000.0, 4000.0, 12000.0));

} // namespace
} // namespace ode::sound::test
