// Soft bodies nailed to rigid ones, against closed forms.
#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace ode::soft;
using ode::test::OdeApp;
using Vec3 = Eigen::Vector3d;

constexpr dReal kStep = 1.0 / 500; // [s]

std::string heard;
int messages = 0;
void hear(int, const char* text, va_list arguments) {
    char line[512];
    std::vsnprintf(line, sizeof line, text, arguments);
    heard = line;
    ++messages;
}

/// A bar along x from 0, undamped and without Poisson's effect, and rigid boxes to nail it to.
struct BarApp : OdeApp {
    static constexpr double kLength = 0.5;
    static constexpr double kSide = 0.05;
    static constexpr double kYoung = 1e6;
    static constexpr double kDensity = 1000;
    static constexpr double kMass = kDensity * kLength * kSide * kSide;
    static constexpr int kCells = 20;

    explicit BarApp(dReal gravity_z = 0, double young = kYoung)
        : OdeApp(gravity_z), soft(dSoftWorldCreate(world, space)) {
        dSoftSolid solid = dSoftSolidDefault();
        solid.young = young;
        solid.poisson = 0;
        solid.density = kDensity;
        solid.alpha = solid.beta = solid.phi = solid.psi = 0;
        const MeshHandle mesh(dSoftMeshCreateBar(kLength, kSide, kSide, kCells, 2, 2));
        bar = dSoftBodyCreate(soft, mesh, &solid);
    }

    std::vector<int> nodes_at(double x) const {
        const dReal* first = nullptr;
        int stride = 0;
        const int count = dSoftBodyGetPositions(bar, &first, &stride);
        std::vector<int> found;
        for (int i = 0; i < count; ++i)
            if (std::abs(first[i * stride] - x) < 1e-6)
                found.push_back(i);
        return found;
    }

    dBodyID add_box(double mass, double x) {
        const dBodyID body = dBodyCreate(world);
        dMass m;
        dMassSetBoxTotal(&m, mass, 0.1, 0.12, 0.15);
        dBodySetMass(body, &m);
        dBodySetPosition(body, x, 0, 0);
        dGeomSetBody(dCreateBox(space, 0.1, 0.12, 0.15), body);
        return body;
    }

    int nail(dBodyID body, double x) {
        const std::vector<int> nodes = nodes_at(x);
        return dSoftBodyAttachNodes(bar, body, nodes.data(), static_cast<int>(nodes.size()));
    }

    struct Total {
        Vec3 linear;
        Vec3 angular;
        double energy;
    };
    Total total(const std::vector<dBodyID>& rigid) const {
        dVector3 p, l;
        dSoftBodyGetMomentum(bar, p, l);
        const dSoftEnergy e = dSoftBodyGetEnergy(bar);
        Total sum{Vec3(p[0], p[1], p[2]), Vec3(l[0], l[1], l[2]), e.kinetic + e.elastic};
        for (const dBodyID body : rigid) {
            dMass m;
            dBodyGetMass(body, &m);
            const Vec3 x(dBodyGetPosition(body));
            const Vec3 v(dBodyGetLinearVel(body));
            const Vec3 w(dBodyGetAngularVel(body));
            const dReal* r = dBodyGetRotation(body);
            Eigen::Matrix3d rotation, inertia;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) {
                    rotation(i, j) = r[4 * i + j];
                    inertia(i, j) = m.I[4 * i + j];
                }
            const Vec3 spin = rotation * (inertia * (rotation.transpose() * w));
            sum.linear += m.mass * v;
            sum.angular += x.cross(m.mass * v) + spin;
            sum.energy += (m.mass * v.squaredNorm() + w.dot(spin)) / 2;
        }
        return sum;
    }

    WorldHandle soft;
    dSoftBodyID bar;
};

/// Lowest root of mu x tan x = 1 in (0, pi/2): axial vibration of a bar fixed at one end with mass
/// mu times its own at the other, x = k L (Rao, Mechanical Vibrations, 8.3: alpha tan alpha = m /
/// M).
double axial_root(double mu) {
    double low = 0, high = std::numbers::pi / 2;
    for (int i = 0; i < 100; ++i) {
        const double x = (low + high) / 2;
        (mu * x * std::tan(x) < 1 ? low : high) = x;
    }
    return low;
}

