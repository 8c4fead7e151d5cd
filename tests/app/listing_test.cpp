// An application that lists its space finds what it has put there and nothing else.
#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace {

using namespace ode::soft;
using testing::ElementsAre;

struct ListingApp : ode::test::OdeApp {
    ListingApp() : soft(dSoftWorldCreate(world, space)) {}

    dSoftBodyID add_cube() {
        MeshHandle mesh(dSoftMeshCreateBox(1, 1, 1, 1, 1, 1));
        const dSoftSolid solid = dSoftSolidDefault();
        return dSoftBodyCreate(soft, mesh, &solid);
    }

    std::vector<dGeomID> listed(dSpaceID in) const {
        std::vector<dGeomID> all;
        for (int i = 0; i < dSpaceGetNumGeoms(in); ++i)
            all.push_back(dSpaceGetGeom(in, i));
        return all;
    }

    WorldHandle soft;
};

TEST(Listing, PassesOverSoftBodiesWhereverTheyLie) {
    ListingApp app;
    app.add_cube();
    EXPECT_EQ(dSpaceGetNumGeoms(app.space), 0);
    const dGeomID a = dCreateSphere(app.space, 1); // ODE lists the latest first
    app.add_cube();
    app.add_cube();
    const dGeomID b = dCreateSphere(app.space, 1);
    const dGeomID c = dCreateSphere(app.space, 1);
    const dSoftBodyID last = app.add_cube();
    EXPECT_THAT(app.listed(app.space), ElementsAre(c, b, a));
    EXPECT_EQ(dSpaceGetGeom(app.space, 2), a); // in any order
    EXPECT_EQ(dSpaceGetGeom(app.space, 0), c);
    EXPECT_EQ(dSpaceGetGeom(app.space, 1), b);
    dGeomDestroy(b);
    dSoftBodyDestroy(last);
    EXPECT_THAT(app.listed(app.space), ElementsAre(c, a));
}

TEST(Listing, OfSpacesWithoutSoftBodiesIsOdes) {
    ListingApp app;
    app.add_cube();
    const dSpaceID inner = dSimpleSpaceCreate(app.space);
    const dGeomID a = dCreateSphere(inner, 1);
    EXPECT_THAT(app.listed(inner), ElementsAre(a));
    EXPECT_THAT(app.listed(app.space), ElementsAre(reinterpret_cast<dGeomID>(inner)));
}

// The usual way to empty a space.
TEST(Listing, EndsWhenTheLastOfTheApplicationsGeomsIsGone) {
    ListingApp app;
    dCreateSphere(app.space, 1);
    const dSoftBodyID cube = app.add_cube();
    dCreateSphere(app.space, 1);
    int destroyed = 0;
    for (; dSpaceGetNumGeoms(app.space) > 0; ++destroyed)
        dGeomDestroy(dSpaceGetGeom(app.space, 0));
    EXPECT_EQ(destroyed, 2);
    EXPECT_NE(dSoftBodyGetGeom(cube), nullptr);
    EXPECT_TRUE(dSpaceQuery(app.space, dSoftBodyGetGeom(cube)));
}

} // namespace
