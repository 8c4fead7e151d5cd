#include "contact/ball_impact.h"

#include "couple/surface_elasticity.h"
#include "integrate/central_difference.h"
#include "integrate/critical_step.h"
#include "mesh/generate.h"

#include <ode/ode.h>

#include <cmath>
#include <numeric>

namespace ode::soft {

Impact hertz_impact(double mass, double radius, double modulus, double speed) {
    const double k = hertz_stiffness(modulus, 1 / radius, 1 / radius);
    const double depth = std::pow(1.25 * mass * speed * speed / k, 0.4);
    const double time = 2.8683 * std::pow(mass * mass / (radius * modulus * modulus * speed), 0.2);
    return {time, k * std::pow(depth, 1.5), 0};
}

TetMesh graded_block(double side, int cells, double cell) {
    TetMesh mesh = make_box(Vec3::Constant(side), cells, cells, cells);
    const auto graded = [](double u, double first, double first_to) {
        const double cube = first * first * first;
        const double linear = (first_to - cube) / (first - cube);
        return linear * u + (1 - linear) * u * u * u;
    };
    for (Vec3& x : mesh.node) {
        for (int axis = 0; axis < 2; ++axis)
            x[axis] = side / 2 * graded(2 * x[axis] / side, 2.0 / cells, 2 * cell / side);
        x.z() = side / 2 - side * graded(0.5 - x.z() / side, 1.0 / cells, cell / side);
    }
    return mesh;
}

SoftSide::SoftSide(TetMesh mesh, const Solid& solid)
    : mesh_(std::move(mesh)), surface_(extract_surface(mesh_)),
      model_(make_model("stvk", mesh_, {&solid, 1})),
      nodes_(mesh_, surface_, model_->mass()), state_{NodeArray(mesh_.node.size()),
                                                      NodeArray(mesh_.node.size())},
      force_(mesh_.node.size()) {
    for (std::size_t i = 0; i < mesh_.node.size(); ++i)
        state_.position[i] = mesh_.node[i];
    for (const double m : model_->mass())
        inverse_mass_.push_back(1 / m);
    dt_ = 0.9 * critical_step(*model_, inverse_mass_, state_.position, 0.0);
    nodes_.elastic = measure_elasticity(mesh_, nodes_, *model_, {&solid, 1});
}

double SoftSide::mass() const {
    return std::accumulate(model_->mass().begin(), model_->mass().end(), 0.0);
}

double SoftSide::energy(const RigidShadow& rigid) const {
    double sum =
        model_->energy(state_.position) + rigid_mass_ * rigid.motion().velocity.squaredNorm() / 2;
    for (std::size_t i = 0; i < inverse_mass_.size(); ++i)
        sum += state_.velocity[i].squaredNorm() / inverse_mass_[i] / 2;
    return sum;
}

Impact SoftSide::run(const RigidShape& shape, const ContactLaw& law, RigidShadow& rigid,
                     double longest) {
    NodeContact contact(nodes_, nullptr);
    contact.begin_step(shape, law, inverse_mass_, dt_);
    CentralDifference integrator;
    const double before = energy(rigid);
    Impact out{};
    double first = -1;
    double last = 0;
    for (double t = 0; t < longest; t += dt_) {
        force_.set_zero();
        integrator.evaluate(*model_, state_, force_);
        Vec3 inner = Vec3::Zero();
        Vec3 all = Vec3::Zero();
        for (std::size_t i = 0; i < force_.size(); ++i)
            inner += force_[i];
        contact.add_force(state_.position, state_.velocity, rigid, dt_, force_);
        for (std::size_t i = 0; i < force_.size(); ++i)
            all += force_[i];
        rigid.advance(dt_);
        integrator.step(*model_, {inverse_mass_, 0}, dt_, state_, force_);
        const double press = (all - inner).norm();
        if (press > 1e-9 * out.peak) {
            first = first < 0 ? t : first;
            last = t;
        }
        out.peak = std::fmax(out.peak, press);
        if (first >= 0 && t > last + longest / 10)
            break;
    }
    // The substeps that lead in and out bear for half of their length in the mean.
    out.seconds = last - first;
    out.energy_error = energy(rigid) / before - 1;
    return out;
}

Impact SoftSide::strike(const RigidBall& ball) {
    dInitODE2(0);
    const dWorldID world = dWorldCreate();
    const dBodyID body = dBodyCreate(world);
    dMass mass;
    dMassSetSphereTotal(&mass, ball.mass, ball.radius);
    dBodySetMass(body, &mass);
    double top = -1;
    for (const Vec3& x : mesh_.node)
        top = std::fmax(top, x.z());
    dBodySetPosition(body, ball.over.x(), ball.over.y(), top + ball.radius + 1e-7);
    dBodySetLinearVel(body, 0, 0, -ball.speed);
    rigid_mass_ = ball.mass;
    RigidShape shape;
    shape.kind = ShapeKind::sphere;
    shape.size.x() = ball.radius;
    shape.body = body;
    ContactLaw law;
    law.friction = 0;
    law.damping = 0;
    law.rigid_compliance = ball.compliance;
    RigidShadow shadow(body, 1, dt_);
    const Impact out = run(shape, law, shadow, 1.5e-4);
    dWorldDestroy(world);
    dCloseODE();
    return out;
}

Impact SoftSide::drop_on_floor(double speed, double radius, int corners, double longest) {
    Vec3 lowest = Vec3::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(corners); ++i)
        lowest += mesh_.node[static_cast<std::size_t>(surface_.triangle[0][i])];
    const Quat turn = Quat::FromTwoVectors(lowest, -Vec3::UnitZ());
    for (std::size_t i = 0; i < mesh_.node.size(); ++i) {
        state_.position[i] = turn * mesh_.node[i] + (radius + 1e-7) * Vec3::UnitZ();
        state_.velocity[i] = -speed * Vec3::UnitZ();
    }
    ContactLaw law;
    law.friction = 0;
    law.damping = 0;
    RigidShadow ground;
    return run(RigidShape{}, law, ground, longest);
}

} // namespace ode::soft
