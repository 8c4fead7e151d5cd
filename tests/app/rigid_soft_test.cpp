// A rigid body that sounds and a soft one meet: through the public functions.
#include "support/rigid_ring.h"
#include "support/soft_app.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <cstdio>
#include <numbers>

namespace {

using namespace ode;
using test::line;
using test::RigidRing;

constexpr double kTau = 2 * std::numbers::pi;
constexpr double kRadius = 0.01, kAt[2] = {0.06, 0.006}, kSpeed = 1; ///< [m], [m/s]

/// The force on rigid bodies, from substep to substep.
struct History {
    struct Moment {
        double middle, dt; ///< [s]
        Eigen::Vector3d force, place;
    };
    std::vector<Moment> moment;
    Eigen::Vector3d impulse = Eigen::Vector3d::Zero();

    static void note(void* data, const dSoftRigidPushes* pushes) {
        auto& self = *static_cast<History*>(data);
        Eigen::Vector3d force = Eigen::Vector3d::Zero(), place = force;
        for (int i = 0; i < pushes->count; ++i) {
            force += Eigen::Vector3d(pushes->push[i].force);
            place = Eigen::Vector3d(pushes->push[i].position);
        }
        self.moment.push_back({pushes->time - 0.5 * pushes->dt, pushes->dt, force, place});
        self.impulse += pushes->dt * force;
    }
    double largest() const {
        double most = 0;
        for (const Moment& own : moment)
            most = std::max(most, own.force.norm());
        return most;
    }
    /// Of the force downwards [N s].
    std::complex<double> spectrum(double f) const {
        std::complex<double> sum = 0;
        for (const Moment& own : moment)
            sum += own.dt * own.force.z() * std::polar(1.0, -kTau * f * own.middle);
        return sum;
    }
};

/// A bar in empty space, and a soft ball that flies at it from above.
struct Meeting : RigidRing {
    History history;
    Bar bar;
    dSoftBodyID ball;

    explicit Meeting(const char* tier = "modal", bool sounds = true) {
        dSoftObserver watch{};
        watch.struct_size = sizeof watch;
        watch.data = &history;
        watch.on_rigid_pushes = &History::note;
        dSoftWorldAddObserver(soft, &watch);
        dSoundListenerSetPosition(ears, 0.3, -0.4, 1);
        bar = add_bar(0, 0, 0);
        if (!sounds)
            dSoundModalDestroy(bar.voice);
        const soft::MeshHandle mesh(dSoftMeshCreateSphere(kRadius, 2));
        dSoftSolid plastic = dSoftSolidDefault();
        plastic.young = 8e8;
        plastic.poisson = 0.4;
        plastic.density = 1100;
        plastic.alpha = 100;
        plastic.beta = 1e-7;
        ball = dSoftBodyCreate(soft, mesh, &plastic);
        dSoftBodySetTier(ball, tier);
        dSoftBodySetPosition(ball, kAt[0], kAt[1], 0.5 * kThick + kRadius + 0.005);
        dSoftBodySetLinearVel(ball, 0, 0, -kSpeed);
    }
    Eigen::Vector3d momentum() const {
        dVector3 linear, angular;
        dSoftBodyGetMomentum(ball, linear, angular);
        dMass mass;
        dBodyGetMass(bar.body, &mass);
        return Eigen::Vector3d(linear) + mass.mass * Eigen::Vector3d(dBodyGetLinearVel(bar.body));
    }
};

class RigidSoft : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Tiers, RigidSoft, testing::Values("modal", "explicit"),
                         [](const auto& given) { return std::string(given.param); });

// Momentum is kept, whoever sounds; and each side's motion is the same bits with a voice and
// without.
TEST_P(RigidSoft, KeepMomentumWithVoicesAndWithout) {
    Meeting with(GetParam()), without(GetParam(), false);
    const Eigen::Vector3d before = with.momentum();
    for (Meeting* own : {&with, &without})
        own->run(0.02, 0.004);
    EXPECT_GT(with.history.impulse.norm(), 1e-3);
    EXPECT_LT((with.momentum() - before).norm(), 1e-6 * before.norm());
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(dBodyGetLinearVel(with.bar.body)[i], dBodyGetLinearVel(without.bar.body)[i]);
        EXPECT_EQ(dBodyGetAngularVel(with.bar.body)[i], dBodyGetAngularVel(without.bar.body)[i]);
    }
    dMass mass;
    dBodyGetMass(with.bar.body, &mass);
    const Eigen::Vector3d got =
        mass.mass * Eigen::Vector3d(dBodyGetLinearVel(with.bar.body)) - with.history.impulse;
    EXPECT_LT(got.norm(), 1e-9 * with.history.impulse.norm()) << "what observers are told";
    EXPECT_EQ(RigidRing::status(with.bar.voice).blows, 0u) << "nothing is made up besides";
}

