#include "scenes/chimes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scenes {
namespace {

constexpr double kNode = 0.2242;  // of its length from the end the lowest mode stands still
constexpr double kElement = 0.03; // [m]
constexpr double kThread = 0.05;  // from the frame to the tube's hole [m]

/// The length that has this first partial.
double length_of(ode::soft::TimoshenkoTube tube, double note) {
    double low = 0.05, high = 3.0;
    for (int i = 0; i < 60; ++i) {
        tube.length = 0.5 * (low + high);
        (tube.frequencies(1)[0] > note ? low : high) = tube.length;
    }
    return low;
}

/// Keeps two points at their distance: a thread that is always taut.
void hang(World& world, dBodyID body, const dVector3 from, const dVector3 to, dBodyID above) {
    const dJointID thread = dJointCreateDBall(world.ode(), nullptr);
    dJointAttach(thread, body, above);
    dJointSetDBallAnchor1(thread, to[0], to[1], to[2]);
    dJointSetDBallAnchor2(thread, from[0], from[1], from[2]);
}

ChimeBodies::Tube make_tube(World& world, const Chimes& c, double note, double angle) {
    const dSoftSolid metal = chime_metal();
    ChimeBodies::Tube tube{};
    tube.theory = {0, c.outer, c.inner, metal.young, metal.poisson, metal.density};
    const double length = tube.theory.length = length_of(tube.theory, note);
    // Long elements do: cubic shapes follow the fourth partial within a cent.
    const int along = static_cast<int>(std::lround(length / kElement));
    tube.mesh =
        ode::soft::MeshHandle(made(dSoftMeshCreateTube(length, c.outer, c.inner, along, 12, 1)));

    tube.body = dBodyCreate(world.ode());
    const double area = std::numbers::pi * (c.outer * c.outer - c.inner * c.inner);
    const double m = metal.density * area * length;
    const double square = c.outer * c.outer + c.inner * c.inner;
    dMass mass;
    dMassSetParameters(&mass, m, 0, 0, 0, m * (3 * square + length * length) / 12,
                       m * (3 * square + length * length) / 12, m * square / 2, 0, 0, 0);
    dBodySetMass(tube.body, &mass);
    const double x = c.ring * std::cos(angle), y = c.ring * std::sin(angle);
    const double hole = c.top - kThread;
    dBodySetPosition(tube.body, x, y, hole + kNode * length - length / 2);
    dBodySetDamping(tube.body, 2e-3, 4e-3); // of the air, a second; ODE's is a step's
    const dGeomID geom = dCreateCylinder(world.space(), c.outer, length);
    dGeomSetBody(geom, tube.body);
    const dVector3 frame = {x, y, c.top}, lug = {x, y, hole};
    hang(world, tube.body, frame, lug, nullptr);
    return tube;
}

} // namespace

dSoftSolid chime_metal() {
    dSoftSolid metal = dSoftSolidDefault();
    if (!dSoftSolidPreset("aluminium", &metal) || !dSoftSolidSetT60(&metal, 500, 6, 5000, 2))
        throw Refused("no aluminium");
    return metal;
}

void wind(double mean, unsigned seed, double time, double out[2]) {
    // Slow waves of incommensurable periods; the seed shifts them.
    const double shift = 17.3 * seed;
    const double t = time + shift;
    const double force = 0.55 + 0.45 * std::sin(2 * std::numbers::pi * t / 5.3) *
                                    std::cos(2 * std::numbers::pi * t / 13.7);
    const double flutter = 0.35 * std::sin(2 * std::numbers::pi * t / 0.83) +
                           0.25 * std::sin(2 * std::numbers::pi * t / 0.51 + 1.0);
    const double speed = mean * std::max(0.0, force + flutter);
    const double way =
        2 * std::numbers::pi * t / 9.1 + 0.9 * std::sin(2 * std::numbers::pi * t / 2.3);
    out[0] = speed * std::cos(way);
    out[1] = speed * std::sin(way);
}

void ChimeBodies::blow(double time) const {
    constexpr double kAir = 1.21, kDrag = 1.2, kArea = 0.08 * 0.10; // [kg/m^3], [-], [m^2]
    double air[2];
    wind(gust, seed, time, air);
    const dReal* v = dBodyGetLinearVel(sail);
    const double x = air[0] - v[0], y = air[1] - v[1];
    const double push = 0.5 * kAir * kDrag * kArea * std::hypot(x, y);
    dBodyAddForce(sail, push * x, push * y, 0);
}

ChimeBodies build(World& world, const Chimes& c) {
    ChimeBodies out{};
    out.gust = c.gust;
    out.seed = c.seed;
    double longest = 0;
    for (std::size_t i = 0; i < c.notes.size(); ++i) {
        const double angle =
            2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(c.notes.size());
        out.tube.push_back(make_tube(world, c, c.notes[i], angle));
        longest = std::max(longest, out.tube.back().theory.length);
    }
    // The clapper strikes below the middle, where all low modes move.
    const double height = c.top - kThread + kNode * longest - 0.62 * longest;
    out.clapper = dBodyCreate(world.ode());
    dMass mass;
    dMassSetSphereTotal(&mass, 0.06, c.clapper);
    dBodySetMass(out.clapper, &mass);
    dBodySetPosition(out.clapper, 0, 0, height);
    dBodySetDamping(out.clapper, 1e-3, 5e-3);
    dGeomSetBody(dCreateSphere(world.space(), c.clapper), out.clapper);
    const dVector3 frame = {0, 0, c.top}, lug = {0, 0, height};
    hang(world, out.clapper, frame, lug, nullptr);

    out.sail = dBodyCreate(world.ode());
    dMassSetBoxTotal(&mass, 0.012, 0.08, 0.004, 0.10);
    dBodySetMass(out.sail, &mass);
    const double below = height - 0.25;
    dBodySetPosition(out.sail, 0, 0, below);
    dBodySetDamping(out.sail, 2e-3, 2e-2);
    const dVector3 under = {0, 0, height - c.clapper}, top = {0, 0, below + 0.05};
    hang(world, out.sail, under, top, out.clapper);
    return out;
}

} // namespace scenes
