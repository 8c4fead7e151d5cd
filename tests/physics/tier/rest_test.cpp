// A bowl that lies on its rim: what is left of its motion.
#include "physics/tier/tier_run.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

namespace ode::soft {
namespace {

TEST(RestInModes, DiesAway) {
    TierRun run(TierChoice::modes, 1, -9.81);
    Body& body = run.body();
    dCreatePlane(run.space(), 0, 0, 1, 0);
    body.rotate(Quat(Eigen::AngleAxisd(std::numbers::pi - 0.003, Vec3(1, 0.2, 0).normalized())));
    double low = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < body.mass().size(); ++i)
        low = std::min(low, body.state().position[i].z());
    body.move_to(body.center_of_mass() + Vec3(0, 0, 1e-5 - low));
    for (int i = 0; i < 2000; ++i) {
        run.step(1e-3);
        if (i % 100 == 99 && body.rings())
            std::printf("%d %d %.1f s: vibration %.2e J, rigid %.2e J, cpu %.2f\n", int(body.modal_motion()->awake()), int(body.modal_motion()->band()), 1e-3 * (i + 1),
                        body.modal_motion()->vibration_energy(),
                        body.modal_motion()->rigid_energy(), run.seconds());
    }
}

} // namespace
} // namespace ode::soft