// Each line is as loud as the force holds of its frequency: against a pulse of known spectrum,
// sin^(3/2), given at the same place to a bar that goes on as the first does.
TEST_P(RigidSoft, SpectrumIsThatOfTheForce) {
    Meeting met(GetParam());
    met.run(0.02, 0.004);
    const dReal *v = dBodyGetLinearVel(met.bar.body), *w = dBodyGetAngularVel(met.bar.body);
    const Eigen::Vector3d velocity(v), spin(w);
    met.run(0.3, 0.004);
    const std::vector<double> p = met.heard();

    RigidRing other;
    dSoundListenerSetPosition(other.ears, 0.3, -0.4, 1);
    const RigidRing::Bar bar = other.add_bar(0, 0, 0);
    other.step(0.004);
    dBodySetLinearVel(bar.body, velocity[0], velocity[1], velocity[2]);
    dBodySetAngularVel(bar.body, spin[0], spin[1], spin[2]);
    constexpr double kTime = 1.2e-4, kPush = 1e-3;
    const Eigen::Vector3d place = met.history.moment[met.history.moment.size() / 2].place;
    const dVector3 at = {place[0], place[1], place[2]}, push = {0, 0, -kPush};
    dSoundModalStrike(bar.voice, at, push, kTime);
    other.run(0.316, 0.004);
    const std::vector<double> q = other.heard();
    double all = 0, part = 0;
    const auto course = [](double u) { return std::pow(std::sin(std::numbers::pi * u), 1.5); };
    const auto pulse = [&](double f) {
        all = part = 0;
        for (int i = 0; i < 4000; ++i) {
            const double u = (i + 0.5) / 4000;
            all += course(u);
            part += course(u) * std::cos(kTau * f * kTime * (u - 0.5));
        }
        return kPush * part / all;
    };
    std::vector<dReal> mode(40), t60(40);
    const int modes = dSoundModalGetModes(bar.voice, 40, mode.data(), t60.data());
    const double when = met.history.moment.front().middle - 0.004; // later than the other
    int judged = 0;
    for (int k = 0; k < modes && k < 40; ++k) {
        const double f = mode[static_cast<std::size_t>(k)];
        const double of = line(q, f, 0.05, 0.1);
        const bool alone = (k == 0 || f - mode[static_cast<std::size_t>(k) - 1] > 80) &&
                           (k + 1 == modes || mode[static_cast<std::size_t>(k) + 1] - f > 80);
        if (f > 15000 || of < 1e-5 || !alone ||
            std::abs(met.history.spectrum(f)) < 0.03 * met.history.impulse.norm())
            continue;
        ++judged;
        const double fell = std::pow(10, -3 * when / t60[static_cast<std::size_t>(k)]);
        const double expected = std::abs(met.history.spectrum(f)) / std::fabs(pulse(f));
        const double found = line(p, f, 0.05, 0.1) / of * fell;
        std::printf("%s %7.1f Hz: force %.4f of the pulse's, heard %.4f, %+.2f dB\n", GetParam(), f,
                    expected, found, 20 * std::log10(found / expected));
        EXPECT_NEAR(found, expected, 0.01 * expected) << f;
    }
    EXPECT_GE(judged, 3);
}

// What is heard of both is the sum: a stroke adds what it adds, once and twice.
TEST(RigidSoftSound, Superposes) {
    std::vector<double> p[3];
    for (int i = 0; i < 3; ++i) {
        Meeting met;
        met.step(0.004);
        const dVector3 at = {-0.05, 0, 0.01}, push = {0, 0, -2e-3 * i};
        if (i > 0)
            dSoundModalStrike(met.bar.voice, at, push, 1e-4);
        met.run(0.08, 0.004);
        p[i] = met.heard();
    }
    double most = 0, off = 0, peak = 0;
    for (std::size_t i = 0; i < p[0].size(); ++i) {
        most = std::max(most, std::fabs(p[1][i] - p[0][i]));
        peak = std::max(peak, std::fabs(p[2][i]));
        off = std::max(off, std::fabs(p[2][i] - 2 * p[1][i] + p[0][i]));
    }
    EXPECT_GT(most, 1e-3);
    EXPECT_LT(off, 3e-6 * peak) << "one bank of floats";
}

