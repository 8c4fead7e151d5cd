#include "source/node_rule.h"

#include "../transfer/shapes.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

namespace ode::sound {
namespace {

double volume_of(const BoundaryMesh& mesh) {
    double sum = 0.0;
    for (const Facet& f : mesh.facets())
        sum += f.area * f.normal.dot(f.centroid()) / 3.0;
    return sum;
}

// A sphere that moves as a whole is a dipole of 3/2 its volume, its own half again for the air that
// it carries (A. D. Pierce, Acoustics, 1989, 4-2).
TEST(RigidSound, OfABallIsAHalfMoreThanItsVolume) {
    const Air air;
    for (const int level : {1, 2, 3}) {
        const BoundaryMesh ball = test::sphere(level);
        const RigidSound sound = rigid_sound(ball, Vec3::Zero(), air);
        const double own = sound.dipole.leftCols<3>().trace() / 3.0 * 4.0 * std::numbers::pi /
                           (air.density * volume_of(ball));
        std::printf("level %d, %zu triangles: %.4f of 1.5, %+.2f dB\n", level, ball.triangle.size(),
                    own, 20.0 * std::log10(own / 1.5));
        EXPECT_NEAR(own, 1.5, 0.05) << level;
    }
}

} // namespace
} // namespace ode::sound
