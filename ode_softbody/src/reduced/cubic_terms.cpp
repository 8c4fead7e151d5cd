#include "reduced/cubic_terms.h"

#include "modal/avx2.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace ode::soft {
namespace {

static_assert(CubicTerms::kLanes == 16);
typedef float Lanes __attribute__((vector_size(64))); // several registers but for AVX-512

std::size_t whole_lanes(std::size_t n) noexcept {
    return (n + CubicTerms::kLanes - 1) / CubicTerms::kLanes * CubicTerms::kLanes;
}

[[gnu::always_inline]] inline float total(const Lanes& lanes) {
    float s[CubicTerms::kLanes];
    std::memcpy(s, &lanes, sizeof s);
    for (int width = 8; width > 0; width /= 2)
        for (int i = 0; i < width; ++i)
            s[i] += s[i + width];
    return s[0];
}

/// Rows times products into `answer`, rows weighted by `by` into `sum`: both halves of the gradient
/// from one reading of the coefficients.
template <int kRows>
[[gnu::always_inline]] inline void rows_body(const float* coefficient, std::size_t registers,
                                             const float* by, const float* product, float* answer,
                                             float* sum) {
    const auto* const p = reinterpret_cast<const Lanes*>(product);
    auto* const s = reinterpret_cast<Lanes*>(sum);
    const auto* const c = reinterpret_cast<const Lanes*>(coefficient);
    Lanes dot[kRows] = {};
    for (std::size_t v = 0; v < registers; ++v) {
        const Lanes here = p[v];
        Lanes added = s[v];
        for (int r = 0; r < kRows; ++r) {
            const Lanes own = c[static_cast<std::size_t>(r) * registers + v];
            dot[r] += own * here;
            added += own * by[r];
        }
        s[v] = added;
    }
    for (int r = 0; r < kRows; ++r)
        answer[r] = total(dot[r]);
}

// The same arithmetic at either register width: equal bits.
template <int kRows>
void rows_narrow(const float* c, std::size_t n, const float* by, const float* p, float* answer,
                 float* sum) {
    rows_body<kRows>(c, n, by, p, answer, sum);
}
template <int kRows>
ODE_SOFTBODY_AVX2 void rows_wide(const float* c, std::size_t n, const float* by, const float* p,
                                 float* answer, float* sum) {
    rows_body<kRows>(c, n, by, p, answer, sum);
}
template <int kRows>
ODE_SOFTBODY_AVX512 void rows_widest(const float* c, std::size_t n, const float* by, const float* p,
                                     float* answer, float* sum) {
    rows_body<kRows>(c, n, by, p, answer, sum);
}

using Rows = void (*)(const float*, std::size_t, const float*, const float*, float*, float*);
constexpr std::array<Rows, 4> kNarrow = {rows_narrow<1>, rows_narrow<2>, rows_narrow<3>,
                                         rows_narrow<4>};
constexpr std::array<Rows, 4> kWide = {rows_wide<1>, rows_wide<2>, rows_wide<3>, rows_wide<4>};
constexpr std::array<Rows, 4> kWidest = {rows_widest<1>, rows_widest<2>, rows_widest<3>,
                                         rows_widest<4>};

/// Adds coefficients of unsorted monomials up at their sorted ones.
class Sorted {
public:
    explicit Sorted(PairOrder order) : order_(order) {
        for (std::size_t i = 0; i < order.modes; ++i)
            for (std::size_t j = i; j < order.modes; ++j)
                pair_.resize(std::max(pair_.size(), order.at(i, j) + 1)),
                    pair_[order.at(i, j)] = {i, j};
    }
    const std::array<std::size_t, 2>& pair(std::size_t at) const { return pair_[at]; }

