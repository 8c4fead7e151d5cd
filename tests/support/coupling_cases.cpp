#include "support/coupling_cases.h"

#include <cstdio>

namespace ode::test {
namespace {

using soft::Vec3;

dBodyID ball(dWorldID world, dSpaceID space, double radius, double mass, const Vec3& at,
             const Vec3& velocity) {
    const dBodyID b = dBodyCreate(world);
    dMass m;
    dMassSetSphereTotal(&m, mass, radius);
    dBodySetMass(b, &m);
    dBodySetPosition(b, at.x(), at.y(), at.z());
    dBodySetLinearVel(b, velocity.x(), velocity.y(), velocity.z());
    dGeomSetBody(dCreateSphere(space, radius), b);
    return b;
}

/// A rod of 0.3 kg along x, hinged about y at its far end; its tip carries a ball of 1 cm that
/// touches the plate's face (z = 1 cm) half a millimetre later, at 1 m/s.
std::vector<dBodyID> hinged_rod(dWorldID world, dSpaceID space) {
    const double length = 0.3;
    const dBodyID b = dBodyCreate(world);
    dMass m;
    dMassSetBoxTotal(&m, 0.3, length, 0.02, 0.02);
    dBodySetMass(b, &m);
    const Vec3 tip(0.013, 0.007, 0.0205);
    const Vec3 center = tip + Vec3(length / 2, 0, 0);
    dBodySetPosition(b, center.x(), center.y(), center.z());
    const double spin = -1 / length; // of the tip downwards: v = w x (-length, 0, 0)
    dBodySetAngularVel(b, 0, spin, 0);
    dBodySetLinearVel(b, 0, 0, spin * length / 2);
    const dGeomID g = dCreateSphere(space, 0.01);
    dGeomSetBody(g, b);
    dGeomSetOffsetPosition(g, -length / 2, 0, 0);
    const dJointID hinge = dJointCreateHinge(world, nullptr);
    dJointAttach(hinge, b, nullptr);
    dJointSetHingeAnchor(hinge, tip.x() + length, tip.y(), tip.z());
    dJointSetHingeAxis(hinge, 0, 1, 0);
    return {b};
}

/// A ball of 0.1 kg on a massless rod of 0.2 m that swings down on the plate.
std::vector<dBodyID> swinging_ball(dWorldID world, dSpaceID space) {
    const Vec3 at(0.013, 0.007, 0.0305);
    const dBodyID b = ball(world, space, 0.02, 0.1, at, {0, 0, -1});
    const dJointID joint = dJointCreateBall(world, nullptr);
    dJointAttach(joint, b, nullptr);
    dJointSetBallAnchor(joint, at.x() + 0.2, at.y(), at.z() + 0.1);
    const Vec3 arm = at - Vec3(at.x() + 0.2, at.y(), at.z() + 0.1);
    const Vec3 spin = arm.cross(Vec3(0, 0, -1)) / arm.squaredNorm();
    const Vec3 v = spin.cross(arm);
    dBodySetLinearVel(b, v.x(), v.y(), v.z());
    dBodySetAngularVel(b, spin.x(), spin.y(), spin.z());
    return {b};
}

/// Four balls of 50 g in a line, 4 cm apart, the first of them joined to the world; they fall
/// level.
std::vector<dBodyID> chain(dWorldID world, dSpaceID space) {
    std::vector<dBodyID> links;
    const Vec3 start(0.013, 0.007, 0.0255);
    for (int i = 0; i < 4; ++i)
        links.push_back(ball(world, space, 0.015, 0.05, start + i * Vec3(0.04, 0, 0.002),
                             {0, 0, -1 + 0.25 * i}));
    for (std::size_t i = 0; i < 4; ++i) {
        const dJointID joint = dJointCreateBall(world, nullptr);
        dJointAttach(joint, links[i], i < 3 ? links[i + 1] : nullptr);
        const Vec3 at = start + (static_cast<double>(i) + 0.5) * Vec3(0.04, 0, 0.002);
        dJointSetBallAnchor(joint, at.x(), at.y(), at.z());
    }
    return links;
}

} // namespace

std::vector<CouplingCase> coupling_cases() {
    CouplingCase rod{.name = "hinged rod on a clamped plate", .rig = hinged_rod};
    CouplingCase swing{.name = "swinging ball on a clamped plate", .rig = swinging_ball};
    CouplingCase links{.name = "ball and chain on a clamped plate", .seconds = 0.064, .rig = chain};
    return {rod, swing, links};
}

CouplingCase mass_ratio_case(double ratio) {
    CouplingCase c{.name = "hinged rod on a free plate, soft:rigid ", .rig = hinged_rod};
    char text[16];
    std::snprintf(text, sizeof text, "%g", ratio);
    c.name += text;
    c.clamped = false;
    c.seconds = 0.048;
    c.soft_mass_factor = ratio * 0.3 / 0.8;
    return c;
}

} // namespace ode::test
