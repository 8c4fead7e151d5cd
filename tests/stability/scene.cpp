#include "stability/scene.h"

#include <cmath>
#include <cstdio>

namespace ode::test {

using namespace ode::soft;

namespace {

Scene* listening = nullptr;

/// Tests alone may write a body's nodes.
NodeState& motion_of(Body& body) { return const_cast<NodeState&>(body.state()); }

} // namespace

bool Verdict::was_told(const std::string& words) const {
    for (const std::string& sentence : told)
        if (sentence.find(words) != std::string::npos)
            return true;
    return false;
}

bool Verdict::is_honest() const {
    return finite && world_intact && (!stopped || was_told("is stopped")) &&
           (least_jacobian > 0 || was_told("inside out") || was_told("is stopped"));
}

std::string Verdict::outcome() const {
    if (!is_honest())
        return finite ? "SILENT" : "NOT A NUMBER";
    std::string word = stopped               ? "stopped, told"
                       : last_jacobian <= 0  ? "inverted, told"
                       : least_jacobian <= 0 ? "recovered"
                                             : "steady";
    if (rollbacks > 0)
        word += ", redone " + std::to_string(rollbacks) + " x";
    return word;
}

Scene::Scene(double gravity) {
    dInitODE2(0);
    world = dWorldCreate();
    space = dHashSpaceCreate(nullptr);
    dWorldSetGravity(world, 0, 0, gravity);
    contacts_ = dJointGroupCreate(0);
    soft = std::make_unique<SoftWorld>(world, space);
    witness_ = add_ball(0.1, 1, {1e3, 0, 1e3}, {0.5, 0, 0});
    dBodySetGravityMode(witness_, 0); // it would come down in time
    listening = this;
    dSetMessageHandler(&Scene::hear);
    if (on_create)
        on_create(*this);
}

Scene::~Scene() {
    dSetMessageHandler(nullptr);
    listening = nullptr;
    soft.reset();
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space);
    dWorldDestroy(world);
    dCloseODE();
}

void Scene::hear(int, const char* text, va_list arguments) {
    char line[1024];
    std::vsnprintf(line, sizeof line, text, arguments);
    listening->verdict_.told.emplace_back(line);
}

Body& Scene::add(const TetMesh& mesh, const Solid& solid, const std::string& law, int order,
                 const std::string& integrator) {
    Body& body = soft->create_body(mesh, {&solid, 1});
    BodyForm form = body.form();
    form.model = law;
    form.order = order;
    form.integrator = integrator;
    body.set_form(form);
    return body;
}

dBodyID Scene::add_ball(double radius, double mass, const Vec3& at, const Vec3& velocity) {
    const dBodyID body = dBodyCreate(world);
    dMass m;
    dMassSetSphereTotal(&m, mass, radius);
    dBodySetMass(body, &m);
    dBodySetPosition(body, at.x(), at.y(), at.z());
    dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
    dGeomSetBody(dCreateSphere(space, radius), body);
    return body;
}

dBodyID Scene::add_box(const Vec3& size, double mass, const Vec3& at) {
    const dBodyID body = dBodyCreate(world);
    dMass m;
    dMassSetBoxTotal(&m, mass, size.x(), size.y(), size.z());
    dBodySetMass(body, &m);
    dBodySetPosition(body, at.x(), at.y(), at.z());
    dGeomSetBody(dCreateBox(space, size.x(), size.y(), size.z()), body);
    return body;
}

void Scene::near(void* data, dGeomID a, dGeomID b) {
    auto& scene = *static_cast<Scene*>(data);
    if (Body::behind(a) || Body::behind(b))
        return;
    dContact contact[8] = {};
    const int n = dCollide(a, b, 8, &contact[0].geom, sizeof(dContact));
    for (int i = 0; i < n; ++i) {
        contact[i].surface.mode = dContactApprox1;
        contact[i].surface.mu = 0.5;
        const dJointID joint = dJointCreateContact(scene.world, scene.contacts_, &contact[i]);
        scene.soft->note_contact(joint, contact[i]);
        dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
    }
}

void Scene::step(double h) {
    dSpaceCollide(space, this, &Scene::near);
    soft->step(h, dWorldQuickStep);
    dJointGroupEmpty(contacts_);
    if (std::isfinite(h))
        time_ += h;
    const dReal* at = dBodyGetPosition(witness_);
    verdict_.world_intact &=
        std::abs(at[0] - (1e3 + 0.5 * time_)) < 1e-9 * (1e3 + time_) && at[1] == 0 && at[2] == 1e3;
    verdict_.rollbacks = 0;
    verdict_.stopped = false;
    verdict_.last_jacobian = 1;
    for (const auto& body : soft->bodies()) {
        verdict_.stopped |= body->stopped();
        verdict_.rollbacks += body->rollbacks();
        const double j = body->extremes().min_jacobian;
        if (!body->stopped()) {
            verdict_.least_jacobian = std::fmin(verdict_.least_jacobian, j);
            verdict_.last_jacobian = std::fmin(verdict_.last_jacobian, j);
            if (body->budget().budget() > 0)
                verdict_.energy_share = std::fmax(
                    verdict_.energy_share, body->budget().energy() / body->budget().budget());
        }
        for (std::size_t i = 0; i < body->mass().size(); ++i)
            verdict_.finite &=
                body->state().position[i].allFinite() && body->state().velocity[i].allFinite();
    }
}

void Scene::run(double seconds, double h) {
    for (long n = std::lround(seconds / h); n > 0; --n)
        step(h);
}

Solid solid_of(double young, double poisson, double density) {
    Solid s;
    s.young = young;
    s.poisson = poisson;
    s.density = density;
    return s;
}

double wave_speed(const Solid& s) { return std::sqrt((s.lambda() + 2 * s.mu()) / s.density); }

void deform(Body& body, const std::function<Vec3(const Vec3&)>& place) {
    const Vec3 middle = body.center_of_mass();
    NodeArray& x = motion_of(body).position;
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = middle + place(Vec3(x[i]) - middle);
    body.add_spin(Vec3::Zero()); // tells the body that it was moved
}

void set_velocities(Body& body, const std::function<Vec3(const Vec3&)>& velocity) {
    const Vec3 middle = body.center_of_mass();
    NodeState& state = motion_of(body);
    for (std::size_t i = 0; i < state.velocity.size(); ++i)
        state.velocity[i] += velocity(Vec3(state.position[i]) - middle);
    body.add_spin(Vec3::Zero());
}

} // namespace ode::test
