#include "support/thrown_shapes.h"

#include "support/ode_app.h"

#include "mesh/generate.h"
#include "world/soft_world.h"

#include <cmath>
#include <ctime>
#include <memory>
#include <random>

namespace ode::test {
namespace {

using namespace ode::soft;

constexpr double kStep = 4e-3;  ///< of ODE [s]
constexpr double kMass = 0.3;   ///< [kg]
constexpr double kSpeed = 1;    ///< [m/s]
constexpr double kReach = 0.05; ///< of the shapes at most [m]

Vec3 vec(const dReal* v) { return {v[0], v[1], v[2]}; }

dBodyID make_shape(Shape shape, OdeApp& app) {
    const dBodyID body = dBodyCreate(app.world);
    dMass mass;
    dGeomID geom = nullptr;
    switch (shape) {
    case Shape::sphere:
        dMassSetSphereTotal(&mass, kMass, 0.025);
        geom = dCreateSphere(app.space, 0.025);
        break;
    case Shape::box:
        dMassSetBoxTotal(&mass, kMass, 0.06, 0.04, 0.03);
        geom = dCreateBox(app.space, 0.06, 0.04, 0.03);
        break;
    case Shape::capsule:
        dMassSetCapsuleTotal(&mass, kMass, 3, 0.015, 0.05);
        geom = dCreateCapsule(app.space, 0.015, 0.05);
        break;
    case Shape::cylinder:
        dMassSetCylinderTotal(&mass, kMass, 3, 0.02, 0.05);
        geom = dCreateCylinder(app.space, 0.02, 0.05);
        break;
    }
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    return body;
}

/// The energy that leapfrog keeps between its kicks: v- v+ / 2 with the velocities before and
/// after, elastic at the positions between. The mean of v^2 / 2 of one side would count vibration
/// near the critical step several times.
class SoftEnergy final : public Observer {
public:
    bool wants_substeps() const noexcept override { return true; }
    void on_substep(const SubstepView& view) noexcept override {
        const NodeArray& v = view.body.state().velocity;
        if (before_.size() == v.size()) {
            value = elastic_;
            for (std::size_t i = 0; i < v.size(); ++i)
                value += view.body.mass()[i] * before_[i].dot(v[i]) / 2;
        }
        before_ = v;
        elastic_ = view.body.elastic_energy();
    }
    void on_step(SoftWorld&, double) noexcept override {}
    void on_body_end(Body&) noexcept override {}
    void on_world_end(SoftWorld&) noexcept override {}

    double value = 0; ///< [J]

private:
    NodeArray before_;
    double elastic_ = 0;
};

struct Sums {
    double energy = 0;
    Vec3 linear = Vec3::Zero();
    Vec3 angular = Vec3::Zero();
};

Sums sums_of(dBodyID rigid, const Body& soft, double soft_energy) {
    dMass m;
    dBodyGetMass(rigid, &m);
    dVector3 w;
    const dReal* spin = dBodyGetAngularVel(rigid);
    dBodyVectorFromWorld(rigid, spin[0], spin[1], spin[2], w);
    dVector3 l;
    dBodyVectorToWorld(rigid, m.I[0] * w[0], m.I[5] * w[1], m.I[10] * w[2], l);
    const Vec3 v = vec(dBodyGetLinearVel(rigid));
    Sums s;
    s.energy = m.mass * v.squaredNorm() / 2 +
               (m.I[0] * w[0] * w[0] + m.I[5] * w[1] * w[1] + m.I[10] * w[2] * w[2]) / 2 +
               soft_energy;
    s.linear = m.mass * v + soft.linear_momentum();
    s.angular = m.mass * vec(dBodyGetPosition(rigid)).cross(v) + vec(l) + soft.angular_momentum();
    return s;
}

} // namespace

const char* name_of(Shape shape) noexcept {
    constexpr const char* kNames[] = {"sphere", "box", "capsule", "cylinder"};
    return kNames[static_cast<int>(shape)];
}

ShapeOutcome throw_shape(Shape shape, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1, 1);
    OdeApp app;
    const dBodyID body = make_shape(shape, app);
    const Quat turn = Quat(u(random), u(random), u(random), u(random)).normalized();
    const dQuaternion q{turn.w(), turn.x(), turn.y(), turn.z()};
    dBodySetQuaternion(body, q);
    dBodySetPosition(body, 0.03 * u(random), 0.03 * u(random), 0.01 + kReach);
    dBodySetLinearVel(body, 0.2 * u(random), 0.2 * u(random), -kSpeed);
    dBodySetAngularVel(body, 5 * u(random), 5 * u(random), 5 * u(random));
    ShapeOutcome out{};
    {
        SoftWorld soft(app.world, app.space);
        Solid solid;
        solid.young = 2e7;
        solid.poisson = 0.3;
        solid.density = 1000;
        Body& plate = soft.create_body(make_plate(0.2, 0.2, 0.02, 10, 10, 1), {&solid, 1});
        ContactLaw law;
        law.friction = 0;
        law.damping = 0;
        plate.set_contact_law(law);
        auto owned = std::make_unique<SoftEnergy>();
        const SoftEnergy& energy = *owned;
        soft.add_observer(std::move(owned));
        const Sums first = sums_of(body, plate, 0);
        Sums before = first;
        Vec3 linear = Vec3::Zero();
        Vec3 angular = Vec3::Zero();
        const double start = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
        for (int i = 0; i < 40; ++i) {
            const unsigned long points = soft.stats().contact_points;
            soft.step(kStep, &dWorldStep);
            const Sums now = sums_of(body, plate, energy.value);
            if (soft.stats().contact_points != points) { // else ODE alone moved the body
                out.change += (now.energy - before.energy) / first.energy;
                out.highest = std::fmax(out.highest, out.change);
                linear += now.linear - before.linear;
                angular += now.angular - before.angular;
            }
            before = now;
        }
        out.seconds = static_cast<double>(std::clock()) / CLOCKS_PER_SEC - start;
        out.substeps = static_cast<double>(soft.stats().substeps);
        const double moved = kMass * kSpeed;
        out.momentum = linear.norm() / moved;
        out.angular = angular.norm() / (0.05 * moved);
    }
    return out;
}

} // namespace ode::test
