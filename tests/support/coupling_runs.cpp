#include "support/coupling_cases.h"

#include "couple/node_contact.h"
#include "integrate/central_difference.h"
#include "mesh/generate.h"
#include "model/stvk_linear.h"
#include "world/soft_world.h"

#include <cmath>
#include <ctime>

namespace ode::test {
namespace {

using namespace ode::soft;

constexpr double kReport = 16e-3; ///< [s]

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
Vec3 vec(const dReal* v) { return {v[0], v[1], v[2]}; }

/// 20 x 20 x 2 cm, 0.8 kg, 20 MPa, undamped. Mass and stiffness by the same factor keep its waves.
TetMesh plate_mesh() { return make_plate(0.2, 0.2, 0.02, 10, 10, 1); }
Solid plate_solid(const CouplingCase& c) {
    Solid s;
    s.young = 2e7 * c.soft_mass_factor;
    s.poisson = 0.3;
    s.density = 1000 * c.soft_mass_factor;
    return s;
}
std::vector<int> rim(const TetMesh& mesh) {
    std::vector<int> nodes;
    for (std::size_t i = 0; i < mesh.node.size(); ++i)
        if (mesh.node[i].head<2>().cwiseAbs().maxCoeff() > 0.0999)
            nodes.push_back(static_cast<int>(i));
    return nodes;
}

ContactLaw law() {
    ContactLaw l;
    l.friction = 0.3;
    l.damping = 0;
    // 0.2 MN/m a node, for all masses: k dt^2 / m is then 4e-4 on the lightest body, so that the
    // reference, whose contacts know bodies without their joints, errs by no more than that.
    l.stiffness = 5e8;
    return l;
}

double rigid_energy(const std::vector<dBodyID>& bodies) {
    double sum = 0;
    for (const dBodyID b : bodies) {
        dMass m;
        dBodyGetMass(b, &m);
        dVector3 w;
        dVector3 g;
        const dReal* spin = dBodyGetAngularVel(b);
        dBodyVectorFromWorld(b, spin[0], spin[1], spin[2], w);
        dWorldGetGravity(dBodyGetWorld(b), g);
        sum += m.mass * vec(dBodyGetLinearVel(b)).squaredNorm() / 2 +
               (m.I[0] * w[0] * w[0] + m.I[5] * w[1] * w[1] + m.I[10] * w[2] * w[2]) / 2 -
               m.mass * vec(g).dot(vec(dBodyGetPosition(b)));
    }
    return sum;
}

/// An ODE world with a rig in it.
struct Rigged {
    explicit Rigged(const CouplingCase& c) {
        dInitODE2(0);
        world = dWorldCreate();
        dWorldSetGravity(world, 0, 0, -9.81);
        space = dSimpleSpaceCreate(nullptr);
        bodies = c.rig(world, space);
    }
    ~Rigged() {
        dSpaceDestroy(space);
        dWorldDestroy(world);
        dCloseODE();
    }
    Rigged(const Rigged&) = delete;
    Rigged& operator=(const Rigged&) = delete;

