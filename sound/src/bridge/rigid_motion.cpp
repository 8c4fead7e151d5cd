#include "bridge/rigid_motion.h"

#include <Eigen/Dense>

namespace ode::sound {

RigidMotion::RigidMotion(dBodyID body) {
    if (!body)
        return;
    center = Vec3(dBodyGetPosition(body));
    velocity = Vec3(dBodyGetLinearVel(body));
    spin = Vec3(dBodyGetAngularVel(body));
    const dReal* q = dBodyGetQuaternion(body);
    turn = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    if (dBodyIsKinematic(body))
        return;
    dMass mass;
    dBodyGetMass(body, &mass);
    yields = 1.0 / mass.mass;
    Eigen::Matrix3d inertia;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            inertia(i, j) = mass.I[4 * i + j];
    const Eigen::Matrix3d r = turn.toRotationMatrix();
    turns_by = r * inertia.inverse() * r.transpose();
    pull = Vec3(dBodyGetForce(body)) * yields;
    if (dBodyGetGravityMode(body)) {
        dVector3 g;
        dWorldGetGravity(dBodyGetWorld(body), g);
        pull += Vec3(g);
    }
}

} // namespace ode::sound
