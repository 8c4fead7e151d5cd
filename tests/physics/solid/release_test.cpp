// A bar let go from a large deflection: the motion of three-dimensional elements against an
// independent model, a planar chain of points with the elastica's own energy; and a block that
// tumbles for a million steps.
#include "physics/solid/free_body.h"

#include "integrate/static_equilibrium.h"
#include "mesh/generate.h"
#include "mesh/promote.h"
#include "model/make_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ode::soft {
namespace {

// Slender, so that shear and rotary inertia, which the elastica leaves out, change the motion by
// (h/L)^2 only; nu = 0, so that the section keeps its shape.
constexpr double kLength = 1, kHigh = 0.02;     ///< [m]
constexpr double kYoung = 1e6, kDensity = 1000; ///< [Pa], [kg/m^3]
constexpr double kArea = kHigh * kHigh, kInertia = kHigh * kHigh * kHigh * kHigh / 12;
constexpr double kLoad = 3 * kYoung * kInertia / (kLength * kLength); ///< P L^2 / (E I) = 3

using Point = Eigen::Vector2d;

/// Bending energy EI/2 sum of kappa^2 l, kappa = 2 tan(phi / 2) / l between segments (discrete
/// elastic rods: Bergou et al. 2008, doi:10.1145/1399504.1360662), stretching EA/2 sum of e^2 l.
/// Clamped: the first two points stay.
class Chain {
public:
    explicit Chain(int segments)
        : l_(kLength / segments), x_(static_cast<std::size_t>(segments) + 1),
          v_(x_.size(), Point::Zero()), f_(x_) {
        for (std::size_t i = 0; i < x_.size(); ++i)
            x_[i] = Point(l_ * static_cast<double>(i), 0);
    }
    double step_limit() const { return 0.4 * l_ / std::sqrt(kYoung / kDensity); }
    void step(double h, double load, double damping) {
        add_forces(load);
        for (std::size_t i = 2; i < x_.size(); ++i) {
            const double m = kDensity * kArea * l_ * (i + 1 == x_.size() ? 0.5 : 1);
            v_[i] = (v_[i] * (1 - damping * h / 2) + h / m * f_[i]) / (1 + damping * h / 2);
            x_[i] += h * v_[i];
        }
    }
    Point tip() const { return x_.back(); }
    void halt() { std::fill(v_.begin(), v_.end(), Point::Zero()); }

private:
    static double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }
    static Point turned(const Point& a) { return {-a.y(), a.x()}; }
    void add_forces(double load) {
        std::fill(f_.begin(), f_.end(), Point::Zero());
        f_.back().y() += load;
        for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
            const Point edge = x_[i + 1] - x_[i];
            const double length = edge.norm();
            const Point pull = kYoung * kArea * (length / l_ - 1) / length * edge;
            f_[i] += pull;
            f_[i + 1] -= pull;
        }
        for (std::size_t i = 1; i + 1 < x_.size(); ++i) {
            const Point a = x_[i] - x_[i - 1], b = x_[i + 1] - x_[i];
            const double phi = std::atan2(cross(a, b), a.dot(b));
            const double t = std::tan(phi / 2);
            // dU/dphi of EI/2 (2 t / l)^2 l; the angle of an edge turns by edge x d / |edge|^2.
            const double moment = 2 * kYoung * kInertia / l_ * t * (1 + t * t);
            const Point da = turned(a) / a.squaredNorm(), db = turned(b) / b.squaredNorm();
            f_[i + 1] -= moment * db;
            f_[i] += moment * (da + db);
            f_[i - 1] -= moment * da;
        }
    }

    double l_;
    std::vector<Point> x_, v_, f_;
};

/// Tip of the chain at multiples of `interval` after it is let go.
std::vector<Point> chain_path(int segments, double interval, int count) {
    Chain chain(segments);
    const double h = interval / std::ceil(interval / chain.step_limit());
    for (double t = 0; t < 60; t += h) // a dozen decay times
        chain.step(h, kLoad, 1.2);
    chain.halt();
    std::vector<Point> path{chain.tip()};
    for (int i = 0; i < count; ++i) {
        for (long n = std::lround(interval / h); n > 0; --n)
            chain.step(h, 0, 0);
        path.push_back(chain.tip());
    }
    return path;
}

std::vector<Point> element_path(int cells, double interval, int count) {
    const TetMesh mesh = promote_to_quadratic(make_bar(kLength, kHigh, kHigh, cells, 1, 1));
    Solid solid;
    solid.young = kYoung;
    solid.poisson = 0;
    solid.density = kDensity;
    const auto model = make_model("stvk", mesh, {&solid, 1});
    std::vector<char> free;
    std::vector<std::size_t> end;
    for (std::size_t i = 0; i < mesh.node.size(); ++i) {
        free.push_back(mesh.node[i].x() > 1e-9);
        if (mesh.node[i].x() > kLength - 1e-9)
            end.push_back(i);
    }
    NodeArray load(mesh.node.size()), x = node_array(mesh.node);
    for (const std::size_t i : end)
        load[i].z() = kLoad / static_cast<double>(end.size());
    EquilibriumOptions options;
    options.load_steps = 6;
    EXPECT_TRUE(find_equilibrium(*model, free, load, x, options).converged);
    FreeBody body(*model, x);
    for (std::size_t i = 0; i < free.size(); ++i)
        if (!free[i])
            body.inverse_mass[i] = 0;
    const double h = interval / std::ceil(interval / (0.8 * body.critical()));
    Vec3 rest = Vec3::Zero();
    const auto tip = [&] {
        Vec3 sum = Vec3::Zero();
        for (const std::size_t i : end)
            sum += body.state.position[i];
        return Vec3(sum / static_cast<double>(end.size()));
    };
    for (const std::size_t i : end)
        rest += mesh.node[i] / static_cast<double>(end.size());
    const auto seen = [&] { return Point(tip().x(), tip().z() - rest.z()); };
    std::vector<Point> path{seen()};
    for (int i = 0; i < count; ++i) {
        for (long n = std::lround(interval / h); n > 0; --n)
            body.step(h);
        path.push_back(seen());
    }
    return path;
}

