// The cubic tier's energy against the finite elements that it was made of.
#include "mesh/generate.h"
#include "mesh/promote.h"
#include "model/make_model.h"
#include "model/materials.h"
#include "reduced/condense.h"
#include "reduced/pair_loads.h"

#include <gtest/gtest.h>

#include <random>

namespace ode::soft {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A steel bowl of few elements, its modes and its forces.
struct Bowl {
    explicit Bowl(int order, bool held = false) {
        solid = find_material("steel")->solid;
        solid.beta = solid.phi = solid.psi = 0;
        mesh = make_bowl(0.1, 0.005, 1.4, 3, 12, 1);
        if (order == 2)
            mesh = promote_to_quadratic(mesh);
        if (held)
            for (std::size_t i = 0; i < mesh.node.size(); ++i)
                if (mesh.node[i].z() < -0.09)
                    options.clamped.push_back(static_cast<int>(i));
        options.order = order;
        options.mass = MassKind::kLumped;
        options.estimate = false;
        options.max_frequency = 150e3;
        options.max_modes = 60;
        modes = solve_modes(mesh, {&solid, 1}, options);
        model = make_model("stvk", mesh, {&solid, 1});
    }
    /// -force at rest + u.
    VectorXd resistance(const VectorXd& u) const {
        NodeArray x(mesh.node.size()), v(x.size()), f(x.size());
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = mesh.node[i] + u.segment<3>(static_cast<Index>(3 * i));
        model->add_force(x, v, f);
        VectorXd out(u.size());
        for (std::size_t i = 0; i < x.size(); ++i)
            out.segment<3>(static_cast<Index>(3 * i)) = -f[i];
        return out;
    }
    Eigen::Map<const Eigen::MatrixXd> phi() const {
        return {modes.shape.data(), static_cast<Index>(3 * modes.node_count),
                static_cast<Index>(modes.mode_count())};
    }
    double omega2(std::size_t k) const { return eigenvalue_of(modes.frequency[k]); }
    std::vector<double> mass() const { return {model->mass().begin(), model->mass().end()}; }

    Solid solid;
    TetMesh mesh;
    ModalOptions options;
    ModalModel modes;
    std::unique_ptr<ElasticModel> model;
};

VectorXd some_amplitudes(Index count, double size) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    VectorXd q(count);
    for (Index i = 0; i < count; ++i)
        q[i] = size * normal(random);
    return q;
}

VectorXd products(const PairOrder& order, const VectorXd& q) {
    VectorXd p(static_cast<Index>(order.count()));
    for (std::size_t i = 0; i < order.modes; ++i)
        for (std::size_t j = i; j < order.modes; ++j)
            p[static_cast<Index>(order.at(i, j))] =
                q[static_cast<Index>(i)] * q[static_cast<Index>(j)];
    return p;
}

class Loads : public testing::TestWithParam<int> {};

// Even and odd parts of the force at u and -u are what is of second degree, and what is of first
// and third: no more degrees there are. Doubles cancel to 1e-16 of the linear part, 1e3 times the
// others here.
TEST_P(Loads, AreWhatTheElementsAnswer) {
    const Bowl bowl(GetParam());
    constexpr std::size_t kKept = 7;
    const PairLoads loads = pair_loads(bowl.mesh, {&bowl.solid, 1}, bowl.modes, kKept);
    const Eigen::MatrixXd phi = bowl.phi().leftCols(kKept);
    const VectorXd q = some_amplitudes(kKept, 2e-4), u = phi * q;
    const VectorXd p = products(loads.order, q);
    const VectorXd there = bowl.resistance(u), back = bowl.resistance(-u);
    const VectorXd even = (there + back) / 2;
    EXPECT_LT((loads.load * p - even).norm(), 1e-9 * even.norm());
    // Third degree: from twice the displacement.
    const VectorXd odd = (there - back) / 2;
    const VectorXd odd2 = (bowl.resistance(2 * u) - bowl.resistance(-2 * u)) / 2;
    const VectorXd third = phi.transpose() * (odd2 - 2 * odd) / 6;
    EXPECT_NEAR(q.dot(third) / 4, p.dot(loads.quartic * p), 1e-8 * std::fabs(q.dot(third)));
}

INSTANTIATE_TEST_SUITE_P(Orders, Loads, testing::Values(1, 2));

struct Condensed : testing::TestWithParam<std::tuple<int, bool, std::size_t>> {
    Condensed()
        : bowl(std::get<0>(GetParam()), std::get<1>(GetParam())),
          parts(condense(bowl.mesh, {&bowl.solid, 1}, bowl.options, bowl.modes, bowl.mass(),
                         {kKept, std::get<2>(GetParam()), 1000})),
          terms(parts, kUnit), work(terms.make_work()) {}