class TipMass : public testing::TestWithParam<double> {};

// The end mass is pulled by a step of force: it swings about the static stretch F L / (E A), once
// in the period of the lowest mode (others are there, the lighter the mass the more).
TEST_P(TipMass, SwingsAtTheClosedFormsPeriod) {
    const double mu = GetParam();
    BarApp app;
    ASSERT_GT(app.nail(nullptr, 0), 0);
    const dBodyID mass = app.add_box(mu * BarApp::kMass, BarApp::kLength);
    ASSERT_EQ(app.nail(mass, BarApp::kLength), 9);
    const double wave = std::sqrt(BarApp::kYoung / BarApp::kDensity);
    const double root = axial_root(mu);
    const double period = 2 * std::numbers::pi * BarApp::kLength / (root * wave);
    const int steps = 200;
    const double h = period / steps;
    const double stretch = 1e-4;
    dBodySetLinearVel(mass, stretch * 2 * std::numbers::pi / period, 0, 0);
    std::vector<double> x;
    constexpr int kPeriods = 12;
    for (int i = 0; i < kPeriods * steps; ++i) {
        dWorldStep(app.world, h);
        x.push_back(dBodyGetPosition(mass)[0] - BarApp::kLength);
    }
    // Frequency of the largest spectral line near the expected one.
    double best = 0, at = 0;
    for (double f = 0.9; f <= 1.1; f += 1e-4) {
        double re = 0, im = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double window =
                0.5 - 0.5 * std::cos(2 * std::numbers::pi * (i + 1) / (x.size() + 1.0));
            const double phase = 2 * std::numbers::pi * f * static_cast<double>(i) / steps;
            re += window * x[i] * std::cos(phase);
            im += window * x[i] * std::sin(phase);
        }
        if (re * re + im * im > best)
            best = re * re + im * im, at = f;
    }
    std::printf("mass ratio %g: period off by %+.3f %%\n", mu, 100 * (1 / at - 1));
    // Linear elements on 20 cells: lumped mass errs by (k dx)^2 / 24 < 0.03 %; the step's sampling
    // by less than the scan's 0.01 %.
    EXPECT_NEAR(at, 1, 1e-3);
}
INSTANTIATE_TEST_SUITE_P(Attach, TipMass, testing::Values(0.1, 1.0, 10.0, 100.0));

class MassRatio : public testing::TestWithParam<double> {};

// Bar and box thrown together, spinning, with nothing else there.
TEST_P(MassRatio, KeepsMomentumAndEnergy) {
    const double ratio = GetParam();
    BarApp app;
    const dBodyID box = app.add_box(ratio * BarApp::kMass, BarApp::kLength + 0.05);
    ASSERT_EQ(app.nail(box, BarApp::kLength), 9);
    dSoftBodySetLinearVel(app.bar, 0.3, 0.1, -0.2);
    dBodySetLinearVel(box, 0.3, 0.6, -0.2);
    dBodySetAngularVel(box, 0.5, -0.3, 2);
    dWorldStep(app.world, kStep); // the nodes' velocities become the box's: a plastic blow
    const BarApp::Total before = app.total({box});
    double low = before.energy, high = before.energy;
    double linear = 0, angular = 0;
    for (int i = 0; i < 500; ++i) {
        dWorldStep(app.world, kStep);
        const BarApp::Total now = app.total({box});
        low = std::min(low, now.energy);
        high = std::max(high, now.energy);
        linear = std::max(linear, (now.linear - before.linear).norm() / before.linear.norm());
        angular = std::max(angular, (now.angular - before.angular).norm() / before.angular.norm());
    }
    std::printf("ratio %g: energy %+.3f .. %+.3f %%, momentum %.1e, angular %.1e\n", ratio,
                100 * (low / before.energy - 1), 100 * (high / before.energy - 1), linear, angular);
    EXPECT_LT(linear, 1e-12);
    // What is owed to the box since the last substep (RigidBond): (spin dt)^2 / 2, and no drift.
    constexpr double kSpin = 3; // [rad/s], more than the box has
    EXPECT_LT(angular, std::pow(kSpin * dSoftBodyGetSubstep(app.bar), 2));
    EXPECT_GT(low, 0.99 * before.energy);
    EXPECT_LT(high, 1.01 * before.energy);
}
INSTANTIATE_TEST_SUITE_P(Attach, MassRatio, testing::Values(1e-3, 1e-2, 1.0, 1e2, 1e3));

