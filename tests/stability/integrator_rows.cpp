// Every integrator over steps from 0.1 to 4 of the critical one: bounded below its limit; above it
// the body is redone at a shorter step or stopped, told, and the world is intact.
#include "stability/suite.h"

#include "base/error.h"
#include "mesh/generate.h"

#include <random>

namespace ode::test {
namespace {

using namespace ode::soft;

StressResult run(const IntegratorKind& kind, double share) {
    Scene scene;
    const Solid rubber = solid_of(1e6, 0.3, 1000);
    const TetMesh mesh = make_box({0.1, 0.1, 0.1}, 2, 2, 2);
    Body& cube = scene.add(mesh, rubber, "stvk", 1, std::string(kind.name));
    // Methods without a limit of their own are asked at that of central difference.
    const bool limited = std::isfinite(cube.critical_step()) && cube.critical_step() > 0;
    const double critical =
        limited ? cube.critical_step() : scene.add(mesh, rubber).critical_step();
    std::mt19937 bits(3);
    set_velocities(cube, [&](const Vec3&) {
        const auto random = [&] {
            return 0.1 * double(bits()) / double(std::mt19937::max()) - 0.05;
        };
        const double x = random(), y = random(), z = random();
        return Vec3(x, y, z);
    });
    const double start = cube.kinetic_energy();
    cube.set_substep(share * critical);
    scene.run(0.2, cube.substep() * std::ceil(0.005 / cube.substep())); // no shorter substep
    const double end = cube.kinetic_energy() + cube.elastic_energy();
    const bool grows_always = cube.critical_step() == 0;
    const bool stable = !grows_always && (kind.implicit || share <= 1);
    // A step at the very limit may be redone: its energy may swing without bounds.
    bool good = end <= EnergyBudget::kMost * start;
    if (stable && share < 1)
        good &= cube.rollbacks() == 0 && !cube.stopped();
    if (!stable && share > 1)
        good &= cube.rollbacks() > 0 || cube.safe_substep() < cube.substep(); // or shortened before
    return judged(scene, good, format("energy x %.3g", end / start));
}

} // namespace

void add_integrator_cases(std::vector<StressCase>& cases) {
    for (const IntegratorKind& kind : integrator_kinds())
        for (const double share : {0.1, 0.5, 0.9, 1.0, 1.1, 2.0, 4.0})
            cases.push_back({"integrator",
                             format("%s, %g of critical", std::string(kind.name).c_str(), share),
                             true, [&kind, share] { return run(kind, share); }});
}

} // namespace ode::test
