#include "collide/ray.h"
#include "collide/soft_geom.h"

#include <gmock/gmock.h>
#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace ode::soft {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

/// A body of one upright triangle inside a unit cube.
class Client final : public SoftGeomClient {
public:
    explicit Client(dSpaceID space) : position_(3) {
        position_[0] = Vec3(-1, -1, 0);
        position_[1] = Vec3(1, -1, 0);
        position_[2] = Vec3(0, 1, 0);
        geom = create_soft_geom(space, *this);
    }

    ~Client() {
        if (geom)
            destroy_soft_geom(geom);
    }

    Aabb aabb() noexcept override {
        ++asked;
        return box;
    }
    void on_pair(dGeomID other) noexcept override { pairs.push_back(other); }
    int on_ray(dGeomID ray, int flags, dContactGeom* contact, int skip) noexcept override {
        return collide_ray(geom, ray, triangle_, position_, flags, contact, skip);
    }
    void on_destroyed() noexcept override { geom = nullptr; }

    dGeomID geom = nullptr;
    Aabb box{Vec3::Constant(-0.5), Vec3::Constant(0.5)};
    std::vector<dGeomID> pairs;
    int asked = 0;

private:
    NodeArray position_;
    std::vector<std::array<int, 3>> triangle_{{0, 1, 2}};
};

enum class Kind { simple, hash, quadtree, sap };

dSpaceID make_space(Kind kind, dSpaceID parent = nullptr) {
    const dVector3 centre{0, 0, 0, 0};
    const dVector3 extents{50, 50, 50, 0};
    switch (kind) {
    case Kind::simple:
        return dSimpleSpaceCreate(parent);
    case Kind::hash:
        return dHashSpaceCreate(parent);
    case Kind::quadtree:
        return dQuadTreeSpaceCreate(parent, centre, extents, 4);
    case Kind::sap:
        return dSweepAndPruneSpaceCreate(parent, dSAP_AXES_XYZ);
    }
    return nullptr;
}

struct Seen {
    std::vector<dGeomID> geoms;
    int contacts = 0;
};

void near(void* data, dGeomID a, dGeomID b) {
    auto& seen = *static_cast<Seen*>(data);
    if (dGeomIsSpace(a) || dGeomIsSpace(b)) {
        dSpaceCollide2(a, b, data, &near);
        return;
    }
    seen.geoms.push_back(a);
    seen.geoms.push_back(b);
    dContactGeom contact[4];
    seen.contacts += dCollide(a, b, 4, contact, sizeof contact[0]);
}

class SoftGeomInSpace : public testing::TestWithParam<Kind> {
protected:
    SoftGeomInSpace() {
        dInitODE2(0);
        space_ = make_space(GetParam());
    }
    ~SoftGeomInSpace() override {
        dSpaceDestroy(space_);
        dCloseODE();
    }
    Seen collide() {
        Seen seen;
        dSpaceCollide(space_, &seen, &near);
        return seen;
    }
    dSpaceID space_;
};

TEST_P(SoftGeomInSpace, RecordsPairsThatTheNearCallbackNeverSees) {
    Client client(space_);
    const dGeomID sphere = dCreateSphere(space_, 1);
    const dGeomID box = dCreateBox(space_, 1, 1, 1);
    const dGeomID plane = dCreatePlane(space_, 0, 0, 1, 0);
    const dGeomID far = dCreateSphere(space_, 1);
    dGeomSetPosition(far, 10, 0, 0);
    const Seen seen = collide();
    EXPECT_THAT(client.pairs, testing::UnorderedElementsAre(sphere, box, plane));
    EXPECT_THAT(seen.geoms, testing::Not(Contains(client.geom)));
    EXPECT_THAT(seen.geoms, Contains(sphere)); // its pair with the box
}

TEST_P(SoftGeomInSpace, SearchesNestedSpaces) {
    Client client(space_);
    const dSpaceID inner = make_space(Kind::sap, space_);
    const dSpaceID innermost = make_space(Kind::hash, inner);
    const dGeomID sphere = dCreateSphere(innermost, 1);
    const dGeomID far = dCreateSphere(innermost, 1);
    dGeomSetPosition(far, 10, 0, 0);
    const Seen seen = collide();
    EXPECT_THAT(client.pairs, ElementsAre(sphere));
    EXPECT_THAT(seen.geoms, IsEmpty());
}

TEST_P(SoftGeomInSpace, TellsOneOfTwoSoftGeoms) {
    Client a(space_);
    Client b(space_);
    collide();
    EXPECT_EQ(a.pairs.size() + b.pairs.size(), 1u);
    EXPECT_EQ(soft_geom_client(a.geom), &a);
    EXPECT_EQ(soft_geom_client(b.geom), &b);
}