// Nodes stay where they were nailed, whatever the box does.
TEST(Attach, NodesKeepTheirPlaceInTheRigidFrame) {
    BarApp app(-9.81);
    const dBodyID box = app.add_box(1, BarApp::kLength + 0.05);
    const std::vector<int> nodes = app.nodes_at(BarApp::kLength);
    ASSERT_EQ(app.nail(box, BarApp::kLength), 9);
    dBodySetAngularVel(box, 1, 2, 3);
    std::vector<Vec3> place;
    const auto places = [&] {
        const dReal* first = nullptr;
        int stride = 0;
        dSoftBodyGetPositions(app.bar, &first, &stride);
        std::vector<Vec3> all;
        for (const int n : nodes) {
            dVector3 local;
            dBodyGetPosRelPoint(box, first[n * stride], first[n * stride + 1],
                                first[n * stride + 2], local);
            all.emplace_back(local[0], local[1], local[2]);
        }
        return all;
    };
    place = places();
    for (int i = 0; i < 200; ++i)
        dWorldStep(app.world, kStep);
    const std::vector<Vec3> now = places();
    for (std::size_t i = 0; i < place.size(); ++i)
        EXPECT_LT((now[i] - place[i]).norm(), 1e-12) << nodes[i];
    EXPECT_GT(std::abs(dBodyGetQuaternion(box)[1]), 0.05) << "the box must turn";
}

// A box at the end of a bar whose other end is held, under a constant force: F L / (E A) in the
// mean.
TEST(Attach, AConstantForceStretchesTheBarByHooke) {
    BarApp app;
    ASSERT_GT(app.nail(nullptr, 0), 0);
    const dBodyID box = app.add_box(0.5, BarApp::kLength);
    ASSERT_EQ(app.nail(box, BarApp::kLength), 9);
    constexpr double kStrain = 1e-4;
    const double force = kStrain * BarApp::kYoung * BarApp::kSide * BarApp::kSide;
    double mean = 0;
    constexpr int kCount = 4000;
    for (int i = 0; i < kCount; ++i) {
        dBodyAddForce(box, force, 0, 0);
        dWorldStep(app.world, kStep);
        const double hann = 1 - std::cos(2 * std::numbers::pi * (i + 0.5) / kCount);
        mean += hann * (dBodyGetPosition(box)[0] - BarApp::kLength) / kCount;
    }
    // It swings about that by as much, so that strain^2 is 1.5 kStrain^2 in the mean; and the
    // material stiffens: strain + 1.5 strain^2 is the force's. Together 2.25 kStrain less than
    // linear.
    const double exact = kStrain * (1 - 2.25 * kStrain) * BarApp::kLength;
    EXPECT_NEAR(mean, exact, 2e-5 * exact);
}

// A stiff bar hinged at the middle line of one end, a box nailed to the other, gravity along it:
// the compound pendulum, T = 2 pi sqrt(I / (m g l)) (1 + amplitude^2 / 16).
TEST(Attach, ABoxOnAHingedBarIsACompoundPendulum) {
    BarApp app(0, 100 * BarApp::kYoung);
    dWorldSetGravity(app.world, 9.81, 0, 0);
    std::vector<int> hinge;
    const dReal* first = nullptr;
    int stride = 0;
    dSoftBodyGetPositions(app.bar, &first, &stride);
    for (const int n : app.nodes_at(0))
        if (std::abs(first[n * stride + 2]) < 1e-9)
            hinge.push_back(n);
    ASSERT_EQ(hinge.size(), 3u);
    constexpr double kBox = 1;
    const double arm = BarApp::kLength + 0.05;
    const dBodyID box = app.add_box(kBox, arm);
    ASSERT_EQ(app.nail(box, BarApp::kLength), 9);
    dSoftBodyPinNodes(app.bar, hinge.data(), 3);

    const double length = BarApp::kLength;
    const double bar = BarApp::kMass;
    const double inertia = bar * (length * length / 3 + BarApp::kSide * BarApp::kSide / 12) +
                           kBox * (arm * arm + (0.1 * 0.1 + 0.15 * 0.15) / 12);
    const double moment = 9.81 * (bar * length / 2 + kBox * arm);
    constexpr double kAmplitude = 0.05; // [rad]
    const double period =
        2 * std::numbers::pi * std::sqrt(inertia / moment) * (1 + kAmplitude * kAmplitude / 16);
    const double spin = kAmplitude * std::sqrt(moment / inertia); // about y: z falls with x
    dSoftBodySetLinearVel(app.bar, 0, 0, -spin * length / 2);
    dSoftBodyAddAngularVel(app.bar, 0, spin, 0);
    dBodySetLinearVel(box, 0, 0, -spin * arm);
    dBodySetAngularVel(box, 0, spin, 0);

    std::vector<double> crossing;
    double before = 0;
    for (int i = 1; crossing.size() < 3 && i < 3000; ++i) {
        dWorldStep(app.world, kStep);
        const double now = dBodyGetPosition(box)[2];
        if ((before > 0) != (now > 0) && i > 1)
            crossing.push_back((i - 1 + before / (before - now)) * kStep);
        before = now;
    }
    ASSERT_EQ(crossing.size(), 3u);
    const double got = crossing[2] - crossing[0];
    std::printf("pendulum: period off by %+.3f %%\n", 100 * (got / period - 1));
    EXPECT_NEAR(got, period, 2e-3 * period);
}

