#include "couple/surface_contact.h"
#include "mesh/generate.h"
#include "mesh/surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ode::soft {
namespace {

/// A surface whose nodes the test moves by itself.
struct Body {
    explicit Body(TetMesh of, double node_mass = 1e-3)
        : mesh(std::move(of)), surface(extract_surface(mesh)), mass(mesh.node.size(), node_mass),
          nodes(mesh, surface, mass), soft(nodes, mesh.node), position(mesh.node.size()),
          velocity(mesh.node.size()), force(mesh.node.size()),
          inverse_mass(mesh.node.size(), 1 / node_mass) {
        for (std::size_t i = 0; i < mesh.node.size(); ++i)
            position[i] = mesh.node[i];
    }
    void move(const Vec3& by) {
        for (std::size_t i = 0; i < position.size(); ++i)
            position[i] += by;
    }
    void drift(double dt) {
        for (std::size_t i = 0; i < position.size(); ++i) {
            velocity[i] += dt * inverse_mass[i] * force[i];
            position[i] += dt * velocity[i];
        }
    }
    SoftSide side() { return {position, velocity, inverse_mass, force}; }
    Vec3 total(const NodeArray& field) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < position.size(); ++i)
            sum += field[i];
        return sum;
    }
    Vec3 torque() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < position.size(); ++i)
            sum += position[i].cross(Vec3(force[i]));
        return sum;
    }
    double kinetic() const {
        double sum = 0;
        for (std::size_t i = 0; i < position.size(); ++i)
            sum += velocity[i].squaredNorm() / inverse_mass[i] / 2;
        return sum;
    }

    TetMesh mesh;
    Surface surface;
    std::vector<double> mass;
    SurfaceNodes nodes;
    SoftSurface soft;
    NodeArray position;
    NodeArray velocity;
    NodeArray force;
    std::vector<double> inverse_mass;
};

PairLaw law(double friction = 0) {
    PairLaw out;
    out.friction = friction;
    out.stiffness = 1e9;
    out.bearable_point = out.bearable_face = 0.1 / (1e-5 * 1e-5);
    out.bearable_point_damping = out.bearable_face_damping = 1e3;
    out.hardness = 7;
    return out;
}

/// A block of 10 cm, top at z = 0, and a tetrahedron of 3 cm with a corner down, its tip at z.
class TipOnBlock : public testing::Test {
protected:
    TipOnBlock() : block(make_box({0.1, 0.1, 0.1}, 2, 2, 2)), tip(tetrahedron()) {
        block.move({0, 0, -0.05});
    }
    static TetMesh tetrahedron() {
        TetMesh mesh = make_box({0.01, 0.01, 0.01}, 1, 1, 1);
        mesh.node = {{0, 0, 0}, {0.015, 0, 0.03}, {-0.01, 0.01, 0.03}, {-0.01, -0.01, 0.03}};
        mesh.element = {0, 1, 2, 3};
        mesh.group.resize(std::min<std::size_t>(mesh.group.size(), 1));
        return mesh;
    }
    /// One substep of forces. @return points that bear.
    std::size_t press(SurfaceContact& contact, double dt) {
        block.force.set_zero();
        tip.force.set_zero();
        contact.settle(tip.side(), block.side(), last_dt);
        last_dt = dt;
        ++when;
        block.soft.refit(block.position, when);
        unsigned long tests = 0;
        contact.look(tip.side(), block.side(), 5e-3, 1e-3, tests);
        contact.find_touching(tip.side(), block.side(), 0, dt, tests);
        contact.prepare(tip.side(), block.side());
        contact.sweep(tip.side(), block.side(), dt);
        contact.sweep(tip.side(), block.side(), dt);
        return contact.drag(tip.side(), block.side(), dt);
    }
    Body block;
    Body tip;
    double last_dt = 0;
    unsigned long when = 0;
};

TEST_F(TipOnBlock, BearsNothingOutside) {
    SurfaceContact contact(tip.soft, block.soft, false);
    contact.begin_step(law());
    tip.move({0.01, 0.003, 1e-4});
    EXPECT_EQ(press(contact, 1e-5), 0u);
    EXPECT_TRUE(contact.is_near());
    EXPECT_EQ(tip.total(tip.force).norm(), 0);
}

TEST_F(TipOnBlock, PushesAlongTheFaceAndKeepsBothMomenta) {
    for (const double friction : {0.0, 0.5}) {
        SurfaceContact contact(tip.soft, block.soft, false);
        contact.begin_step(law(friction));
        tip.move({0.01, 0.003, -1e-4 - tip.position[0].z()});
        for (std::size_t i = 0; i < tip.velocity.size(); ++i)
            tip.velocity[i] = Vec3(0.3, -0.1, -0.5);
        EXPECT_EQ(press(contact, 1e-5), 1u);
        const Vec3 f = tip.total(tip.force);
        EXPECT_GT(f.z(), 0);
        const double across = f.head<2>().norm();
        if (friction == 0)
            EXPECT_LT(across, 1e-12 * f.z());
        else
            EXPECT_GT(across, 0);
        EXPECT_LE(across, friction * f.z() * (1 + 1e-12) + 1e-12 * f.z());
        EXPECT_LT((f + block.total(block.force)).norm(), 1e-12 * f.norm());
        EXPECT_LT((tip.torque() + block.torque()).norm(), 1e-13 * f.norm());
        tip.move(Vec3(-0.01, -0.003, 0));
    }
}

// The tip flies in and out again; the block's nodes are free masses.
TEST_F(TipOnBlock, GivesBackWhatItTook) {
    SurfaceContact contact(tip.soft, block.soft, false);
    contact.begin_step(law());
    tip.move({0.01, 0.003, 1e-4});
    for (std::size_t i = 0; i < tip.velocity.size(); ++i)
        tip.velocity[i] = Vec3(0, 0, -1);
    const double before = tip.kinetic() + block.kinetic();
    std::size_t bearing = 0;
    std::size_t last = 0;
    double most = 0;
    for (int i = 0; i < 400; ++i) {
        last = press(contact, 1e-6);
        bearing += last;
        tip.drift(1e-6);
        block.drift(1e-6);
        most = std::fmax(most, tip.kinetic() + block.kinetic());
    }
    EXPECT_GT(bearing, 5u);
    EXPECT_EQ(last, 0u); // they have parted
    EXPECT_NEAR(tip.kinetic() + block.kinetic(), before, 1e-3 * before);
    EXPECT_LT(most, before * (1 + 1e-9));
}

// Deep in the body at first sight: it was never outside, so nothing throws it out.
TEST_F(TipOnBlock, LeavesAloneWhatIsFoundDeepInside) {
    SurfaceContact contact(tip.soft, block.soft, false);
    contact.begin_step(law());
    tip.move({0.01, 0.003, -0.02});
    EXPECT_EQ(press(contact, 1e-5), 0u);
}

TEST_F(TipOnBlock, ForgetsWhenItLooksAway) {
    SurfaceContact contact(tip.soft, block.soft, false);
    contact.begin_step(law());
    tip.move({0.01, 0.003, -1e-4});
    EXPECT_EQ(press(contact, 1e-5), 1u);
    contact.look_away();
    EXPECT_FALSE(contact.is_near());
}

} // namespace
} // namespace ode::soft
