#include "scenes/drop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace scenes {

using ode::soft::MeshHandle;

namespace {

/// Height of the lowest node [m].
double lowest(dSoftBodyID body) {
    const dReal* first = nullptr;
    int stride = 0;
    const int count = dSoftBodyGetPositions(body, &first, &stride);
    double z = std::numeric_limits<double>::infinity();
    for (int i = 0; i < count; ++i)
        z = std::min(z, first[i * stride + 2]);
    return z;
}

} // namespace

MeshHandle paper_bowl() {
    return MeshHandle(made(dSoftMeshCreateBowl(0.1, 0.005, std::numbers::pi / 2, 8, 48, 1)));
}

dSoftBodyID build(World& world, const Drop& drop) {
    dSoftSolid solid = dSoftSolidDefault();
    if (!dSoftSolidPreset(drop.material.c_str(), &solid))
        throw Refused("no such material");
    const MeshHandle mesh =
        drop.mesh.empty() ? paper_bowl() : MeshHandle(made(dSoftMeshLoad(drop.mesh.c_str())));

    dCreatePlane(world.space(), 0, 0, 1, 0);
    const dSoftBodyID body = made(dSoftBodyCreate(world.soft(), mesh, &solid));
    if ((drop.order && !dSoftBodySetOrder(body, drop.order)) ||
        !dSoftBodySetMaterialModel(body, drop.model.c_str()))
        throw Refused("the body can't be had in this form");
    const dQuaternion q = {std::cos(drop.tilt / 2), std::sin(drop.tilt / 2), 0, 0};
    dSoftBodyRotate(body, q);
    dVector3 center;
    dSoftBodyGetCenterOfMass(body, center);
    dSoftBodySetPosition(body, 0, 0, center[2] + drop.height - lowest(body));
    return body;
}

} // namespace scenes
