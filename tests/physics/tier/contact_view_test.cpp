// What contact is told of a body in its modes is what then happens.
#include "tier_run.h"

#include "reduced/contact_view.h"

#include <gtest/gtest.h>

#include <array>

namespace ode::soft {
namespace {

struct View : testing::Test {
    View() : run(TierChoice::modes) {
        run.step(1e-4); // finds the modes
        motion = std::make_unique<ModalMotion>(run.body().modal_motion()->shared_basis());
        NodeState rest = run.body().state();
        for (std::size_t i = 0; i < rest.velocity.size(); ++i)
            rest.velocity[i] = Vec3(0.3 * rest.position[i].y(), -1, rest.position[i].x());
        motion->take(rest, {});
        nodes = rest;
        surface = run.body().surface().node;
    }
    Vec3 at(int node) const { return nodes.position[static_cast<std::size_t>(node)]; }

    TierRun run;
    std::unique_ptr<ModalMotion> motion;
    NodeState nodes;
    std::vector<int> surface;
};

// The mean velocity foretold, pushes and all, is the way that nodes go. Single precision, 1e-6 of
// the speed; a push turns the frame by a hair of second order.
TEST_F(View, ForetellsWherePushesTakeEachNode) {
    constexpr double dt = 2.84e-6;
    ContactView view(*motion, nodes);
    ContactShare given(nodes.position.size());
    view.begin(surface, dt);
    const std::array<std::pair<int, Vec3>, 2> pushes = {std::pair{surface[3], Vec3(20, 5, 300)},
                                                        std::pair{surface[200], Vec3(-50, 0, 100)}};
    for (const auto& [node, force] : pushes) {
        view.push(static_cast<std::size_t>(node), force);
        given.add(static_cast<std::size_t>(node), force);
    }
    std::vector<Vec3> before, foretold;
    for (const int node : surface) {
        before.push_back(at(node));
        foretold.push_back(view.ahead({{node, node, node}, {1, 0, 0}}));
    }
    motion->push(given, nodes, dt);
    motion->advance(dt);
    motion->place(surface, nodes);
    for (std::size_t i = 0; i < surface.size(); ++i)
        EXPECT_LT(((at(surface[i]) - before[i]) / dt - foretold[i]).norm(), 1e-4)
            << "node " << surface[i];
}

// At a point of a triangle, too.
TEST_F(View, ComplianceIsWhatAPushAdds) {
    ContactView view(*motion, nodes);
    constexpr double dt = 2.84e-6;
    view.begin(surface, dt);
    const auto& corner = run.body().surface().triangle[17];
    const CarriedPoint point{corner, {0.5, 0.3, 0.2}};
    const Vec3 along = Vec3(1, -2, 0.5).normalized();
    const double told = view.compliance(point, along);
    const double before = along.dot(view.ahead(point));
    constexpr double kForce = 100;
    for (int i = 0; i < 3; ++i)
        view.push(static_cast<std::size_t>(corner[static_cast<std::size_t>(i)]),
                  point.weight[i] * kForce * along);
    EXPECT_NEAR((along.dot(view.ahead(point)) - before) / (kForce * dt), told, 1e-4 * told);
}

} // namespace
} // namespace ode::soft
