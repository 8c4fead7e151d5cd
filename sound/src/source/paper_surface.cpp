#include "source/paper_surface.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::sound {
namespace {

using Vec3 = Eigen::Vector3d;
constexpr double kDcTail = 300.0; // samples until eq. 9 has forgotten: 0.9^300 = 2e-14

} // namespace

PaperSurface::PaperSurface(std::span<const int> triangle, double rate, double impedance, bool block)
    : surface_(triangle), rate_(rate), impedance_(impedance), block_(block) {
    const auto n = static_cast<std::size_t>(surface_.triangles());
    now_.assign(n * kFields, 0.0);
    area_.assign(n, 0.0);
    sum_.assign(n * kFields * kOpen, 0.0);
    weight_.assign(kOpen, 0.0);
    dc_.assign(n, DcBlock{});
    facet_.assign(n * FacetBlock::kFields, 0.0);
}

double* PaperSurface::open(std::int64_t sample) noexcept {
    const auto slot = static_cast<std::size_t>(sample & (kOpen - 1));
    return sum_.data() + slot * now_.size();
}

void PaperSurface::sense(const SurfaceView& view) noexcept {
    const auto corner = [&](const double* of, int node) {
        const std::ptrdiff_t at =
            static_cast<std::ptrdiff_t>(surface_.body_node()[node]) * view.stride;
        return Vec3(of[at], of[at + 1], of[at + 2]);
    };
    for (int t = 0; t < surface_.triangles(); ++t) {
        const int* node = surface_.triangle() + 3 * t;
        const Vec3 x1 = corner(view.position, node[0]);
        const Vec3 x2 = corner(view.position, node[1]);
        const Vec3 x3 = corner(view.position, node[2]);
        const Vec3 v = (corner(view.velocity, node[0]) + corner(view.velocity, node[1]) +
                        corner(view.velocity, node[2])) /
                       3.0;
        const Vec3 twice = (x2 - x1).cross(x3 - x1);
        const double length = twice.norm();
        const Vec3 n = length > 0.0 ? Vec3(twice / length) : Vec3::Zero(); // eq. 4
        area_[static_cast<std::size_t>(t)] = 0.5 * length;                 // eq. 3
        double* now = now_.data() + static_cast<std::size_t>(t) * kFields;
        now[0] = impedance_ * n.dot(v); // eq. 2, 5
        Eigen::Map<Vec3>{now + 1} = (x1 + x2 + x3) / 3.0;
        Eigen::Map<Vec3>{now + 4} = n;
    }
}

bool PaperSurface::push(const SurfaceView& view, BlockSink& out) {
    const double begin = view.time - view.dt;
    if (!silent_ && begin > seen_ + 0.5 * view.dt)
        advance_to(begin, out);
    if (silent_) {
        next_ = static_cast<std::int64_t>(std::ceil(view.time * rate_));
        std::fill(sum_.begin(), sum_.end(), 0.0);
        std::fill(weight_.begin(), weight_.end(), 0.0);
        std::fill(dc_.begin(), dc_.end(), DcBlock{});
        silent_ = false;
    }
    resting_ = false;
    sense(view);
    substep(view.time, view.dt, out);
    return true;
}

void PaperSurface::substep(double time, double dt, BlockSink& out) {
    seen_ = time;
    substep_ = dt;
    const double fmax = 0.5 * rate_;
    const double reach = std::min(std::ceil(3.0 / (fmax * dt)) * dt, 7.0 / rate_);
    const auto last = static_cast<std::int64_t>(std::floor((time + reach) * rate_));
    const auto first = static_cast<std::int64_t>(std::ceil((time - reach) * rate_));
    while (next_ < first)
        give_off(next_++, out);
    for (std::int64_t o = std::max(next_, first); o <= last; ++o) {
        const double lag = static_cast<double>(o) / rate_ - time;
        const double a = 2.0 * std::numbers::pi * fmax * lag;
        const double sinc = std::abs(a) < 1e-9 ? 1.0 : std::sin(a) / a; // eq. 7, scaled
        const double window = 0.5 * (1.0 + std::cos(std::numbers::pi * lag / reach)); // eq. 8
        const double k = sinc * window;                                               // eq. 6
        weight_[static_cast<std::size_t>(o & (kOpen - 1))] += k;
        double* sum = open(o);
        for (std::size_t i = 0; i < now_.size(); ++i)
            sum[i] += k * now_[i];
    }
}

void PaperSurface::give_off(std::int64_t sample, BlockSink& out) {
    double& weight = weight_[static_cast<std::size_t>(sample & (kOpen - 1))];
    double* sum = open(sample);
    const double scale = weight != 0.0 ? 1.0 / weight : 0.0;
    for (std::size_t t = 0; t < area_.size(); ++t) {
        const double* in = sum + t * kFields;
        double* facet = facet_.data() + t * FacetBlock::kFields;
        const double g = scale * in[0];
        facet[0] = block_ ? dc_[t](g) : g; // eq. 9
        facet[1] = area_[t];
        for (int k = 0; k < 3; ++k)
            facet[2 + k] = scale * in[1 + k];
        const Vec3 n = Vec3(in[4], in[5], in[6]).normalized();
        for (int k = 0; k < 3; ++k)
            facet[5 + k] = n[k];
    }
    std::fill_n(sum, now_.size(), 0.0);
    weight = 0.0;
    if (scale != 0.0)
        out.on_facets({sample, surface_.triangles(), facet_.data(),
                       patches_.count > 0 ? &patches_ : nullptr, this});
}

const Patches& PaperSurface::patches(std::span<std::array<double, 3>> centre) {
    const double* first = facet_.data() + 2; // centres
    if (patches_.count == 0)
        patches_ = Patches(first, surface_.triangles(), FacetBlock::kFields);
    patches_.centres(first, FacetBlock::kFields, centre);
    return patches_;
}

void PaperSurface::advance_to(double time, BlockSink& out) {
    if (silent_ || time <= seen_ + 0.5 * substep_)
        return;
    if (!resting_) {
        resting_ = true;
        rest_begin_ = seen_;
        for (std::size_t t = 0; t < area_.size(); ++t)
            now_[t * kFields] = 0.0; // asleep: no velocity
    }
    while (seen_ + 0.5 * substep_ < time) {
        if (seen_ > rest_begin_ + kDcTail / rate_) {
            silent_ = true;
            return;
        }
        substep(seen_ + substep_, substep_, out);
    }
}

} // namespace ode::sound
