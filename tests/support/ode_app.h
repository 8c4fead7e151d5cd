#pragma once

#include <ode/ode.h>

namespace ode::test {

/// An ODE application as its users write them: a world, a space, a contact group, and a near
/// callback that makes contact joints of whatever dCollide finds. It knows nothing of soft bodies.
class OdeApp {
public:
    explicit OdeApp(dReal gravity_z = 0) {
        dInitODE2(0);
        world = dWorldCreate();
        dWorldSetGravity(world, 0, 0, gravity_z);
        space = dHashSpaceCreate(nullptr);
        contacts = dJointGroupCreate(0);
    }
    ~OdeApp() {
        dJointGroupDestroy(contacts);
        dSpaceDestroy(space);
        dWorldDestroy(world);
        dCloseODE();
    }
    OdeApp(const OdeApp&) = delete;
    OdeApp& operator=(const OdeApp&) = delete;

    void step(dReal h, int (*by)(dWorldID, dReal) = dWorldQuickStep) {
        dSpaceCollide(space, this, &OdeApp::near);
        by(world, h);
        dJointGroupEmpty(contacts);
    }

    /// A free sphere with its body at rest at z.
    dBodyID add_sphere(dReal radius, dReal mass, dReal z) {
        dBodyID body = dBodyCreate(world);
        dMass m;
        dMassSetSphereTotal(&m, mass, radius);
        dBodySetMass(body, &m);
        dBodySetPosition(body, 0, 0, z);
        dGeomSetBody(dCreateSphere(space, radius), body);
        return body;
    }

    dWorldID world;
    dSpaceID space;
    dJointGroupID contacts;
    int pairs_seen = 0; ///< by the near callback
    dReal bounce = 0;   ///< of all contacts
    decltype(&dJointCreateContact) join = &dJointCreateContact;
    dJointFeedback* feedback = nullptr; ///< the application's own, of the contact made last

private:
    static void near(void* data, dGeomID a, dGeomID b) {
        auto& app = *static_cast<OdeApp*>(data);
        ++app.pairs_seen;
        dContact contact[4] = {};
        const int n = dCollide(a, b, 4, &contact[0].geom, sizeof(dContact));
        for (int i = 0; i < n; ++i) {
            contact[i].surface.mode = dContactApprox1;
            contact[i].surface.mu = 0.5;
            if (app.bounce > 0) {
                contact[i].surface.mode |= dContactBounce;
                contact[i].surface.bounce = app.bounce;
                contact[i].surface.bounce_vel = 0.01;
            }
            const dJointID joint = app.join(app.world, app.contacts, &contact[i]);
            dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
            if (app.feedback)
                dJointSetFeedback(joint, app.feedback);
        }
    }
};

} // namespace ode::test
