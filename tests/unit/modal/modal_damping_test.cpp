#include "modal/modal_damping.h"

#include "mesh/generate.h"
#include "mesh/promote.h"
#include "modal/modal_decay.h"
#include "modal/solve_modes.h"
#include "model/damping.h"
#include "model/make_model.h"
#include "unit/model/specimens.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ode::soft {
namespace {

constexpr double kInterval = 1e-5;

/// A ragged block of two orders that is held here and there.
struct Block {
    TetMesh mesh;
    std::vector<Solid> solid{rubber()};
    std::unique_ptr<ElasticModel> model;
    std::vector<double> inverse_mass, decay;
    std::vector<int> held;
    ModalModel modes;
    NodeState state;

    explicit Block(int order, std::vector<int> pins = {}) : held(std::move(pins)) {
        mesh = irregular_box({0.3, 0.2, 0.2}, 3, 2, 2);
        if (order == 2)
            mesh = promote_to_quadratic(mesh);
        model = make_model("stvk", mesh, solid);
        for (const double m : model->mass())
            inverse_mass.push_back(1 / m);
        for (const int node : held)
            inverse_mass[static_cast<std::size_t>(node)] = 0;
        ModalOptions options;
        options.order = order;
        options.mass = MassKind::kLumped;
        options.estimate = false;
        options.max_frequency = 1e6;
        options.max_modes = 7; // not a multiple of the kernel's tile
        options.clamped = held;
        modes = solve_modes(mesh, solid, options);
        for (std::size_t k = 0; k < modes.mode_count(); ++k)
            decay.push_back(100 * static_cast<double>(k + 1));
        state = {node_array(mesh.node), NodeArray(mesh.node.size())};
    }
    ModalDamping damping(double rest) const {
        return {model->mass(), inverse_mass, held, mesh.node, {modes, decay, rest, kInterval}};
    }
    void turn(const Quat& q) {
        state.position = rotated(state.position, q, {3, -2, 1});
        state.velocity = rotated(state.velocity, q, {0, 0, 0});
    }
    double kinetic() const {
        double sum = 0;
        for (std::size_t i = 0; i < inverse_mass.size(); ++i)
            sum += model->mass()[i] * state.velocity[i].squaredNorm() / 2;
        return sum;
    }
};

const Quat kTurn(Eigen::AngleAxisd(2.5, Vec3(1, -2, 0.5).normalized()));

// However the body is turned, modal velocities lose exp(-2 d dt) and nothing leaks into others.
TEST(ModalDamping, ScalesEachModeByItsOwnExponential) {
    for (const int order : {1, 2})
        for (const bool clamped : {false, true}) {
            Block b(order, clamped ? std::vector{0, 1, 2, 5, 7} : std::vector<int>{});
            for (std::size_t i = 0; i < b.inverse_mass.size(); ++i)
                for (std::size_t k = 0; k < b.modes.mode_count(); ++k)
                    b.state.velocity[i] += b.modes.shape_at(k, i);
            b.turn(kTurn);
            ModalDamping damping = b.damping(1000);
            damping.advance(0.3 * kInterval, b.state);
            EXPECT_NEAR(b.kinetic(), 3.5, 1e-9) << "too early";
            damping.advance(0.8 * kInterval, b.state);
            for (std::size_t k = 0; k < b.modes.mode_count(); ++k) {
                double rate = 0;
                for (std::size_t i = 0; i < b.inverse_mass.size(); ++i)
                    rate += b.model->mass()[i] *
                            (kTurn * b.modes.shape_at(k, i)).dot(Vec3(b.state.velocity[i]));
                EXPECT_NEAR(rate, std::exp(-2 * b.decay[k] * 1.1 * kInterval), 1e-9)
                    << order << clamped << k;
            }
        }
}

TEST(ModalDamping, KeepsMomentaAndNeverGivesEnergyWhateverTheShape) {
    for (const int order : {1, 2})
        for (const double bend : {0.0, 0.02, 0.1}) {
            Block b(order);
            b.state.position = disturbed(b.state.position, bend, 3);
            b.state.velocity = disturbed(b.state.velocity, 2, 4);
            b.turn(kTurn);
            const auto momenta = [&] {
                std::array<Vec3, 2> out{Vec3::Zero(), Vec3::Zero()};
                for (std::size_t i = 0; i < b.inverse_mass.size(); ++i) {
                    const Vec3 p = b.model->mass()[i] * b.state.velocity[i];
                    out[0] += p;
                    out[1] += b.state.position[i].cross(p);
                }
                return out;
            };
            const auto before = momenta();
            ModalDamping damping = b.damping(5000);
            double energy = b.kinetic();
            for (int n = 0; n < 50; ++n) {
                damping.advance(20 * kInterval, b.state);
                EXPECT_LE(b.kinetic(), energy * (1 + 1e-14));
                energy = b.kinetic();
            }
            const auto after = momenta();
            for (int i = 0; i < 2; ++i)
                EXPECT_LE((after[i] - before[i]).norm(), 1e-12 * b.solid[0].density * 0.012 * 10)
                    << bend;
        }
}

// Free, hung at one node, hung at two: what the supports leave is not braked; nor is a body turned
// inside out.
TEST(ModalDamping, LeavesRigidMotionAlone) {
    for (const std::size_t pins : {0u, 1u, 2u}) {
        Block b(1, std::vector<int>{3, 17});
        b.held.resize(pins);
        Block held(1, b.held);
        held.state.position = disturbed(held.state.position, 0.02, 5);
        const Vec3 pivot = pins > 0 ? Vec3(held.state.position[3]) : Vec3(0.1, 0, 0);
        const Vec3 spin = pins == 2 ? Vec3(held.state.position[17] - pivot) : Vec3(2, 3, -1);
        for (std::size_t i = 0; i < held.inverse_mass.size(); ++i)
            held.state.velocity[i] = spin.cross(held.state.position[i] - pivot);
        const NodeArray before = held.state.velocity;
        ModalDamping damping = held.damping(1e6);
        damping.advance(1, held.state);
        for (std::size_t i = 0; i < before.size(); ++i)
            EXPECT_LE((held.state.velocity[i] - before[i]).norm(), 1e-13) << pins;
    }
}

TEST(ModalDamping, WhatIsInNoModeDecaysByTheRateOfTheRest) {
    Block b(2);
    b.state.velocity = disturbed(b.state.velocity, 1, 8);
    Block still(2);
    still.state = b.state;
    ModalDamping everything = b.damping(1e9);
    everything.advance(1, still.state); // rigid motion alone is left
    b.decay.assign(b.decay.size(), 3000);
    ModalDamping even = b.damping(3000);
    const NodeState before = b.state;
    even.advance(1e-4, b.state);
    for (std::size_t i = 0; i < b.inverse_mass.size(); ++i) {
        const Vec3 rigid = still.state.velocity[i];
        EXPECT_LE(
            (b.state.velocity[i] - rigid - std::exp(-0.6) * (before.velocity[i] - rigid)).norm(),
            1e-12);
    }
}

TEST(ModalDamping, IsTheSameBitsEachTime) {
    Block a(2), b(2);
    for (Block* one : {&a, &b}) {
        one->state.velocity = disturbed(one->state.velocity, 1, 8);
        one->damping(100).advance(1e-4, one->state);
    }
    EXPECT_EQ(std::memcmp(a.state.velocity.data(), b.state.velocity.data(),
                          4 * sizeof(double) * a.state.velocity.size()),
              0);
}

} // namespace
} // namespace ode::soft