TEST_P(SoftGeomInSpace, HonoursCategoriesAndDisabling) {
    Client client(space_);
    const dGeomID other_category = dCreateSphere(space_, 1);
    dGeomSetCategoryBits(other_category, 2);
    dGeomSetCollideBits(other_category, 0);
    dGeomSetCategoryBits(client.geom, 1);
    dGeomSetCollideBits(client.geom, 1);
    const dGeomID disabled = dCreateSphere(space_, 1);
    dGeomDisable(disabled);
    collide();
    EXPECT_THAT(client.pairs, IsEmpty());
}

TEST_P(SoftGeomInSpace, GivesRaysRealContacts) {
    Client client(space_);
    const dGeomID ray = dCreateRay(space_, 10);
    dGeomRaySet(ray, 0, 0, 3, 0, 0, -1);
    EXPECT_EQ(collide().contacts, 1);
    dContactGeom contact;
    ASSERT_EQ(dCollide(ray, client.geom, 1, &contact, sizeof contact), 1);
    EXPECT_DOUBLE_EQ(contact.depth, 3);
    EXPECT_DOUBLE_EQ(contact.normal[2], 1); // against the ray, as with ODE's own geoms
    EXPECT_EQ(contact.g1, ray);
    EXPECT_EQ(contact.g2, client.geom);
    dGeomRaySet(ray, 0, 0, 3, 0, 0, 1);
    EXPECT_EQ(collide().contacts, 0);
}

TEST_P(SoftGeomInSpace, AsksForTheBoxOnlyAfterAMove) {
    Client client(space_);
    const dGeomID sphere = dCreateSphere(space_, 1);
    collide();
    const int asked = client.asked;
    client.box = {Vec3::Constant(20), Vec3::Constant(21)};
    client.pairs.clear();
    collide();
    EXPECT_EQ(client.asked, asked);
    EXPECT_THAT(client.pairs, ElementsAre(sphere));
    client.pairs.clear();
    mark_moved(client.geom);
    collide();
    EXPECT_GT(client.asked, asked);
    EXPECT_THAT(client.pairs, IsEmpty());
}

TEST_P(SoftGeomInSpace, MeetsNothingWhileItsBoxIsNotFinite) {
    Client client(space_);
    dCreateSphere(space_, 1);
    client.box.low.x() = std::nan("");
    collide();
    client.box = Aabb::empty();
    mark_moved(client.geom);
    collide();
    EXPECT_THAT(client.pairs, IsEmpty());
}

TEST_P(SoftGeomInSpace, CollidesByItselfFromTheTopmostSpace) {
    const dSpaceID inner = make_space(Kind::simple, space_);
    Client client(inner);
    const dGeomID sphere = dCreateSphere(space_, 1);
    collide_now(client.geom);
    EXPECT_THAT(client.pairs, ElementsAre(sphere));
}

INSTANTIATE_TEST_SUITE_P(Spaces, SoftGeomInSpace,
                         testing::Values(Kind::simple, Kind::hash, Kind::quadtree, Kind::sap));

TEST(SoftGeom, EndsWithItsSpaceOrByItsOwner) {
    dInitODE2(0);
    const dSpaceID space = make_space(Kind::simple);
    Client a(space);
    Client b(space);
    destroy_soft_geom(b.geom);
    EXPECT_NE(std::exchange(b.geom, nullptr), nullptr); // not told
    EXPECT_EQ(dSpaceGetNumGeoms(space), 1);
    dSpaceDestroy(space);
    EXPECT_EQ(a.geom, nullptr); // told
    dCloseODE();
}

dColliderFn* no_collider(int) { return nullptr; }

// The application's class gets the number that ours had before ODE was closed.
TEST(SoftGeom, FindsItsClassAnewAfterOdeWasClosed) {
    for (const bool taken : {false, true, false}) {
        dInitODE2(0);
        if (taken) {
            dGeomClass theirs{};
            theirs.collider = &no_collider;
            theirs.aabb = &dInfiniteAABB;
            dCreateGeomClass(&theirs);
        }
        const dSpaceID space = make_space(Kind::simple);
        Client client(space);
        Client second(space); // same class: ODE has four
        EXPECT_EQ(dGeomGetClass(client.geom), dGeomGetClass(second.geom));
        const dGeomID sphere = dCreateSphere(space, 1);
        const dGeomID ray = dCreateRay(space, 10);
        dGeomRaySet(ray, 0, 0, 3, 0, 0, -1);
        Seen seen;
        dSpaceCollide(space, &seen, &near);
        EXPECT_THAT(client.pairs, Contains(sphere));
        EXPECT_GE(seen.contacts, 2);
        dSpaceDestroy(space);
        dCloseODE();
    }
}

} // namespace
} // namespace ode::soft