    /// By (i, j), then by the place of (k, l).
    Eigen::MatrixXd quartic(const Eigen::MatrixXd& from) const {
        Eigen::MatrixXd out = Eigen::MatrixXd::Zero(from.rows(), from.cols());
        for (std::size_t a = 0; a < pair_.size(); ++a)
            for (std::size_t b = 0; b < pair_.size(); ++b) {
                std::array<std::size_t, 4> m{pair_[a][0], pair_[a][1], pair_[b][0], pair_[b][1]};
                std::sort(m.begin(), m.end());
                out(index(order_.at(m[0], m[1])), index(order_.at(m[2], m[3]))) +=
                    from(index(a), index(b));
            }
        return out;
    }
    Eigen::MatrixXd cubic(const Eigen::MatrixXd& from) const {
        Eigen::MatrixXd out = Eigen::MatrixXd::Zero(from.rows(), from.cols());
        for (std::size_t i = 0; i < order_.modes; ++i)
            for (std::size_t b = 0; b < pair_.size(); ++b) {
                std::array<std::size_t, 3> m{i, pair_[b][0], pair_[b][1]};
                std::sort(m.begin(), m.end());
                out(index(m[0]), index(order_.at(m[1], m[2]))) += from(index(i), index(b));
            }
        return out;
    }

private:
    static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }
    PairOrder order_;
    std::vector<std::array<std::size_t, 2>> pair_;
};

} // namespace

CubicTerms::CubicTerms(const Coefficients& from, double unit)
    : order_(from.order), driven_(from.driven), pairs_(whole_lanes(from.order.count())),
      first_pair_(whole_lanes(from.order.modes + from.driven)), scale_(1 / unit),
      columns_(whole_lanes(from.follow.size())), follow_(from.follow) {
    const Sorted sorted(order_);
    const Eigen::MatrixXd quartic = sorted.quartic(from.quartic) * std::pow(unit, 4);
    const Eigen::MatrixXd cubic = sorted.cubic(from.cubic) * std::pow(unit, 3);
    const Eigen::MatrixXd driving = from.driving * std::pow(unit, 3);
    const auto row = [](const Eigen::MatrixXd& m, std::size_t i) {
        const Eigen::VectorXd copy = m.row(static_cast<Eigen::Index>(i));
        return std::vector<double>(copy.begin(), copy.end());
    };
    for (std::size_t m = 0; m < driven_; ++m)
        add_row(static_cast<std::uint32_t>(order_.modes + m), order_.count(), row(driving, m));
    for (std::size_t j = 0; j < order_.modes; ++j) {
        add_row(static_cast<std::uint32_t>(j), order_.count(j), row(cubic, j));
        for (std::size_t i = 0; i <= j; ++i)
            add_row(static_cast<std::uint32_t>(first_pair_ + order_.at(i, j)), order_.count(j),
                    row(quartic, order_.at(i, j)));
    }
    follow_row_.assign(pairs_ * from.follow.size(), 0.0f);
    for (std::size_t s = 0; s < from.follow.size(); ++s) {
        const std::vector<double> own = row(from.following * (unit * unit), s);
        std::copy(own.begin(), own.end(),
                  follow_row_.begin() + static_cast<std::ptrdiff_t>(s * pairs_));
    }
    const std::size_t rows = from.follow.empty() ? 0 : from.shape.size() / from.follow.size();
    shape_.assign(rows * columns_, 0.0f);
    for (std::size_t s = 0; s < from.follow.size(); ++s)
        for (std::size_t r = 0; r < rows; ++r)
            shape_[r * columns_ + s] = static_cast<float>(from.shape[s * rows + r]);
}

void CubicTerms::add_row(std::uint32_t source, std::size_t entries, std::span<const double> row) {
    const auto registers = static_cast<std::uint32_t>(whole_lanes(entries) / kLanes);
    if (group_.empty() || group_.back().registers != registers || group_.back().rows == 4)
        group_.push_back(
            {static_cast<std::uint32_t>(row_source_.size()), 0, registers, coefficient_.size()});
    ++group_.back().rows;
    row_source_.push_back(source);
    const std::size_t begin = coefficient_.size();
    coefficient_.resize(begin + registers * kLanes, 0.0f);
    for (std::size_t i = 0; i < entries; ++i)
        coefficient_[begin + i] = static_cast<float>(row[i]);
}

CubicTerms::Work CubicTerms::make_work() const {
    Work work;
    work.source.assign(first_pair_ + pairs_, 0.0f);
    work.answer.assign(row_source_.size() * 2 + 8, 0.0f);
    work.sum.assign(pairs_, 0.0f);
    return work;
}