// Both ring: a soft bar in its modes falls across a rigid one.
TEST(RigidSoftSound, BothAreHeard) {
    RigidRing app;
    const RigidRing::Bar bar = app.add_bar(0, 0, 0);
    const soft::MeshHandle mesh(dSoftMeshCreateBox(0.02, 0.22, 0.008, 1, 8, 1));
    dSoftSolid metal = RigidRing::metal();
    metal.young = 70e9;
    metal.density = 2700;
    const dSoftBodyID over = dSoftBodyCreate(app.soft, mesh, &metal);
    dSoftBodySetOrder(over, 2);
    dSoftBodySetTier(over, "modal");
    dSoftBodySetPosition(over, 0.09, 0.02, 0.0195);
    dSoftBodySetLinearVel(over, 0, 0, -0.5);
    dReal own[2] = {};
    ASSERT_EQ(dSoftBodyGetModes(over, 2, own), 2);
    app.run(0.25, 0.004);
    const std::vector<double> p = app.heard();
    dReal other = 0;
    dSoundModalGetModes(bar.voice, 1, &other, nullptr);
    for (const double f : {other, own[0]}) {
        const double heard = line(p, f, 0.05, 0.2);
        EXPECT_GT(heard, 1e-5) << f;
        for (const double aside : {0.93, 1.07})
            EXPECT_LT(line(p, aside * f, 0.05, 0.2), 0.05 * heard) << f << " " << aside;
    }
    // The modes got less than the blow took.
    EXPECT_GT(RigidRing::status(bar.voice).energy, 0);
    dMass mass;
    dBodyGetMass(bar.body, &mass);
    const double came = 0.5 * dSoftBodyGetMass(over) * 0.25;
    EXPECT_LT(RigidRing::status(bar.voice).energy, 0.1 * came);
}

// What is nailed to a body drives it by its nails: observers are told all that it gets.
TEST(RigidSoftSound, HearsWhatIsNailedToIt) {
    RigidRing app;
    History history;
    dSoftObserver watch{};
    watch.struct_size = sizeof watch;
    watch.data = &history;
    watch.on_rigid_pushes = &History::note;
    dSoftWorldAddObserver(app.soft, &watch);
    const RigidRing::Bar bar = app.add_bar(0, 0, 0);
    const dSoftBodyID cube = test::add_cube(app.soft, 0.02, 0.5 * RigidRing::kThick + 0.01);
    const int bottom[] = {0, 1, 2};
    ASSERT_EQ(dSoftBodyAttachNodes(cube, bar.body, bottom, 3), 3);
    dSoftBodySetLinearVel(cube, 0, 0, 0.1);
    app.run(0.04, 0.004);
    dMass mass;
    dBodyGetMass(bar.body, &mass);
    const Eigen::Vector3d got = mass.mass * Eigen::Vector3d(dBodyGetLinearVel(bar.body));
    EXPECT_GT(got.norm(), 1e-5);
    EXPECT_LT((got - history.impulse).norm(), 1e-9 * got.norm());
    EXPECT_GT(RigidRing::status(bar.voice).energy, 0);
}

// A soft cube that comes to rest on a bar, and falls asleep there, is not heard to press.
TEST(RigidSoftSound, ALoadThatLastsIsSilent) {
    RigidRing app(-9.81);
    dWorldSetAutoDisableFlag(app.world, 1);
    const RigidRing::Bar bar = app.add_bar(0, 0, -0.5 * RigidRing::kThick);
    dBodySetKinematic(bar.body);
    const soft::MeshHandle mesh(dSoftMeshCreateBox(0.025, 0.025, 0.025, 2, 2, 2));
    dSoftSolid rubber = test::soft_rubber();
    rubber.alpha = 30;
    rubber.beta = 2e-4;
    const dSoftBodyID cube = dSoftBodyCreate(app.soft, mesh, &rubber);
    dSoftBodySetPosition(cube, 0.03, 0, 0.0225);
    double asleep = 0;
    for (int i = 0; i < 1250; ++i) {
        app.step(0.004);
        if (asleep == 0 && !dSoftBodyIsEnabled(cube))
            asleep = 0.004 * i;
    }
    ASSERT_GT(asleep, 0.1) << "it never slept";
    ASSERT_LT(asleep, 4);
    const std::vector<double> p = app.heard();
    double landing = 0, later = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double t = static_cast<double>(i) / RigidRing::kRate;
        (t < 0.2 ? landing : later) =
            std::max(t < 0.2 ? landing : later, t < 0.2 || t > asleep - 0.02 ? std::fabs(p[i]) : 0);
    }
    std::printf("landing %.3g Pa, asleep at %.2f s, from then on %.3g Pa\n", landing, asleep,
                later);
    EXPECT_GT(landing, 1e-4);
    EXPECT_LT(later, 2e-6) << "20 uPa is the threshold of hearing";
    EXPECT_EQ(*std::max_element(p.end() - RigidRing::kRate / 4, p.end()), 0);
}

} // namespace