// From 0.6 of its length aside through rest to the other side: half of the first period. Twice as
// many cells, or links, show what is left of the error of either.
TEST(Release, OfABentBarFollowsTheElastica) {
    constexpr double kInterval = 0.25;
    constexpr int kCount = 20; // 5 s; the lowest small vibration takes 9.8 s
    const std::vector<Point> coarse = chain_path(50, kInterval, kCount);
    // The clamp lies in the middle of the first link: an error of the first order, extrapolated.
    std::vector<Point> exact = chain_path(100, kInterval, kCount);
    for (std::size_t i = 0; i < exact.size(); ++i)
        exact[i] += exact[i] - coarse[i];
    const std::vector<Point> bar = element_path(20, kInterval, kCount);
    const std::vector<Point> fine = element_path(40, kInterval, kCount);
    double chain_error = 0, error = 0, fine_error = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        chain_error = std::max(chain_error, (coarse[i] - exact[i]).norm() / kLength);
        error = std::max(error, (bar[i] - exact[i]).norm() / kLength);
        fine_error = std::max(fine_error, (fine[i] - exact[i]).norm() / kLength);
    }
    std::printf(
        "release: tip starts at (%.3f, %.3f) L, gets to %.3f L on the other side; path off by "
        "%.4f L (20 cells), %.4f L (40), 50 links %.4f L\n",
        exact[0].x(), exact[0].y(), exact.back().y(), error, fine_error, chain_error);
    EXPECT_GT(exact[0].y(), 0.55); // Mattiasson's table has 0.60325 for P L^2 / (E I) = 3
    EXPECT_NEAR(exact[0].y(), 0.60325, 3e-3);
    EXPECT_NEAR(fine[0].y(), 0.60325, 3e-3);
    EXPECT_LT(exact.back().y(), -0.3);
    EXPECT_LE(error, 0.01);
    EXPECT_LE(fine_error, 0.01);
}

struct Block {
    const char* law;
    double share; ///< of the critical step
};

class Tumbling : public testing::TestWithParam<Block> {};

// About its middle axis, which no spin stays with, and ringing with strains of a per cent: energy
// is bounded and angular momentum kept, over a million steps.
TEST_P(Tumbling, ARubberBlockKeepsEnergyAndAngularMomentum) {
    const TetMesh mesh = irregular_box({0.12, 0.08, 0.05}, 2, 2, 1);
    Solid solid = rubber();
    const auto model = make_model(GetParam().law, mesh, {&solid, 1});
    FreeBody body(*model, disturbed(node_array(mesh.node), 2e-4, 9));
    const double h = GetParam().share * body.critical();
    Vec3 middle = Vec3::Zero();
    double mass = 0;
    for (std::size_t i = 0; i < mesh.node.size(); ++i) {
        middle += model->mass()[i] * body.state.position[i];
        mass += model->mass()[i];
    }
    middle /= mass;
    for (std::size_t i = 0; i < mesh.node.size(); ++i)
        body.state.velocity[i] = Vec3(1, 60, 1).cross(Vec3(body.state.position[i]) - middle);
    const auto angular = [&] {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < mesh.node.size(); ++i)
            sum += model->mass()[i] * body.state.position[i].cross(body.state.velocity[i]);
        return sum;
    };
    const auto energy = [&] { // as central difference keeps it: v- v+ / 2
        const NodeArray before = body.state.velocity;
        double sum = model->energy(body.state.position);
        body.step(h);
        for (std::size_t i = 0; i < mesh.node.size(); ++i)
            sum += model->mass()[i] * before[i].dot(body.state.velocity[i]) / 2;
        return sum;
    };
    const Vec3 spin = angular();
    const double start = energy();
    double worst = 0;
    constexpr long kSteps = 1000000;
    for (long n = 1; n < kSteps; ++n) {
        if (n % 100 == 0)
            worst = std::max(worst, std::abs(energy() / start - 1));
        else
            body.step(h);
    }
    const double drift = (angular() - spin).norm() / spin.norm();
    std::printf("tumbling, %s, %.1f of critical: %.0f turns; energy within %.1e, angular momentum "
                "%.1e over 1e6 steps\n",
                GetParam().law, GetParam().share, kSteps * h * 60 / 6.283, worst, drift);
    EXPECT_LE(worst, 1e-3);
    EXPECT_LE(drift, 1e-9);
}
INSTANTIATE_TEST_SUITE_P(Laws, Tumbling,
                         testing::Values(Block{"stvk", 0.5}, Block{"corotated", 0.5},
                                         Block{"stable-neo-hookean", 0.5}));

} // namespace
} // namespace ode::soft