    /// Of all that moves: kept modes q, driven ones r, and what follows.
    VectorXd displacement(const VectorXd& q, const VectorXd& r) {
        VectorXd u = bowl.phi().leftCols(q.size()) * q;
        u += bowl.phi().middleCols(q.size(), r.size()) * r;
        std::vector<double> place(terms.columns()), speed(terms.columns());
        const VectorXd still = VectorXd::Zero(q.size());
        terms.follow({q.data(), kKept}, {still.data(), kKept}, place, speed, work);
        for (Index n = 0; n < u.size(); ++n)
            for (std::size_t s = 0; s < terms.following(); ++s)
                u[n] += place[s] *
                        static_cast<double>(
                            terms.shape()[static_cast<std::size_t>(n) * terms.columns() + s]);
        return u;
    }
    VectorXd force(const VectorXd& amplitude) {
        VectorXd out(amplitude.size());
        terms.evaluate(terms.levels() - 1, {amplitude.data(), terms.moved()},
                       {out.data(), terms.moved()}, work);
        return out;
    }
    double energy(const VectorXd& amplitude) {
        VectorXd out(amplitude.size());
        return terms.evaluate(terms.levels() - 1, {amplitude.data(), terms.moved()},
                              {out.data(), terms.moved()}, work);
    }

    static constexpr std::size_t kKept = 6;
    static constexpr double kUnit = 2e-3;
    const Bowl bowl;
    const CubicTerms::Coefficients parts;
    const CubicTerms terms;
    CubicTerms::Work work;
};

// Single precision: energies to some 1e-6, their differences over 1e-2 to 1e-3.
TEST_P(Condensed, ForceIsTheEnergysSlope) {
    const VectorXd a = some_amplitudes(static_cast<Index>(terms.moved()), 1e-3);
    const VectorXd f = force(a);
    for (Index k = 0; k < a.size(); ++k) {
        constexpr double h = 2e-5;
        VectorXd up = a, down = a;
        up[k] += h;
        down[k] -= h;
        EXPECT_NEAR(-(energy(up) - energy(down)) / (2 * h), f[k], 2e-3 * f.norm()) << k;
    }
}

// With all that follows the body at rest but for its kept modes: forces on what follows are of
// third degree, and those on kept modes are the polynomial's up to the fourth.
TEST_P(Condensed, ForceIsTheElementsAtTheCondensedDisplacement) {
    const VectorXd direction = some_amplitudes(kKept, 1);
    // The coefficient of third degree: without the linear one, of which eigenvalues are right to
    // ten digits only, and less that of fifth degree, which is left out. The polynomial, in single
    // precision, is asked where its third degree is the largest.
    const auto third = [&](auto answer, double s) {
        const auto odd = [&](double size) { return VectorXd((answer(size) - answer(-size)) / 2); };
        const auto at = [&](double size) {
            return VectorXd((odd(2 * size) - 2 * odd(size)) / (6 * size * size * size));
        };
        return VectorXd((4 * at(s) - at(2 * s)) / 3);
    };
    VectorXd driven_rest = VectorXd::Zero(static_cast<Index>(parts.driven));
    const auto driven_at = [&](double size) { // where the driven ones would come to rest
        VectorXd all = VectorXd::Zero(static_cast<Index>(terms.moved()));
        all.head(kKept) = size * direction;
        const VectorXd f = force(all);
        VectorXd r = driven_rest;
        for (Index m = 0; m < r.size(); ++m)
            r[m] =
                f[static_cast<Index>(kKept) + m] / bowl.omega2(kKept + static_cast<std::size_t>(m));
        return r;
    };
    const auto elements = [&](double size) {
        const VectorXd q = size * direction;
        VectorXd out = bowl.phi().leftCols(kKept).transpose() *
                       bowl.resistance(displacement(q, driven_at(size)));
        for (std::size_t k = 0; k < kKept; ++k)
            out[static_cast<Index>(k)] -= bowl.omega2(k) * q[static_cast<Index>(k)];
        return out;
    };
    const auto polynomial = [&](double size) {
        VectorXd all(static_cast<Index>(terms.moved()));
        all << size * direction, driven_at(size);
        return VectorXd(-force(all).head(kKept));
    };
    const VectorXd expected = third(elements, 2e-5), got = third(polynomial, 10);
    std::printf("third degree %g, off by %.2g\n", expected.norm(),
                (got - expected).norm() / expected.norm());
    // Modes from Lanczos are orthogonal to what follows to some digits only: 1e-6 on linear
    // elements, 3e-6 to 2e-5 on quadratic ones.
    EXPECT_LT((got - expected).norm(), 3e-5 * expected.norm());
    const auto second = [&](auto answer) {
        const auto even = [&](double size) {
            return VectorXd((answer(size) + answer(-size)) / (2 * size * size));
        };
        constexpr double s = 2e-5;
        return VectorXd((4 * even(s) - even(2 * s)) / 3);
    };
    const VectorXd expected2 = second(elements), got2 = second(polynomial);
    EXPECT_LT((got2 - expected2).norm(), 1e-6 * expected2.norm());
    // What follows is where nothing pushes it any more, to second degree.
    const auto left = [&](double size) {
        const VectorXd q = size * direction;
        VectorXd f = bowl.resistance(displacement(q, driven_at(size)));
        const auto m = bowl.mass();
        for (std::size_t k = 0; k < kKept; ++k) { // their own forces apart
            const VectorXd phi = bowl.phi().col(static_cast<Index>(k));
            const double push = phi.dot(f);
            for (Index n = 0; n < f.size(); ++n)
                f[n] -= push * m[static_cast<std::size_t>(n / 3)] * phi[n];
        }
        return f;
    };
    if (!std::get<1>(GetParam())) {
        const VectorXd unmoved = bowl.phi().leftCols(kKept) * (1e-4 * direction);
        const double all = ((bowl.resistance(unmoved) + bowl.resistance(-unmoved)) / 2).norm();
        EXPECT_LT(((left(1e-4) + left(-1e-4)) / 2).norm(), 0.02 * all);
    }
}

