#include "support/pile_cases.h"

#include "support/ode_app.h"

#include "mesh/generate.h"
#include "world/soft_world.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

namespace ode::test {
namespace {

using namespace ode::soft;

constexpr double kLook = 0.1; ///< [s]

struct Block {
    double mass;
    double half;      ///< width [m]
    double thickness; ///< [m]
};

std::vector<Block> blocks(Pile pile) {
    switch (pile) {
    case Pile::box:
        return {{1, 0.03, 0.04}};
    case Pile::stack:
        return {{0.1, 0.04, 0.01}, {1, 0.03, 0.04}};
    default:
        return {{0.1, 0.04, 0.01}, {0.3, 0.03, 0.02}, {1, 0.025, 0.04}};
    }
}

/// As OdeApp's, but the soft world is told of contacts as the hook would tell it.
struct Near {
    dWorldID world;
    dJointGroupID contacts;
    SoftWorld* soft;

    static void pair(void* data, dGeomID a, dGeomID b) {
        const auto& near = *static_cast<Near*>(data);
        dContact contact[8] = {};
        const int n = dCollide(a, b, 8, &contact[0].geom, sizeof(dContact));
        for (int i = 0; i < n; ++i) {
            contact[i].surface.mode = dContactApprox1;
            contact[i].surface.mu = 0.5;
            const dJointID joint = dJointCreateContact(near.world, near.contacts, &contact[i]);
            dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
            near.soft->note_contact(joint, contact[i]);
        }
    }
};

class LoadWatch final : public Observer {
public:
    LoadWatch(const SoftWorld& world, const std::vector<dBodyID>& bodies)
        : world_(world), bodies_(bodies) {}
    bool wants_substeps() const noexcept override { return true; }
    void on_substep(const SubstepView& view) noexcept override {
        double now = 0;
        for (const dBodyID b : bodies_)
            if (const RigidShadow* shadow = world_.exchange().find_shadow(b))
                now += shadow->impulse().force.z();
        if (from >= 0 && view.time > from) {
            const double force = (now - before_) / view.dt;
            low = std::fmin(low, force);
            high = std::fmax(high, force);
            sum += now - before_;
            time += view.dt;
        }
        before_ = now;
    }
    void on_step(SoftWorld&, double) noexcept override {
        before_ = 0;
        double energy = 0;
        for (const dBodyID b : bodies_) {
            const RigidShadow* shadow = world_.exchange().find_shadow(b);
            if (!shadow)
                return; // not all are near yet
            dMass m;
            dBodyGetMass(b, &m);
            energy += m.mass * (9.81 * shadow->motion().pose.position.z() +
                                shadow->motion().velocity.squaredNorm() / 2);
        }
        most_energy = std::fmax(most_energy, energy);
    }
    void on_body_end(Body&) noexcept override {}
    void on_world_end(SoftWorld&) noexcept override {}

    double from = -1;               ///< [s]
    double first_energy = 0;        ///< before anything moved [J]
    double most_energy = -HUGE_VAL; ///< of the rigid bodies alone [J]
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    double sum = 0;
    double time = 0;

private:
    const SoftWorld& world_;
    const std::vector<dBodyID>& bodies_;
    double before_ = 0;
};

} // namespace

PileRun run_pile(Pile pile, double h, double drop, double seconds) {
    PileRun run{};
    OdeApp app(-9.81);
    std::vector<dBodyID> bodies;
    double top = 0.01 + drop;
    for (const Block& block : blocks(pile)) {
        const dBodyID body = dBodyCreate(app.world);
        dMass mass;
        dMassSetBoxTotal(&mass, block.mass, 2 * block.half, 2 * block.half, block.thickness);
        dBodySetMass(body, &mass);
        dBodySetPosition(body, 0.003, 0.002, top + block.thickness / 2);
        dGeomSetBody(dCreateBox(app.space, 2 * block.half, 2 * block.half, block.thickness), body);
        top += block.thickness + drop;
        bodies.push_back(body);
        run.weight += 9.81 * block.mass;
    }
    {
        SoftWorld soft(app.world, app.space);
        const TetMesh mesh = make_plate(0.2, 0.2, 0.02, 10, 10, 1);
        Solid solid;
        solid.young = 2e7;
        solid.poisson = 0.3;
        solid.density = 1000;
        solid.beta = 2e-5;
        solid.alpha = 200;
        Body& plate = soft.create_body(mesh, {&solid, 1});
        plate.set_substep(1e-5);
        std::vector<int> rim;
        for (std::size_t i = 0; i < mesh.node.size(); ++i)
            if (mesh.node[i].head<2>().cwiseAbs().maxCoeff() > 0.0999)
                rim.push_back(static_cast<int>(i));
        plate.pin(rim);
        auto owned = std::make_unique<LoadWatch>(soft, bodies);
        LoadWatch& watch = *owned;
        soft.add_observer(std::move(owned));
        for (std::size_t i = 0; i < bodies.size(); ++i)
            watch.first_energy += 9.81 * blocks(pile)[i].mass * dBodyGetPosition(bodies[i])[2];
        Near near{app.world, app.contacts, &soft};
        const double start = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
        const long steps = std::lround(seconds / h);
        for (long i = 0; i < steps; ++i) {
            if (watch.from < 0 && static_cast<double>(i) * h > seconds - kLook)
                watch.from = soft.time();
            dSpaceCollide(app.space, &near, &Near::pair);
            soft.step(h, &dWorldQuickStep);
            dJointGroupEmpty(app.contacts);
        }
        run.seconds = static_cast<double>(std::clock()) / CLOCKS_PER_SEC - start;
        run.gain = watch.most_energy - watch.first_energy;
        run.mean = watch.sum / watch.time;
        run.ripple = std::fmax(watch.high - run.mean, run.mean - watch.low);
        run.lowest = dBodyGetPosition(bodies[0])[2] - 0.01 - blocks(pile)[0].thickness / 2;
    }
    return run;
}

} // namespace ode::test
