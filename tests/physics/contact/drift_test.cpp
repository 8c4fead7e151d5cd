// Why a soft box that falls flat on a floor comes to rest beside where it fell: its mesh isn't
// symmetric. Cells are mirrored from one to the next, so that of an odd number one is left over,
// which shears when it is squashed, and friction turns that into a step aside. It is the body that
// drifts: turned by half a turn it goes the other way, without friction it stays, an even number
// stays, and so does a finer one, nearly.
#include "physics/contact/soft_app.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace ode::soft {
namespace {

/// Where the centre of mass of a box dropped by 1 cm is when it has come to rest, from where it
/// was.
Vec3 drift(double friction, int cells, bool turned, bool on_box) {
    SoftApp app(9.81);
    if (on_box)
        dGeomSetPosition(dCreateBox(app.space, 2, 2, 1), 0, 0, -0.5);
    else
        dCreatePlane(app.space, 0, 0, 1, 0);
    const MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, cells, cells, cells));
    const dSoftBodyID box =
        app.add(mesh, SoftApp::solid(2e5, 1000, 0.3, 1e-3), Vec3(0, 0, 0.06), Vec3::Zero());
    if (turned) {
        const dQuaternion half{0, 0, 0, 1};
        dSoftBodyRotate(box, half);
    }
    dSoftContact contact = dSoftContactDefault();
    contact.friction = friction;
    dSoftBodySetContact(box, &contact);
    const Vec3 before = SoftApp::center(box);
    for (int i = 0; i < 300; ++i)
        app.step(0.005);
    return SoftApp::center(box) - before;
}

TEST(Drift, IsTheMeshsOwn) {
    for (const bool on_box : {false, true}) {
        const Vec3 rough = drift(0.5, 3, false, on_box);
        const Vec3 turned = drift(0.5, 3, true, on_box);
        const Vec3 smooth = drift(0, 3, false, on_box);
        const Vec3 fine = drift(0.5, 7, false, on_box);
        const Vec3 even = drift(0.5, 4, false, on_box);
        std::printf("on a %s: %.3f %.3f mm; turned %.3f %.3f; without friction %.1e %.1e; finer "
                    "%.3f %.3f; even %.3f %.3f\n",
                    on_box ? "box" : "plane", 1e3 * rough.x(), 1e3 * rough.y(), 1e3 * turned.x(),
                    1e3 * turned.y(), 1e3 * smooth.x(), 1e3 * smooth.y(), 1e3 * fine.x(),
                    1e3 * fine.y(), 1e3 * even.x(), 1e3 * even.y());
        EXPECT_GT(rough.head<2>().norm(), 5e-4);
        EXPECT_LT((rough + turned).head<2>().norm(), 0.1 * rough.head<2>().norm());
        EXPECT_LT(smooth.head<2>().norm(), 1e-9);
        EXPECT_LT(fine.head<2>().norm(), 0.1 * rough.head<2>().norm());
        EXPECT_LT(even.head<2>().norm(), 0.02 * rough.head<2>().norm());
    }
}

} // namespace
} // namespace ode::soft
