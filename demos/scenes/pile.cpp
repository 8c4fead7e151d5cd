#include "scenes/pile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace scenes {
namespace {

using ode::soft::MeshHandle;

struct Place {
    std::array<double, 3> at;
    dQuaternion turn;
};

/// Layers of a square grid, jittered: bodies of any orientation don't overlap at first.
Place place(int i, int across, const Pile& pile, std::mt19937& random) {
    std::uniform_real_distribution<double> u(-1, 1);
    const double pitch = 1.8 * pile.size; // a cube's diagonal is 1.73 of its side
    Place p{};
    const std::array<int, 3> cell{i % across, i / across % across, i / (across * across)};
    for (std::size_t k = 0; k < 3; ++k)
        p.at[k] =
            pitch * (cell[k] - (k < 2 ? (across - 1) / 2.0 : -0.6)) + 0.03 * pile.size * u(random);
    double norm = 0;
    for (dReal& part : p.turn) {
        part = u(random);
        norm += part * part;
    }
    for (dReal& part : p.turn)
        part /= std::sqrt(norm);
    return p;
}

dSoftBodyID add_soft(World& world, const Pile& pile, const MeshHandle& mesh) {
    dSoftSolid solid = dSoftSolidDefault();
    solid.young = pile.young;
    solid.poisson = 0.3;
    solid.density = pile.density;
    solid.alpha = pile.alpha;
    solid.beta = pile.beta;
    const dSoftBodyID body = made(dSoftBodyCreate(world.soft(), mesh, &solid));
    dSoftContact contact = dSoftContactDefault();
    contact.friction = pile.friction;
    contact.damping = pile.beta;
    dSoftRest rest = dSoftRestDefault();
    rest.speed = 0.01; // as ODE's own
    rest.acceleration = 5;
    if (!dSoftBodySetMaterialModel(body, "stable-neo-hookean") ||
        !dSoftBodySetContact(body, &contact) || !dSoftBodySetRest(body, &rest))
        throw Refused("the body can't be had in this form");
    return body;
}

dBodyID add_rigid(World& world, const Pile& pile, bool ball) {
    const dBodyID body = dBodyCreate(world.ode());
    dMass mass;
    dGeomID geom = nullptr;
    if (ball) {
        dMassSetSphere(&mass, pile.density, pile.size / 2);
        geom = dCreateSphere(world.space(), pile.size / 2);
    } else {
        dMassSetBox(&mass, pile.density, pile.size, pile.size, pile.size);
        geom = dCreateBox(world.space(), pile.size, pile.size, pile.size);
    }
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    return body;
}

void add(const dReal* m, const dReal* x, double mass, PileState& s) {
    s.throughput += std::hypot(m[0], m[1], m[2]);
    for (int i = 0; i < 3; ++i)
        s.momentum[i] += m[i];
    s.lowest = std::min(s.lowest, static_cast<double>(x[2]));
    s.widest = std::max({s.widest, std::fabs(x[0]), std::fabs(x[1])});
    s.potential += mass * x[2]; // times gravity, at the end
}

void add_soft_state(dSoftBodyID body, const dReal* center, PileState& s) {
    dVector3 linear;
    dVector3 angular;
    dSoftBodyGetMomentum(body, linear, angular);
    const dSoftEnergy energy = dSoftBodyGetEnergy(body);
    dSoftStatus status{};
    status.struct_size = sizeof status;
    dSoftBodyGetStatus(body, &status);
    s.any_stopped |= status.stopped != 0;
    s.kinetic += energy.kinetic;
    s.elastic += energy.elastic;
    for (int i = 0; i < 3; ++i)
        s.angular[i] += angular[i];
    add(linear, center, dSoftBodyGetMass(body), s);
    const dReal* v = nullptr;
    int stride = 0;
    const int nodes = dSoftBodyGetVelocities(body, &v, &stride);
    for (int i = 0; i < nodes; ++i)
        s.fastest =
            std::max(s.fastest, std::hypot(v[i * stride], v[i * stride + 1], v[i * stride + 2]));
}

void add_rigid_state(dBodyID body, PileState& s) {
    dMass mass;
    dBodyGetMass(body, &mass);
    const dReal* v = dBodyGetLinearVel(body);
    const dReal* w = dBodyGetAngularVel(body);
    const dReal* x = dBodyGetPosition(body);
    dVector3 linear;
    for (int i = 0; i < 3; ++i)
        linear[i] = mass.mass * v[i];
    // Cubes and balls: one moment of inertia for every axis.
    for (int i = 0; i < 3; ++i)
        s.angular[i] += x[(i + 1) % 3] * linear[(i + 2) % 3] -
                        x[(i + 2) % 3] * linear[(i + 1) % 3] + mass.I[0] * w[i];
    s.kinetic += mass.mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2 +
                 mass.I[0] * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) / 2;
    s.fastest = std::max(s.fastest, std::hypot(v[0], v[1], v[2]));
    add(linear, x, mass.mass, s);
}

} // namespace

