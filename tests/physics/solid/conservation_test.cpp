#include "physics/solid/free_body.h"

#include "model/stvk_linear.h"

#include <gtest/gtest.h>

namespace ode::soft {
namespace {

struct Momenta {
    Vec3 linear, angular;
};

Momenta momenta(const FreeBody& body) {
    Momenta p{Vec3::Zero(), Vec3::Zero()};
    for (std::size_t i = 0; i < body.model.node_count(); ++i) {
        const Vec3 mv = body.model.mass()[i] * body.state.velocity[i];
        p.linear += mv;
        p.angular += body.state.position[i].cross(mv);
    }
    return p;
}

/// The energy that central difference keeps: potential at the step, kinetic as the product of the
/// velocities half a step before and after. For a linear body it is constant to rounding.
double step_and_energy(FreeBody& body, double h) {
    const NodeArray before = body.state.velocity;
    double energy = body.model.energy(body.state.position);
    body.step(h);
    for (std::size_t i = 0; i < body.model.node_count(); ++i)
        energy += body.model.mass()[i] * before[i].dot(body.state.velocity[i]) / 2;
    return energy;
}

/// Rings in all modes with strains of about `strain` while it tumbles.
void excite(FreeBody& body, double strain, double cell, double h) {
    body.state.position = disturbed(body.state.position, strain * cell, 9);
    for (std::size_t i = 0; i < body.state.velocity.size(); ++i)
        body.state.velocity[i] =
            Vec3(0.1, 0, 0) + 1e-4 / h * Vec3(1, 2, -1).cross(Vec3(body.state.position[i]));
}

// Undamped and free, at 0.9 of the critical step: energy stays within 1e-4 over 1e5 steps. What is
// left of the excursion is the cubic part of the energy, of the order of the strain.
TEST(Conservation, EnergyOfAFreeBodyIsBounded) {
    const TetMesh mesh = irregular_box({0.1, 0.1, 0.1}, 2, 2, 2);
    const StvkLinear model(mesh, rubber());
    FreeBody body(model, node_array(mesh.node));
    const double h = 0.9 * body.critical();
    excite(body, 2e-5, 0.05, h);
    const double start = step_and_energy(body, h);
    double worst = 0;
    for (int n = 0; n < 100000; ++n) {
        if (n % 7 != 0)
            body.step(h);
        else
            worst = std::max(worst, std::abs(step_and_energy(body, h) / start - 1));
    }
    EXPECT_LE(worst, 1e-4);
    EXPECT_GT(worst, 0);
}

// Central difference keeps both momenta to rounding, at any strain: 1e-9 over a second of case 18.
TEST(Conservation, MomentaOfATumblingRingingBodyAreKept) {
    const TetMesh mesh = irregular_box({0.1, 0.1, 0.1}, 3, 3, 3);
    const StvkLinear model(mesh, rubber());
    FreeBody body(model, node_array(mesh.node));
    const double h = 0.5 * body.critical();
    excite(body, 0.05, 0.033, h);
    const Momenta start = momenta(body);
    for (double t = 0; t < 1; t += h)
        body.step(h);
    const Momenta end = momenta(body);
    EXPECT_LE((end.linear - start.linear).norm(), 1e-9 * start.linear.norm());
    EXPECT_LE((end.angular - start.angular).norm(), 1e-9 * start.angular.norm());
}

// Viscosity takes energy and leaves the spin alone: it ends as a rigid rotation.
TEST(Conservation, ViscousBodyRingsDownToRigidRotation) {
    Solid solid = rubber();
    solid.phi = 60;
    solid.psi = 60;
    const TetMesh mesh = irregular_box({0.1, 0.1, 0.1}, 2, 2, 2);
    const StvkLinear model(mesh, solid);
    FreeBody body(model, node_array(mesh.node));
    const double h = 0.8 * body.critical(viscous_time(solid));
    excite(body, 0.05, 0.05, h);
    const Vec3 spin = momenta(body).angular;
    for (double t = 0; t < 0.5; t += h)
        body.step(h);
    EXPECT_LE((momenta(body).angular - spin).norm(), 1e-9 * spin.norm());
    // Left over: centrifugal strain, v = w x r everywhere.
    Vec3 centre = Vec3::Zero(), drift = Vec3::Zero();
    double mass = 0;
    for (std::size_t i = 0; i < body.state.position.size(); ++i) {
        centre += model.mass()[i] * body.state.position[i];
        drift += model.mass()[i] * body.state.velocity[i];
        mass += model.mass()[i];
    }
    centre /= mass;
    drift /= mass;
    Mat3 inertia = Mat3::Zero();
    Vec3 angular = Vec3::Zero();
    for (std::size_t i = 0; i < body.state.position.size(); ++i) {
        const Vec3 r = body.state.position[i] - centre;
        inertia += model.mass()[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
        angular += model.mass()[i] * r.cross(body.state.velocity[i] - drift);
    }
    const Vec3 w = inertia.inverse() * angular;
    double worst = 0;
    for (std::size_t i = 0; i < body.state.position.size(); ++i) {
        const Vec3 r = body.state.position[i] - centre;
        worst = std::max(worst, (body.state.velocity[i] - drift - w.cross(r)).norm());
    }
    EXPECT_LE(worst, 1e-3 * w.norm() * 0.1);
}

} // namespace
} // namespace ode::soft
