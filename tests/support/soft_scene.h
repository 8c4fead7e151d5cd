#pragma once

#include "couple/soft_contact.h"
#include "couple/volume_contact.h"
#include "integrate/central_difference.h"
#include "integrate/critical_step.h"
#include "mesh/surface.h"
#include "model/make_model.h"

#include <ctime>
#include <memory>
#include <vector>

namespace ode::soft {

/// A free body of one solid, as contact sees it.
struct SceneBody {
    SceneBody(TetMesh of, const Solid& solid, const char* law_name)
        : mesh(std::move(of)), surface(extract_surface(mesh)),
          model(make_model(law_name, mesh, {&solid, 1})), nodes(mesh, surface, model->mass()),
          soft(nodes, mesh.node),
          volume(mesh, soft), state{NodeArray(mesh.node.size()), NodeArray(mesh.node.size())},
          force(mesh.node.size()) {
        for (std::size_t i = 0; i < mesh.node.size(); ++i)
            state.position[i] = mesh.node[i];
        for (const double m : model->mass())
            inverse_mass.push_back(1 / m);
        critical = critical_step(*model, inverse_mass, state.position, 0);
    }
    SceneBody(const SceneBody&) = delete;
    SceneBody& operator=(const SceneBody&) = delete;

    void place(const Vec3& center, const Quat& turn, const Vec3& velocity,
               const Vec3& spin = Vec3::Zero()) {
        const Vec3 middle = this->center();
        for (std::size_t i = 0; i < mesh.node.size(); ++i) {
            const Vec3 arm = turn * Vec3(state.position[i] - middle);
            state.position[i] = center + arm;
            state.velocity[i] = velocity + spin.cross(arm);
        }
    }
    double mass() const {
        double sum = 0;
        for (const double m : model->mass())
            sum += m;
        return sum;
    }
    Vec3 weighted(const NodeArray& field) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < mesh.node.size(); ++i)
            sum += model->mass()[i] * field[i];
        return sum;
    }
    Vec3 center() const { return weighted(state.position) / mass(); }
    Vec3 velocity() const { return weighted(state.velocity) / mass(); }
    Vec3 angular_momentum() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < mesh.node.size(); ++i)
            sum += model->mass()[i] * state.position[i].cross(state.velocity[i]);
        return sum;
    }

    TetMesh mesh;
    Surface surface;
    std::unique_ptr<ElasticModel> model;
    SurfaceNodes nodes;
    SoftSurface soft;
    SoftVolume volume;
    NodeState state;
    NodeArray force;
    std::vector<double> inverse_mass;
    double critical; ///< [s]
    ContactLaw law{0, 0, 0};
};

/// Soft bodies in empty space, stepped as the world steps them, without ODE.
class SoftScene {
public:
    SceneBody& add(TetMesh mesh, const Solid& solid, const char* law = "stvk") {
        return *body_.emplace_back(std::make_unique<SceneBody>(std::move(mesh), solid, law));
    }
    /// Makes all bodies meet each other. @param dt  substep; stiffness is derived
    /// from each body's own, as in a world.
    void begin(double dt, bool by_volume = false) {
        dt_ = dt;
        contact_.clear();
        for (std::size_t i = 0; i < body_.size(); ++i)
            for (std::size_t k = i + 1; k < body_.size(); ++k)
                contact_.push_back({body_[i].get(), body_[k].get(),
                                    make_contact(*body_[i], *body_[k], by_volume)});
    }
    /// As ODE's steps do. Friction remembers.
    void begin_step() {
        for (Contact& c : contact_)
            c.law->begin_step({c.a->soft, c.a->law, std::max(dt_, 0.9 * c.a->critical)},
                              {c.b->soft, c.b->law, std::max(dt_, 0.9 * c.b->critical)});
    }
    void advance() {
        for (const auto& b : body_) {
            b->force.set_zero();
            integrator_.evaluate(*b->model, b->state, b->force);
            for (std::size_t i = 0; i < b->mesh.node.size(); ++i)
                b->force[i] += b->model->mass()[i] * gravity;
        }
        ++substep_;
        const double start = cpu_seconds();
        for (Contact& c : contact_) {
            const SoftContactTally t = c.law->add_force(side(*c.a), side(*c.b), dt_, substep_);
            tally.looks += t.looks;
            tally.tests += t.tests;
            tally.bearing += t.bearing;
            bearing = t.bearing;
        }
        contact_seconds += cpu_seconds() - start;
        for (const auto& b : body_)
            integrator_.step(*b->model, {b->inverse_mass, 0}, dt_, b->state, b->force);
    }
    /// Steps on and measures the energy that leapfrog keeps between its kicks: kinetic from the
    /// velocities before and after, v- v+ / 2, elastic at the position between them [J]. The mean
    /// of v^2 / 2 of one side alone would count vibration near the critical step several times.
    double advance_and_measure() {
        double sum = 0;
        std::vector<NodeArray> before;
        for (const auto& b : body_) {
            before.push_back(b->state.velocity);
            sum += b->model->energy(b->state.position);
        }
        advance();
        for (std::size_t k = 0; k < body_.size(); ++k)
            for (std::size_t i = 0; i < body_[k]->mesh.node.size(); ++i)
                sum +=
                    before[k][i].dot(body_[k]->state.velocity[i]) * body_[k]->model->mass()[i] / 2;
        return sum;
    }
    Vec3 momentum() const {
        Vec3 sum = Vec3::Zero();
        for (const auto& b : body_)
            sum += b->weighted(b->state.velocity);
        return sum;
    }
    Vec3 angular_momentum() const {
        Vec3 sum = Vec3::Zero();
        for (const auto& b : body_)
            sum += b->angular_momentum();
        return sum;
    }

    Vec3 gravity = Vec3::Zero();
    SoftContactTally tally;
    std::size_t bearing = 0;    ///< points of the last pair in the last substep
    double contact_seconds = 0; ///< CPU, the clock's own call (0.2 us) included

private:
    struct Contact {
        SceneBody* a;
        SceneBody* b;
        std::unique_ptr<PairContact> law;
    };
    static std::unique_ptr<PairContact> make_contact(SceneBody& a, SceneBody& b, bool by_volume) {
        if (by_volume)
            return std::make_unique<VolumeContact>(a.volume, b.volume);
        return std::make_unique<SoftContact>(a.soft, b.soft);
    }
    static double cpu_seconds() {
        timespec now{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }
    static SoftSide side(SceneBody& b) {
        return {b.state.position, b.state.velocity, b.inverse_mass, b.force};
    }

    double dt_ = 0;
    CentralDifference integrator_;
    std::vector<std::unique_ptr<SceneBody>> body_;
    std::vector<Contact> contact_;
    unsigned long substep_ = 0;
};

} // namespace ode::soft
