#include "strike/struck_surface.h"

#include <Eigen/Dense>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace ode::sound {
namespace {

/// Weights of a triangle's corners at its point nearest to p (C. Ericson, Real-Time Collision
/// Detection, 5.1.5).
Vec3 nearest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
    const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0)
        return {1.0, 0.0, 0.0};
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3)
        return {0.0, 1.0, 0.0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        const double v = d1 / (d1 - d3);
        return {1.0 - v, v, 0.0};
    }
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6)
        return {0.0, 0.0, 1.0};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        const double w = d2 / (d2 - d6);
        return {1.0 - w, 0.0, w};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0.0, 1.0 - w, w};
    }
    const double all = 1.0 / (va + vb + vc);
    return {1.0 - (vb + vc) * all, vb * all, vc * all};
}

} // namespace

StruckSurface::StruckSurface(std::vector<Vec3> node, std::vector<std::array<int, 3>> triangle,
                             std::span<const double> shape)
    : node_(std::move(node)), triangle_(std::move(triangle)),
      modes_(node_.empty() ? 0 : shape.size() / (3 * node_.size())) {
    for (const Vec3& x : node_)
        radius_ = std::max(radius_, x.norm());
    normal_.assign(node_.size(), Vec3::Zero());
    for (const auto& t : triangle_) {
        const auto at = [&](std::size_t i) { return node_[static_cast<std::size_t>(t[i])]; };
        const Vec3 area = (at(1) - at(0)).cross(at(2) - at(0));
        const double size = area.norm();
        const Vec3 unit = size > 0.0 ? Vec3(area / size) : Vec3::Zero();
        facing_.push_back(unit);
        middle_.push_back((at(0) + at(1) + at(2)) / 3.0);
        double reach = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            reach = std::max(reach, (at(i) - middle_.back()).norm());
            const Vec3 to = at((i + 1) % 3) - at(i), fro = at((i + 2) % 3) - at(i);
            const double angle = std::atan2(to.cross(fro).norm(), to.dot(fro));
            normal_[static_cast<std::size_t>(t[i])] += angle * unit;
        }
        reach_.push_back(reach);
        longest_ = std::max(longest_, reach);
        for (std::size_t k = 0; k < 3; ++k) {
            middle_of_[k].push_back(static_cast<float>(middle_.back()[static_cast<int>(k)]));
            facing_of_[k].push_back(static_cast<float>(unit[static_cast<int>(k)]));
        }
    }
    for (Vec3& n : normal_)
        if (const double length = n.norm(); length > 0.0)
            n /= length;
    shape_.resize(3 * node_.size() * modes_);
    for (std::size_t k = 0; k < modes_; ++k)
        for (std::size_t i = 0; i < 3 * node_.size(); ++i)
            shape_[i * modes_ + k] = static_cast<float>(shape[k * 3 * node_.size() + i]);
    find_curvature();
}

/// The quadric through a node's neighbours, in its tangent plane: h = (a u^2 + 2 b u v + c v^2) / 2
/// by least squares; the mean curvature is -(a + c) / 2.
void StruckSurface::find_curvature() {
    std::vector<Eigen::Matrix3d> left(node_.size(), Eigen::Matrix3d::Zero());
    std::vector<Vec3> right(node_.size(), Vec3::Zero());
    for (const auto& t : triangle_)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 1; j < 3; ++j) {
                const auto own = static_cast<std::size_t>(t[i]);
                const auto other = static_cast<std::size_t>(t[(i + j) % 3]);
                const Vec3& n = normal_[own];
                const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
                const Vec3 way = node_[other] - node_[own];
                const double x = way.dot(u), y = way.dot(v), h = way.dot(n);
                const double square = x * x + y * y;
                if (!(square > 0.0))
                    continue;
                // Of unit weight whatever the edge's length.
                const Vec3 row = Vec3(0.5 * x * x, x * y, 0.5 * y * y) / square;
                left[own] += row * row.transpose();
                right[own] += row * (h / square);
            }
    curvature_.assign(node_.size(), 0.0);
    for (std::size_t n = 0; n < node_.size(); ++n) {
        const Eigen::Matrix3d damped = left[n] + 1e-6 * Eigen::Matrix3d::Identity();
        const Vec3 fit = damped.ldlt().solve(right[n]);
        curvature_[n] = -0.5 * (fit[0] + fit[2]);
    }
}

