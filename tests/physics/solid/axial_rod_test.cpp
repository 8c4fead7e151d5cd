// Conformance case 3: longitudinal modes of a steel bar without lateral contraction, c =
// sqrt(E/rho).
#include "physics/solid/free_body.h"

#include "model/stvk_linear.h"

#include <gtest/gtest.h>

#include <numbers>

namespace ode::soft {
namespace {

constexpr double kLength = 0.3;

Solid steel_without_contraction() {
    Solid s;
    s.young = 200e9;
    s.density = 7850;
    return s;
}

/// Frequency [Hz] of a mode that the body is released in, from the zero crossings of its share.
double ring(const ElasticModel& model, const NodeArray& rest, double guess, bool fixed) {
    FreeBody body(model, rest);
    NodeArray shape(rest.size());
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const double x = rest[i].x() / kLength;
        shape[i] =
            Vec3(fixed ? std::sin(std::numbers::pi * x / 2) : std::cos(std::numbers::pi * x), 0, 0);
        body.state.position[i] += 1e-8 * shape[i];
        if (fixed && x < 1e-9)
            body.inverse_mass[i] = 0;
    }
    const double h = 0.5 * body.critical();
    const auto share = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < rest.size(); ++i)
            sum += model.mass()[i] * (body.state.position[i] - rest[i]).dot(shape[i]);
        return sum;
    };
    double before = share(), first = 0, last = 0;
    int crossings = 0;
    for (double t = h; t < 10.2 / guess; t += h) {
        body.step(h);
        const double now = share();
        if (before * now < 0) {
            last = t - h * now / (now - before);
            first = crossings == 0 ? last : first;
            ++crossings;
        }
        before = now;
    }
    return (crossings - 1) / (2 * (last - first));
}

// Space: linear elements of size d with lumped mass are (pi d / lambda)^2 / 6 flat, 0.03 % for 40
// elements on half a wave, and half of that on a quarter. Time, at a step well below the period:
// nothing. Tetrahedra of six to a cube do not share the mass of a plane evenly: another 0.1 %.
TEST(AxialRod, RingsAtItsWaveSpeedWithLinearElements) {
    const TetMesh mesh = box_mesh({kLength, 0.02, 0.02}, 40, 3, 3);
    const StvkLinear model(mesh, steel_without_contraction());
    const NodeArray rest = node_array(mesh.node);
    EXPECT_NEAR(ring(model, rest, 8412.6, false), 8412.6, 0.0015 * 8412.6);
    EXPECT_NEAR(ring(model, rest, 4206.3, true), 4206.3, 0.0015 * 4206.3);
}

} // namespace
} // namespace ode::soft