void CubicTerms::fill(std::span<const double> amplitude, Work& work) const noexcept {
    for (std::size_t i = 0; i < amplitude.size(); ++i)
        work.source[i] = static_cast<float>(scale_ * amplitude[i]);
    float* p = work.source.data() + first_pair_;
    for (std::size_t i = order_.modes; i-- > 0;)
        for (std::size_t j = i; j < order_.modes; ++j)
            *p++ = work.source[i] * work.source[j];
}

double CubicTerms::evaluate(std::span<const double> amplitude, std::span<double> force,
                            Work& work) const noexcept {
    fill(amplitude, work);
    std::fill(work.sum.begin(), work.sum.end(), 0.0f);
    const float* const product = work.source.data() + first_pair_;
    float* const by = work.answer.data() + row_source_.size();
    for (std::size_t r = 0; r < row_source_.size(); ++r)
        by[r] = work.source[row_source_[r]];
    const auto& kernel = has_avx512() ? kWidest : has_avx2() ? kWide : kNarrow;
    for (const Group& g : group_)
        kernel[g.rows - 1](coefficient_.data() + g.offset, g.registers, by + g.first, product,
                           work.answer.data() + g.first, work.sum.data());
    double energy = 0;
    std::fill(force.begin(), force.end(), 0.0);
    for (std::size_t r = 0; r < row_source_.size(); ++r) {
        energy += static_cast<double>(by[r]) * static_cast<double>(work.answer[r]);
        if (row_source_[r] >= first_pair_)
            work.sum[row_source_[r] - first_pair_] += work.answer[r];
        else
            force[row_source_[r]] -= scale_ * static_cast<double>(work.answer[r]);
    }
    add_slope(-scale_, force, work);
    return energy;
}

// From a slope by products to one by amplitudes.
void CubicTerms::add_slope(double sign, std::span<double> force, const Work& work) const noexcept {
    const float* d = work.sum.data();
    for (std::size_t i = order_.modes; i-- > 0;) {
        double own = 0;
        const auto qi = static_cast<double>(work.source[i]);
        for (std::size_t j = i; j < order_.modes; ++j, ++d) {
            own += static_cast<double>(*d) * static_cast<double>(work.source[j]);
            force[j] += sign * static_cast<double>(*d) * qi;
        }
        force[i] += sign * own;
    }
}

void CubicTerms::add_push(std::span<const double> amplitude, std::span<const double> push,
                          std::span<double> force, Work& work) const noexcept {
    fill(amplitude.first(order_.modes), work);
    std::fill(work.sum.begin(), work.sum.end(), 0.0f);
    auto* const sum = reinterpret_cast<Lanes*>(work.sum.data());
    for (std::size_t s = 0; s < follow_.size(); ++s) {
        const auto* const c = reinterpret_cast<const Lanes*>(follow_row_.data() + s * pairs_);
        const auto by = static_cast<float>(push[s]);
        for (std::size_t k = 0; k < pairs_ / kLanes; ++k)
            sum[k] += c[k] * by;
    }
    add_slope(scale_, force, work);
}

void CubicTerms::follow(std::span<const double> amplitude, std::span<const double> rate,
                        std::span<double> place, std::span<double> speed,
                        Work& work) const noexcept {
    fill(amplitude.first(order_.modes), work);
    // The products' rates.
    float* d = work.sum.data();
    for (std::size_t i = order_.modes; i-- > 0;)
        for (std::size_t j = i; j < order_.modes; ++j)
            *d++ = static_cast<float>(scale_ * rate[i]) * work.source[j] +
                   work.source[i] * static_cast<float>(scale_ * rate[j]);
    std::fill(d, work.sum.data() + pairs_, 0.0f);
    const auto* const p = reinterpret_cast<const Lanes*>(work.source.data() + first_pair_);
    const auto* const v = reinterpret_cast<const Lanes*>(work.sum.data());
    for (std::size_t s = 0; s < follow_.size(); ++s) {
        const auto* const c = reinterpret_cast<const Lanes*>(follow_row_.data() + s * pairs_);
        Lanes at = {}, pace = {};
        for (std::size_t k = 0; k < pairs_ / kLanes; ++k) {
            at += c[k] * p[k];
            pace += c[k] * v[k];
        }
        place[s] = static_cast<double>(total(at));
        speed[s] = static_cast<double>(total(pace));
    }
}

} // namespace ode::soft
