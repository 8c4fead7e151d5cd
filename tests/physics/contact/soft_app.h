#pragma once

#include <ode_softbody/softbody.hpp>

#include <ode/ode.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ode::soft {

using Vec3 = Eigen::Vector3d;

/// An ODE application with soft bodies alone, frictionless and undamped unless told otherwise.
class SoftApp {
public:
    explicit SoftApp(double gravity = 0) {
        dInitODE2(0);
        world = dWorldCreate();
        dWorldSetGravity(world, 0, 0, -gravity);
        space = dHashSpaceCreate(nullptr);
        soft = dSoftWorldCreate(world, space);
    }
    ~SoftApp() {
        dSpaceDestroy(space);
        dWorldDestroy(world);
        dCloseODE();
    }
    SoftApp(const SoftApp&) = delete;
    SoftApp& operator=(const SoftApp&) = delete;

    void step(double h) {
        dSpaceCollide(space, nullptr, [](void*, dGeomID, dGeomID) {});
        dWorldQuickStep(world, h);
    }

    dSoftBodyID add(const MeshHandle& mesh, const dSoftSolid& solid, const Vec3& center,
                    const Vec3& velocity = Vec3::Zero(), double friction = 0) {
        const dSoftBodyID id = dSoftBodyCreate(soft, mesh, &solid);
        dSoftBodySetPosition(id, center.x(), center.y(), center.z());
        dSoftBodySetLinearVel(id, velocity.x(), velocity.y(), velocity.z());
        dSoftContact contact = dSoftContactDefault();
        contact.friction = friction;
        contact.damping = 0;
        dSoftBodySetContact(id, &contact);
        body.push_back(id);
        return id;
    }

    static dSoftSolid solid(double young, double density, double poisson = 0.3, double beta = 0) {
        dSoftSolid s = dSoftSolidDefault();
        s.young = young;
        s.density = density;
        s.poisson = poisson;
        s.alpha = 0; // drag against space would take momentum
        s.beta = beta;
        s.phi = s.psi = 0;
        return s;
    }

    Vec3 momentum() const {
        Vec3 sum = Vec3::Zero();
        for (const dSoftBodyID b : body)
            sum += momenta(b).first;
        return sum;
    }
    Vec3 angular_momentum() const {
        Vec3 sum = Vec3::Zero();
        for (const dSoftBodyID b : body)
            sum += momenta(b).second;
        return sum;
    }
    double energy() const {
        double sum = 0;
        for (const dSoftBodyID b : body) {
            const dSoftEnergy e = dSoftBodyGetEnergy(b);
            sum += e.kinetic + e.elastic;
        }
        return sum;
    }
    static Vec3 velocity(dSoftBodyID b) { return momenta(b).first / dSoftBodyGetMass(b); }
    static Vec3 center(dSoftBodyID b) {
        dVector3 c;
        dSoftBodyGetCenterOfMass(b, c);
        return {c[0], c[1], c[2]};
    }
    static std::vector<Vec3> positions(dSoftBodyID b) {
        const dReal* first = nullptr;
        int stride = 0;
        const int n = dSoftBodyGetPositions(b, &first, &stride);
        std::vector<Vec3> x;
        for (int i = 0; i < n; ++i)
            x.emplace_back(first[i * stride], first[i * stride + 1], first[i * stride + 2]);
        return x;
    }
    bool any_stopped() const {
        return std::any_of(body.begin(), body.end(), [](dSoftBodyID b) {
            dSoftStatus status{};
            status.struct_size = sizeof status;
            dSoftBodyGetStatus(b, &status);
            return status.stopped != 0;
        });
    }
    dSoftWorldStats stats() const {
        dSoftWorldStats s{};
        s.struct_size = sizeof s;
        dSoftWorldGetStats(soft, &s);
        return s;
    }

    dWorldID world;
    dSpaceID space;
    dSoftWorldID soft;
    std::vector<dSoftBodyID> body;

private:
    static std::pair<Vec3, Vec3> momenta(dSoftBodyID b) {
        dVector3 p, l;
        dSoftBodyGetMomentum(b, p, l);
        return {{p[0], p[1], p[2]}, {l[0], l[1], l[2]}};
    }
};

} // namespace ode::soft
