#include "source/lean.h"

#include "dsp/kernels.h"
#include "transfer/carried_air.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <numeric>
#include <vector>

namespace ode::sound {
namespace {

double length(const double* v) { return Eigen::Map<const Vec3>(v).norm(); }

Vec3 mean(const double* point, int nodes) noexcept {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < nodes; ++i)
        sum += Eigen::Map<const Vec3>(point + 4 * i);
    return sum / nodes;
}

} // namespace

// i w time / (1 + i w time), bilinear: exact at both ends.
Lean::HighPass::HighPass(double time, double rate) noexcept {
    const double twice = 2.0 * time * rate;
    keep = (twice - 1.0) / (twice + 1.0);
    pass = twice / (twice + 1.0);
}

std::complex<double> Lean::HighPass::response(double angle) const noexcept {
    const std::complex<double> back = std::polar(1.0, -angle);
    return pass * (1.0 - back) / (1.0 - keep * back);
}

Lean::Response Lean::response(double frequency, double rate) const noexcept {
    if (!leans_)
        return {0.0, 0.0};
    if (!filters_)
        return {1.0, 0.0};
    const double angle = 2.0 * std::numbers::pi * frequency / rate;
    const std::complex<double> own = shake_.response(angle);
    return {own, pulse_.response(angle) - own};
}

Lean::Lean(Leaning leaning, const Surface& surface, const double* point, const double* area,
           double rate, double speed) {
    if (leaning == Leaning::kNone)
        return;
    const auto n = static_cast<std::size_t>(surface.nodes());
    for (AlignedVector* v : {&along_area_, &along_way_, &share_, &before_, &after_, &sum_})
        v->assign(n, 0.0);
    direction_.assign(4 * n, 0.0);
    if (leaning == Leaning::kNormal)
        aim_normals(area);
    else
        aim_at_air(surface, point, area, rate, speed);
}

void Lean::aim_normals(const double* area) {
    for (std::size_t i = 0; i < along_area_.size(); ++i)
        if (const double a = length(area + 4 * i); a > 0.0)
            along_area_[i] = 1.0 / a;
    leans_ = true;
}

void Lean::aim_at_air(const Surface& surface, const double* point, const double* area, double rate,
                      double speed) {
    BoundaryMesh mesh;
    for (int i = 0; i < surface.real_nodes(); ++i)
        mesh.node.emplace_back(point[4 * i], point[4 * i + 1], point[4 * i + 2]);
    for (int t = 0; t < surface.triangles(); ++t) {
        const int* node = surface.triangle() + 3 * t;
        mesh.triangle.push_back({node[0], node[1], node[2]});
    }
    if (!std::all_of(mesh.node.begin(), mesh.node.end(),
                     [](const Vec3& x) { return x.allFinite(); }))
        return;
    carried_ = shared(mesh, surface.nodes(), point, area);
    if (!(carried_->shake_length > 0.0))
        return;
    along_area_ = carried_->along_area;
    along_way_ = carried_->along_way;
    share_ = carried_->share;
    shake_time_ = carried_->shake_length / speed;
    shake_ = HighPass(shake_time_, rate);
    pulse_ = HighPass(carried_->pulse_length / speed, rate);
    leans_ = filters_ = true;
}

/// A pile of like bodies is solved for once: they are known by their edges, to 1e-4 of their size.
std::shared_ptr<const Lean::Carried> Lean::shared(const BoundaryMesh& mesh, int nodes,
                                                  const double* point, const double* area) {
    const double size = mesh.radius(mesh.centre());
    std::vector<int> name;
    for (const auto& t : mesh.triangle)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 edge = mesh.node[static_cast<std::size_t>(t[(k + 1) % 3])] -
                              mesh.node[static_cast<std::size_t>(t[k])];
            name.push_back(t[k]);
            name.push_back(static_cast<int>(std::lround(1e4 * edge.norm() / size)));
        }
    name.push_back(static_cast<int>(std::lround(1e4 * std::log2(size))));
    static std::mutex lock;
    static std::map<std::vector<int>, std::weak_ptr<const Carried>> known;
    const std::lock_guard guard(lock);
    std::erase_if(known, [](const auto& entry) { return entry.second.expired(); });
    std::weak_ptr<const Carried>& place = known[name];
    if (auto found = place.lock())
        return found;
    auto made = std::make_shared<const Carried>(carry(mesh, nodes, point, area));
    place = made;
    return made;
}

Lean::Carried Lean::carry(const BoundaryMesh& mesh, int nodes, const double* point,
                          const double* area) {
    const CarriedAir air = carried_air(mesh);
    if (air.shift.empty())
        return {};
    const auto n = static_cast<std::size_t>(nodes);
    Carried out{AlignedVector(n, 0.0), AlignedVector(n, 0.0), AlignedVector(n, 0.0),
                air.pulse_length, air.shake_length};
    // The shift is kept by what turns with the body at no cost: area vector and way from the
    // middle. What stands on both is lost; on bodies of revolution there is nothing.
    const Vec3 middle = mean(point, nodes);
    double total = 0.0;
    for (std::size_t i = 0; i < air.shift.size(); ++i) {
        Eigen::Matrix<double, 3, 2> basis;
        basis.col(0) = Eigen::Map<const Vec3>(area + 4 * i);
        basis.col(1) = Eigen::Map<const Vec3>(point + 4 * i) - middle;
        const double scale[2] = {basis.col(0).norm(), basis.col(1).norm()};
        if (!(scale[0] > 0.0) || !(scale[1] > 0.0))
            continue;
        basis.col(0) /= scale[0];
        basis.col(1) /= scale[1];
        // Nearly parallel where the body is round: a little of each is better than much of both.
        Eigen::Matrix2d normal = basis.transpose() * basis;
        normal.diagonal().array() += 1e-3;
        const Eigen::Vector2d part =
            normal.ldlt().solve(basis.transpose() * air.shift[i]) / air.shake_length;
        out.along_area[i] = part[0] / scale[0];
        out.along_way[i] = part[1] / scale[1];
        out.share[i] = scale[0];
        total += scale[0];
    }
    for (double& share : out.share)
        share /= total;
    return out;
}

void Lean::reset() noexcept {
    std::fill(before_.begin(), before_.end(), 0.0);
    std::fill(after_.begin(), after_.end(), 0.0);
    pulse_before_ = pulse_after_ = pulse_shaken_ = 0.0;
}

void Lean::aim(const double* point, const double* area) noexcept {
    const auto nodes = static_cast<int>(along_area_.size());
    const Vec3 middle = mean(point, nodes);
    const double centre[4] = {middle[0], middle[1], middle[2], 0.0};
    kernels().lean(nodes, area, along_area_.data(), point, centre, along_way_.data(),
                   direction_.data());
}

void Lean::follow(const double* flow) noexcept {
    heard_ = flow;
    if (!filters_)
        return;
    const auto nodes = static_cast<int>(along_area_.size());
    const double all = std::accumulate(flow, flow + nodes, 0.0);
    const double step = all - pulse_before_;
    pulse_before_ = all;
    pulse_after_ = pulse_.keep * pulse_after_ + pulse_.pass * step;
    pulse_shaken_ = shake_.keep * pulse_shaken_ + shake_.pass * step;
    kernels().high_pass(nodes, flow, shake_.keep, shake_.pass, before_.data(), after_.data(),
                        pulse_after_ - pulse_shaken_, share_.data(), sum_.data());
    heard_ = sum_.data();
}

} // namespace ode::sound