    dWorldID world;
    dSpaceID space;
    std::vector<dBodyID> bodies;
};

/// Accelerations of the rig as its joints and gravity leave it. Steps the world twice.
std::vector<std::pair<Vec3, Vec3>> accelerations(const Rigged& rig) {
    const double dt = kCouplingSubstep;
    dWorldSetERP(rig.world, 0); // a joint's error is no acceleration
    for (const dBodyID b : rig.bodies)
        for (int i = 0; i < dBodyGetNumJoints(b); ++i)
            if (dJointGetType(dBodyGetJoint(b, i)) == dJointTypeBall)
                dJointSetBallParam(dBodyGetJoint(b, i), dParamERP, 0);
    const auto twists = [&] {
        std::vector<std::pair<Vec3, Vec3>> v;
        for (const dBodyID b : rig.bodies)
            v.emplace_back(vec(dBodyGetLinearVel(b)), vec(dBodyGetAngularVel(b)));
        return v;
    };
    dWorldStep(rig.world, dt);
    const auto first = twists();
    dWorldStep(rig.world, dt);
    auto second = twists();
    for (std::size_t i = 0; i < first.size(); ++i) {
        second[i].first = (second[i].first - first[i].first) / dt;
        second[i].second = (second[i].second - first[i].second) / dt;
    }
    return second;
}

/// ODE moves a body by its velocity at the end of a step, so what it stores is half a step old. The
/// same motion has other velocities under other steps: moves them by t.
void shift_velocities(const Rigged& rig, const std::vector<std::pair<Vec3, Vec3>>& a, double t) {
    for (std::size_t i = 0; i < rig.bodies.size(); ++i) {
        const Vec3 v = vec(dBodyGetLinearVel(rig.bodies[i])) + t * a[i].first;
        const Vec3 w = vec(dBodyGetAngularVel(rig.bodies[i])) + t * a[i].second;
        dBodySetLinearVel(rig.bodies[i], v.x(), v.y(), v.z());
        dBodySetAngularVel(rig.bodies[i], w.x(), w.y(), w.z());
    }
}

/// Sums contact impulses substep by substep.
class ForceWatch final : public Observer {
public:
    ForceWatch(const SoftWorld& world, const std::vector<dBodyID>& bodies, CouplingRun& run)
        : world_(world), bodies_(bodies), run_(run) {}
    bool wants_substeps() const noexcept override { return true; }
    void on_substep(const SubstepView& view) noexcept override {
        Vec3 now = Vec3::Zero();
        for (const dBodyID b : bodies_)
            if (const RigidShadow* shadow = world_.exchange().find_shadow(b))
                now += shadow->impulse().force;
        run_.peak = std::fmax(run_.peak, (now - before_).norm() / view.dt);
        before_ = now;
    }
    void on_step(SoftWorld&, double) noexcept override {
        run_.impulse += before_;
        before_.setZero();
    }
    void on_body_end(Body&) noexcept override {}
    void on_world_end(SoftWorld&) noexcept override {}

private:
    const SoftWorld& world_;
    const std::vector<dBodyID>& bodies_;
    CouplingRun& run_;
    Vec3 before_ = Vec3::Zero();
};

} // namespace

CouplingRun run_library(const CouplingCase& c, double h) {
    CouplingRun run;
    std::vector<std::pair<Vec3, Vec3>> start_acceleration;
    {
        const Rigged scratch(c);
        start_acceleration = accelerations(scratch);
    }
    Rigged rig(c);
    const TetMesh mesh = plate_mesh();
    {
        SoftWorld soft(rig.world, rig.space);
        const Solid solid = plate_solid(c);
        Body& body = soft.create_body(mesh, {&solid, 1});
        body.set_substep(kCouplingSubstep);
        body.set_contact_law(law());
        if (c.clamped)
            body.pin(rim(mesh));
        soft.add_observer(std::make_unique<ForceWatch>(soft, rig.bodies, run));
        run.energy_before = rigid_energy(rig.bodies);
        shift_velocities(rig, start_acceleration, -(h - kCouplingSubstep) / 2);
        const double start = cpu_seconds();
        const auto every = std::lround(kReport / h);
        for (long i = 1; i <= std::lround(c.seconds / h); ++i) {
            soft.step(h, &dWorldStep);
            run.steps_apart += soft.exchange().find_shadow(rig.bodies[0]) == nullptr ? 1 : 0;
            if (i % every == 0)
                run.path.push_back(vec(dBodyGetPosition(rig.bodies[0])));
        }
        run.seconds = cpu_seconds() - start;
        const Vec3 gravity(0, 0, -9.81);
        run.energy_after = body.kinetic_energy() + body.elastic_energy();
        if (!c.clamped)
            run.energy_after -= body.total_mass() * gravity.dot(body.center_of_mass());
        run.mirror_steps = soft.exchange().mirror_steps();
    }
    // Only the velocities of now are to be, not the two steps on trial.
    std::vector<TwinState> now;
    for (const dBodyID b : rig.bodies)
        now.emplace_back(b);
    const auto a = accelerations(rig);
    for (std::size_t i = 0; i < now.size(); ++i)
        now[i].apply(rig.bodies[i]);
    shift_velocities(rig, a, (h - kCouplingSubstep) / 2);
    run.energy_after += rigid_energy(rig.bodies);
    return run;
}

CouplingRun run_reference(const CouplingCase& c) {
    CouplingRun run;
    Rigged rig(c);
    const double dt = kCouplingSubstep;
    const TetMesh mesh = plate_mesh();
    const Surface surface = extract_surface(mesh);
    const StvkLinear model(mesh, plate_solid(c));
    const SurfaceNodes nodes(mesh, surface, model.mass());
    const std::size_t n = mesh.node.size();
    NodeState state{NodeArray(n), NodeArray(n)};
    NodeArray force(n);
    std::vector<double> inverse_mass;
    for (std::size_t i = 0; i < n; ++i) {
        state.position[i] = mesh.node[i];
        inverse_mass.push_back(1 / model.mass()[i]);
    }
    if (c.clamped)
        for (const int node : rim(mesh))
            inverse_mass[static_cast<std::size_t>(node)] = 0;
    const Vec3 gravity(0, 0, -9.81);

    struct Touch {
        dGeomID geom;
        std::unique_ptr<NodeContact> contact;
    };
    std::vector<Touch> touches;
    for (const dBodyID b : rig.bodies)
        for (dGeomID g = dBodyGetFirstGeom(b); g; g = dBodyGetNextGeom(g))
            touches.push_back({g, std::make_unique<NodeContact>(nodes, g)});
    CentralDifference integrator;
    run.energy_before = rigid_energy(rig.bodies);
    const double start = cpu_seconds();
    const auto every = std::lround(kReport / dt);
    for (std::size_t i = 0; i < n; ++i) // the velocity is half a substep old
        if (inverse_mass[i] != 0)
            state.velocity[i] = -dt / 2 * gravity;
    for (long i = 1; i <= std::lround(c.seconds / dt); ++i) {
        for (std::size_t k = 0; k < n; ++k)
            force[k] = model.mass()[k] * gravity;
        integrator.evaluate(model, state, force);
        Vec3 sum = Vec3::Zero();
        for (const Touch& touch : touches) {
            const auto shape = capture_shape(touch.geom);
            RigidShadow reader(shape->body, dt, dt);
            touch.contact->begin_step(*shape, law(), inverse_mass, dt);
            touch.contact->add_force(state.position, state.velocity, reader, dt, force);
            reader.advance(dt);
            const Vec3 f = reader.impulse().force / dt;
            const Vec3 t = reader.impulse().torque / dt;
            dBodyAddForce(shape->body, f.x(), f.y(), f.z());
            dBodyAddTorque(shape->body, t.x(), t.y(), t.z());
            sum += f;
        }
        run.impulse += dt * sum;
        run.peak = std::fmax(run.peak, sum.norm());
        integrator.step(model, {inverse_mass, 0}, dt, state, force);
        dWorldStep(rig.world, dt);
        run.length += dt * vec(dBodyGetLinearVel(rig.bodies[0])).norm();
        if (i % every == 0)
            run.path.push_back(vec(dBodyGetPosition(rig.bodies[0])));
    }
    run.seconds = cpu_seconds() - start;
    run.energy_after = rigid_energy(rig.bodies) + model.energy(state.position);
    for (std::size_t i = 0; i < n; ++i)
        run.energy_after += model.mass()[i] * (state.velocity[i].squaredNorm() / 2 -
                                               (c.clamped ? 0 : gravity.dot(state.position[i])));
    return run;
}

} // namespace ode::test