TEST(Attach, TheRigidBodysEndFreesItsNodesWithAMessage) {
    BarApp app(-9.81);
    const dBodyID box = app.add_box(1, BarApp::kLength + 0.05);
    ASSERT_EQ(app.nail(box, BarApp::kLength), 9);
    dWorldStep(app.world, kStep);
    dSetMessageHandler(hear);
    heard.clear();
    messages = 0;
    dBodyDestroy(box);
    for (int i = 0; i < 5; ++i)
        dWorldStep(app.world, kStep);
    dSetMessageHandler(nullptr);
    EXPECT_NE(heard.find("attached"), std::string::npos) << heard;
    EXPECT_EQ(messages, 1);
    EXPECT_EQ(dSoftBodyDetachNodes(app.bar, box), 0);
    dSoftStatus status{};
    status.struct_size = sizeof status;
    dSoftBodyGetStatus(app.bar, &status);
    EXPECT_FALSE(status.stopped);
}

TEST(Attach, DetachedNodesGoTheirOwnWay) {
    BarApp app;
    const dBodyID box = app.add_box(1, BarApp::kLength + 0.05);
    ASSERT_EQ(app.nail(box, BarApp::kLength), 9);
    EXPECT_EQ(dSoftBodyDetachNodes(app.bar, box), 9);
    dBodySetPosition(box, 2, 0, 0); // or they would touch
    dBodySetLinearVel(box, 1, 0, 0);
    for (int i = 0; i < 50; ++i)
        dWorldStep(app.world, kStep);
    dVector3 p, l;
    dSoftBodyGetMomentum(app.bar, p, l);
    EXPECT_NEAR(p[0], 0, 1e-20); // the box carries 1 kg m/s
    EXPECT_DOUBLE_EQ(dBodyGetLinearVel(box)[0], 1);
}

TEST(Attach, ImpossibleRequestsAreRefusedWithASentence) {
    BarApp app;
    const dBodyID box = app.add_box(1, 1);
    dSetMessageHandler(hear);
    const int beyond = 100000;
    heard.clear();
    EXPECT_EQ(dSoftBodyAttachNodes(app.bar, box, &beyond, 1), 0);
    EXPECT_NE(heard.find("100000"), std::string::npos) << heard;
    const dWorldID other = dWorldCreate();
    const dBodyID stranger = dBodyCreate(other);
    const int node = 0;
    heard.clear();
    EXPECT_EQ(dSoftBodyAttachNodes(app.bar, stranger, &node, 1), 0);
    EXPECT_NE(heard.find("another ODE world"), std::string::npos) << heard;
    dWorldDestroy(other);
    EXPECT_EQ(dSoftBodyAttachNodes(app.bar, box, &node, 1), 1);
    heard.clear();
    EXPECT_EQ(dSoftBodySetOrder(app.bar, 2), 0);
    EXPECT_NE(heard.find("attached"), std::string::npos) << heard;
    dSetMessageHandler(nullptr);
}

} // namespace