INSTANTIATE_TEST_SUITE_P(Bowls, Condensed,
                         testing::Values(std::tuple(1, false, 0), std::tuple(2, false, 0),
                                         std::tuple(2, false, 9), std::tuple(2, true, 5)));

/// Fourteen kept modes and three driven ones of no body.
CubicTerms some_terms() {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto some = [&](Index rows, Index columns) {
        return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
    };
    CubicTerms::Coefficients c;
    c.order.modes = 14;
    c.driven = 3;
    const auto pairs = static_cast<Index>(c.order.count());
    c.cubic = some(14, pairs);
    c.quartic = some(pairs, pairs);
    c.driving = some(3, pairs);
    c.following = Eigen::MatrixXd(0, pairs);
    return {c, 1};
}

// Of a mode that isn't active the terms of third degree with one of it are left, linear in it.
TEST(CubicLevels, FewerActiveModesLeaveTheOthersDriven) {
    const CubicTerms terms = some_terms();
    CubicTerms::Work work = terms.make_work();
    const std::size_t widest = terms.levels() - 1;
    ASSERT_EQ(terms.active(widest), 14u);
    VectorXd force(17);
    const auto energy = [&](std::size_t level, const VectorXd& q) {
        return terms.evaluate(level, {q.data(), 17}, {force.data(), 17}, work);
    };
    const auto odd = [&](const VectorXd& q) {
        return (energy(widest, q) - energy(widest, -q)) / 2;
    };
    const auto even = [&](const VectorXd& q) {
        return (energy(widest, q) + energy(widest, -q)) / 2;
    };
    for (std::size_t level = 0; level < widest; ++level) {
        const auto active = static_cast<Index>(terms.active(level));
        VectorXd low = some_amplitudes(17, 1), high = low;
        low.tail(17 - active).setZero();
        high.head(active).setZero();
        high.tail(3).setZero();
        const double linear = (odd(low + high) - odd(low - high)) / 2 - odd(high);
        const double expected = even(low) + odd(low) + linear;
        EXPECT_NEAR(energy(level, low + high), expected, 2e-6 * (even(low) + std::fabs(odd(low))));
        EXPECT_LT(terms.entries(level), terms.entries(level + 1));
    }
}

TEST(CubicLevels, ForceIsTheEnergysSlopeAtEach) {
    const CubicTerms terms = some_terms();
    CubicTerms::Work work = terms.make_work();
    for (std::size_t level = 0; level < terms.levels(); ++level) {
        const VectorXd q = some_amplitudes(17, 1);
        VectorXd force(17), unused(17);
        terms.evaluate(level, {q.data(), 17}, {force.data(), 17}, work);
        for (Index k = 0; k < 17; ++k) {
            constexpr double h = 1e-2; // of a polynomial of fourth degree: Richardson's is exact
            const auto slope = [&](double step) {
                VectorXd up = q, down = q;
                up[k] += step;
                down[k] -= step;
                return (terms.evaluate(level, {up.data(), 17}, {unused.data(), 17}, work) -
                        terms.evaluate(level, {down.data(), 17}, {unused.data(), 17}, work)) /
                       (2 * step);
            };
            EXPECT_NEAR(-(4 * slope(h) - slope(2 * h)) / 3, force[k], 3e-4 * force.norm()) << k;
        }
    }
}

} // namespace
} // namespace ode::soft