StruckSurface::Place StruckSurface::nearest(const Vec3& point, const Vec3& outward) const noexcept {
    // Middles by the dozen first, those that look there before others: the one next to the point is
    // a bound that hardly another triangle comes under. Floats err by less than the slack.
    constexpr std::size_t kBlock = 64;
    const float slack = 1e-5f * static_cast<float>(radius_);
    const Eigen::Vector3f p = point.cast<float>(), way = outward.cast<float>();
    const auto measure = [&](std::size_t begin, std::size_t count, float* square) {
        const float *x = middle_of_[0].data() + begin, *y = middle_of_[1].data() + begin,
                    *z = middle_of_[2].data() + begin;
        for (std::size_t i = 0; i < count; ++i) {
            const float dx = x[i] - p[0], dy = y[i] - p[1], dz = z[i] - p[2];
            square[i] = dx * dx + dy * dy + dz * dz;
        }
    };
    float square[kBlock];
    std::size_t first = 0;
    std::int32_t next = std::numeric_limits<std::int32_t>::max();
    for (std::size_t begin = 0; begin < triangle_.size(); begin += kBlock) {
        const std::size_t count = std::min(kBlock, triangle_.size() - begin);
        measure(begin, count, square);
        const float *a = facing_of_[0].data() + begin, *b = facing_of_[1].data() + begin,
                    *c = facing_of_[2].data() + begin;
        // Floats above zero are in the order of their bits, of which the last ones tell which.
        std::int32_t key[kBlock];
        for (std::size_t i = 0; i < count; ++i) {
            constexpr float kAway = 1e30f;
            const float looks = a[i] * way[0] + b[i] * way[1] + c[i] * way[2];
            const float own = square[i] + (looks > 0.0f ? 0.0f : kAway);
            key[i] = (std::bit_cast<std::int32_t>(own) & ~std::int32_t{kBlock - 1}) |
                     static_cast<std::int32_t>(i);
        }
        std::int32_t best = next;
        for (std::size_t i = 0; i < count; ++i)
            best = std::min(best, key[i]);
        if (best < next) {
            next = best;
            first = begin + static_cast<std::size_t>(best & std::int32_t{kBlock - 1});
        }
    }
    Place best[2]; // turned away, turned to the contact
    double least[2] = {HUGE_VAL, HUGE_VAL};
    const auto look = [&](std::size_t t) {
        const bool sees = facing_[t].dot(outward) > 0.0;
        if (!sees && least[1] < HUGE_VAL)
            return;
        const double within = least[sees] + reach_[t];
        if ((point - middle_[t]).squaredNorm() > within * within)
            return;
        const auto at = [&](std::size_t i) -> const Vec3& {
            return node_[static_cast<std::size_t>(triangle_[t][i])];
        };
        const Vec3 w = nearest_weights(point, at(0), at(1), at(2));
        const Vec3 x = w[0] * at(0) + w[1] * at(1) + w[2] * at(2);
        if (const double distance = (point - x).norm(); distance < least[sees]) {
            least[sees] = distance;
            best[sees] = {static_cast<int>(t), w, x, distance};
        }
    };
    if (first < triangle_.size())
        look(first);
    for (std::size_t begin = 0; begin < triangle_.size(); begin += kBlock) {
        const std::size_t count = std::min(kBlock, triangle_.size() - begin);
        measure(begin, count, square);
        const double farthest = least[1] < HUGE_VAL ? least[1] : HUGE_VAL;
        const float within = static_cast<float>(farthest + longest_) + slack;
        const float limit = within * within;
        for (std::size_t i = 0; i < count; ++i)
            if (square[i] <= limit)
                look(begin + i);
    }
    return least[1] < HUGE_VAL ? best[1] : best[0];
}

StruckSurface::Place StruckSurface::entered(const Vec3& origin, const Vec3& force) const noexcept {
    const Vec3 along = force.normalized();
    Place best;
    double first = HUGE_VAL;
    for (std::size_t t = 0; t < triangle_.size(); ++t) {
        const double against = facing_[t].dot(along);
        if (!(against < 0.0))
            continue;
        const auto at = [&](std::size_t i) -> const Vec3& {
            return node_[static_cast<std::size_t>(triangle_[t][i])];
        };
        const double way = facing_[t].dot(at(0) - origin) / against;
        const Vec3 x = origin + way * along;
        const Vec3 w = nearest_weights(x, at(0), at(1), at(2));
        const double off = (w[0] * at(0) + w[1] * at(1) + w[2] * at(2) - x).norm();
        if (off <= 1e-6 * radius_ && way < first) {
            first = way;
            best = {static_cast<int>(t), w, x, 0.0};
        }
    }
    return first < HUGE_VAL ? best : nearest(origin - radius_ * along, -along);
}

double StruckSurface::curvature(const Place& place) const noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        sum += place.weight[static_cast<int>(i)] *
               curvature_[static_cast<std::size_t>(
                   triangle_[static_cast<std::size_t>(place.triangle)][i])];
    return sum;
}

void StruckSurface::project(const Place& place, const Vec3& impulse,
                            std::span<float> push) const noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
        const auto n =
            static_cast<std::size_t>(triangle_[static_cast<std::size_t>(place.triangle)][i]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto part = static_cast<float>(place.weight[static_cast<int>(i)] *
                                                 impulse[static_cast<int>(axis)]);
            const float* row = shape_.data() + (3 * n + axis) * modes_;
            for (std::size_t k = 0; k < modes_; ++k)
                push[k] += part * row[k];
        }
    }
}

Vec3 StruckSurface::motion(const Place& place, std::span<const float> q) const noexcept {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
        const auto n =
            static_cast<std::size_t>(triangle_[static_cast<std::size_t>(place.triangle)][i]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float* row = shape_.data() + (3 * n + axis) * modes_;
            double along = 0.0;
            for (std::size_t k = 0; k < modes_; ++k)
                along += static_cast<double>(row[k]) * static_cast<double>(q[k]);
            sum[static_cast<int>(axis)] += place.weight[static_cast<int>(i)] * along;
        }
    }
    return sum;
}

} // namespace ode::sound