PileBodies build(World& world, const Pile& pile) {
    PileBodies made_here;
    // Inherited by bodies to come. Corners between soft walls may rattle at some mm/s for long.
    dWorldSetAutoDisableFlag(world.ode(), pile.may_rest);
    dWorldSetAutoDisableAngularThreshold(world.ode(), 0.1);
    std::mt19937 random(pile.seed);
    const int count = pile.soft + pile.rigid;
    int across = 1;
    while (2 * across * across * across < count) // twice as high as wide
        ++across;
    made_here.half = 0.9 * pile.size * across + 0.1 * pile.size;
    if (pile.bin) {
        dCreatePlane(world.space(), 0, 0, 1, 0);
        dCreatePlane(world.space(), 1, 0, 0, -made_here.half);
        dCreatePlane(world.space(), -1, 0, 0, -made_here.half);
        dCreatePlane(world.space(), 0, 1, 0, -made_here.half);
        dCreatePlane(world.space(), 0, -1, 0, -made_here.half);
    } else {
        dWorldSetGravity(world.ode(), 0, 0, 0);
    }
    const MeshHandle cube(made(dSoftMeshCreateBox(pile.size, pile.size, pile.size, 2, 2, 2)));
    const MeshHandle slab(made(dSoftMeshCreateBox(pile.size, pile.size, pile.size / 2, 2, 2, 1)));
    int rigid = 0;
    for (int i = 0; i < count; ++i) {
        const Place p = place(i, across, pile, random);
        // Towards the middle, as fast as a fall from a few body sizes.
        std::array<double, 3> v{};
        if (!pile.bin)
            for (std::size_t k = 0; k < 3; ++k)
                v[k] = -2 * (p.at[k] - (k == 2 ? 1.8 * pile.size * across : 0));
        // Rigid ones spread evenly among the soft.
        if ((i + 1) * pile.rigid / count > rigid) {
            const dBodyID body = add_rigid(world, pile, rigid % 2 == 1);
            ++rigid;
            dBodySetPosition(body, p.at[0], p.at[1], p.at[2]);
            dBodySetQuaternion(body, p.turn);
            dBodySetLinearVel(body, v[0], v[1], v[2]);
            made_here.rigid.push_back(body);
        } else {
            const dSoftBodyID body = add_soft(world, pile, i % 2 == 0 ? cube : slab);
            dSoftBodyRotate(body, p.turn);
            dSoftBodySetPosition(body, p.at[0], p.at[1], p.at[2]);
            dSoftBodySetLinearVel(body, v[0], v[1], v[2]);
            made_here.soft.push_back(body);
        }
    }
    return made_here;
}

PileState look_at(const PileBodies& bodies, double gravity) {
    PileState s;
    s.lowest = s.closest = std::numeric_limits<double>::infinity();
    std::vector<std::array<double, 3>> center;
    for (const dSoftBodyID body : bodies.soft) {
        dVector3 c;
        dSoftBodyGetCenterOfMass(body, c);
        center.push_back({c[0], c[1], c[2]});
        add_soft_state(body, c, s);
    }
    for (const dBodyID body : bodies.rigid) {
        const dReal* c = dBodyGetPosition(body);
        center.push_back({c[0], c[1], c[2]});
        add_rigid_state(body, s);
    }
    s.potential *= gravity;
    for (std::size_t i = 0; i < center.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            s.closest = std::min(s.closest, std::hypot(center[i][0] - center[k][0],
                                                       center[i][1] - center[k][1],
                                                       center[i][2] - center[k][2]));
    return s;
}

} // namespace scenes
