#include "support/pitch_cases.h"

#include "mesh/generate.h"
#include "mesh/promote.h"
#include "mesh/refine.h"

#include <cmath>
#include <numbers>

namespace ode::soft {
namespace {

const Solid kAluminium{.young = 69e9, .poisson = 0.33, .density = 2700};
const Solid kSteel{.young = 200e9, .poisson = 0.29, .density = 7850};
const Solid kGlass{.young = 70e9, .poisson = 0.22, .density = 2500};
const Solid kRosewood{.young = 14e9, .poisson = 0.35, .density = 900};
const Solid kRubber{.young = 5e6, .poisson = 0.49, .density = 1100};

/// A vibraphone's or marimba's bar: thinned to `least` of its thickness in the middle.
TetMesh undercut_bar() {
    TetMesh mesh = make_bar(0.3, 0.04, 0.02, 20, 2, 1);
    for (Vec3& x : mesh.node) {
        const double u = (x.x() - 0.15) / 0.09;
        const double cut = std::abs(u) < 1 ? 0.6 * std::pow(1 - u * u, 2) : 0.0;
        x.z() = 0.01 - (0.01 - x.z()) * (1 - cut);
    }
    return mesh;
}

/// Steel with a brass end.
TetMesh two_part_bar() {
    TetMesh mesh = make_bar(0.25, 0.02, 0.01, 20, 2, 1);
    mesh.group_name = {"steel", "brass"};
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        double x = 0;
        for (const int n : mesh.nodes_of(e))
            x += mesh.node[static_cast<std::size_t>(n)].x() / 4;
        mesh.group.push_back(x > 0.2);
    }
    return mesh;
}

/// The clamped plate, its cells shrinking toward the singular edges: halving them uniformly leaves
/// 2.3 to 3.6 cents there, this less than a cent to 3 by its own band.
TetMesh graded_plate() {
    TetMesh mesh = make_plate(0.3, 0.3, 0.006, 12, 12, 1);
    // Cell boundaries from the middle to the edge, as shares of half the side.
    const double line[] = {0, 0.24, 0.48, 0.72, 0.9, 0.967, 1};
    for (Vec3& x : mesh.node)
        for (int axis = 0; axis < 2; ++axis) {
            const auto step = static_cast<std::size_t>(std::lround(std::abs(x[axis]) / 0.025));
            x[axis] = std::copysign(0.15 * line[step], x[axis]);
        }
    return promote_to_quadratic(mesh);
}

/// A ragged mesh of a block: inner nodes displaced.
TetMesh ragged_block() {
    TetMesh mesh = make_box({0.12, 0.08, 0.03}, 5, 4, 2);
    for (std::size_t i = 0; i < mesh.node.size(); ++i) {
        Vec3& x = mesh.node[i];
        const Vec3 half(0.06, 0.04, 0.015);
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(std::abs(x[axis]) - half[axis]) > 1e-9)
                x[axis] += 0.12 * half[axis] / (axis == 2 ? 2 : 4) *
                           std::sin(7.0 * static_cast<double>(i) + axis);
    }
    return mesh;
}

} // namespace

std::vector<PitchCase> pitch_cases() {
    const auto left = [](const Vec3& x) { return x.x() < 1e-9; };
    const auto rim = [](const Vec3& x) {
        return std::max(std::abs(x.x()), std::abs(x.y())) > 0.15 - 1e-9;
    };
    std::vector<PitchCase> cases;
    cases.push_back(
        {"clamped bar", make_bar(0.3, 0.02, 0.01, 16, 2, 1), {kAluminium}, left, 12000});
    cases.push_back({"free bar", make_bar(0.3, 0.05, 0.01, 16, 3, 1), {kSteel}, {}, 12000});
    cases.push_back({"undercut bar", undercut_bar(), {kRosewood}, {}, 9000});
    cases.push_back({"bar of two metals",
                     two_part_bar(),
                     {kSteel, {.young = 100e9, .poisson = 0.34, .density = 8500}},
                     {},
                     12000});
    cases.push_back({"clamped plate",
                     promote_to_quadratic(make_plate(0.3, 0.3, 0.006, 8, 8, 1)),
                     {kAluminium},
                     rim,
                     4000,
                     graded_plate()});
    cases.push_back({"free plate", make_plate(0.3, 0.25, 0.006, 8, 7, 1), {kSteel}, {}, 4000});
    cases.push_back({"bowl", make_bowl(0.1, 0.005, 1.5708, 6, 20, 1), {kAluminium}, {}, 8000});
    cases.push_back({"tube", make_tube(0.25, 0.015, 0.012, 12, 12, 1), {kSteel}, {}, 14000});
    cases.push_back({"clamped glass cup",
                     make_tube(0.1, 0.035, 0.032, 6, 16, 1),
                     {kGlass},
                     [](const Vec3& x) { return x.z() < 1e-9; },
                     9000});
    cases.push_back({"sphere", make_sphere(0.05, 2), {kSteel}, {}, 60000});
    cases.push_back({"ragged block", ragged_block(), {kSteel}, {}, 40000});
    cases.push_back({"rubber block", make_box({0.12, 0.04, 0.04}, 6, 2, 2), {kRubber}, {}, 1000});
    return cases;
}

ModalOptions options_for(const PitchCase& pitch_case, const TetMesh& mesh) {
    ModalOptions options;
    options.max_frequency = pitch_case.max_frequency;
    options.max_modes = pitch_case.partials;
    options.clamp = static_cast<bool>(pitch_case.clamped);
    for (std::size_t i = 0; i < mesh.node.size() && options.clamp; ++i)
        if (pitch_case.clamped(mesh.node[i]))
            options.clamped.push_back(static_cast<int>(i));
    return options;
}

TetMesh refined(const TetMesh& mesh) {
    const TetMesh out = refine_uniformly(mesh);
    return mesh.order == 2 ? promote_to_quadratic(out) : out;
}

std::vector<double> matched_frequencies(const ModalModel& coarse, const ModalModel& fine) {
    const auto rows = static_cast<Eigen::Index>(3 * coarse.node_count);
    const auto columns = [&](const ModalModel& m) {
        Eigen::MatrixXd x(rows, static_cast<Eigen::Index>(m.mode_count()));
        for (std::size_t k = 0; k < m.mode_count(); ++k)
            x.col(static_cast<Eigen::Index>(k)) =
                Eigen::Map<const Eigen::VectorXd>(m.shape_of(k).data(), rows).normalized();
        return x;
    };
    const Eigen::MatrixXd mac = (columns(coarse).transpose() * columns(fine)).cwiseAbs2();
    std::vector<double> out;
    for (Eigen::Index i = 0; i < mac.rows(); ++i) {
        Eigen::Index best = 0;
        if (mac.cols() == 0 || mac.row(i).maxCoeff(&best) < 0.3) {
            out.push_back(0);
            continue;
        }
        // Near-equal frequencies mix freely: those within 1 % of the best count by their share.
        const double centre = fine.frequency[static_cast<std::size_t>(best)];
        double weight = 0, sum = 0;
        for (Eigen::Index k = 0; k < mac.cols(); ++k) {
            const double f = fine.frequency[static_cast<std::size_t>(k)];
            if (std::abs(f - centre) < 0.01 * centre) {
                weight += mac(i, k);
                sum += mac(i, k) * f;
            }
        }
        out.push_back(weight > 0.7 ? sum / weight : 0);
    }
    return out;
}

} // namespace ode::soft
