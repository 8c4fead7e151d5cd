#include "reduced/cubic_terms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

namespace ode::soft {
namespace {

typedef float Lanes __attribute__((vector_size(64))); // several registers but for AVX-512
static_assert(sizeof(Lanes) == CubicTerms::kLanes * sizeof(float));

constexpr std::size_t kFewest = 8; ///< active modes

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

/// Sums of the coefficients of unsorted monomials at their sorted ones.
class Sorted {
public:
    explicit Sorted(PairOrder order) : pair_(order.count()) {
        for (std::size_t j = 0; j < order.modes; ++j)
            for (std::size_t i = 0; i <= j; ++i)
                pair_[PairOrder::at(i, j)] = {i, j};
    }
    /// By the place of (k, l), then of (i, j).
    Eigen::MatrixXd quartic(const Eigen::MatrixXd& from) const {
        Eigen::MatrixXd out = Eigen::MatrixXd::Zero(from.rows(), from.cols());
        for (std::size_t a = 0; a < pair_.size(); ++a)
            for (std::size_t b = 0; b < pair_.size(); ++b) {
                std::array<std::size_t, 4> m{pair_[a][0], pair_[a][1], pair_[b][0], pair_[b][1]};
                std::sort(m.begin(), m.end());
                out(index(PairOrder::at(m[2], m[3])), index(PairOrder::at(m[0], m[1]))) +=
                    from(index(a), index(b));
            }
        return out;
    }
    /// By k, then by the place of (i, j).
    Eigen::MatrixXd cubic(const Eigen::MatrixXd& from) const {
        Eigen::MatrixXd out = Eigen::MatrixXd::Zero(from.rows(), from.cols());
        for (std::size_t k = 0; k < static_cast<std::size_t>(from.rows()); ++k)
            for (std::size_t b = 0; b < pair_.size(); ++b) {
                std::array<std::size_t, 3> m{k, pair_[b][0], pair_[b][1]};
                std::sort(m.begin(), m.end());
                out(index(m[2]), index(PairOrder::at(m[0], m[1]))) += from(index(k), index(b));
            }
        return out;
    }

private:
    static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }
    std::vector<std::array<std::size_t, 2>> pair_;
};

} // namespace

CubicTerms::CubicTerms(const Coefficients& from, double unit)
    : order_(from.order), driven_(from.driven), pairs_(whole_lanes(from.order.count())),
      first_pair_(whole_lanes(from.order.modes + from.driven)), scale_(1 / unit),
      add_rows_(add_rows_kernel()), columns_(whole_lanes(from.follow.size())),
      follow_(from.follow) {
    const Sorted sorted(order_);
    const Eigen::MatrixXd quartic = sorted.quartic(from.quartic) * std::pow(unit, 4);
    const Eigen::MatrixXd cubic = sorted.cubic(from.cubic) * std::pow(unit, 3);
    const Eigen::MatrixXd driving = from.driving * std::pow(unit, 3);
    const auto value = [](const Eigen::MatrixXd& m, std::size_t row, std::size_t column) {
        return m(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
    };
    std::vector<Group> group;
    const auto sources = [](std::size_t begin, std::size_t end, auto of) {
        std::vector<std::uint32_t> out;
        for (std::size_t r = begin; r < std::min(end, begin + kRowsAtOnce); ++r)
            out.push_back(static_cast<std::uint32_t>(of(r)));
        return out;
    };
    const auto itself = [](std::size_t r) { return r; };
    for (std::size_t m = 0; m < driven_; m += kRowsAtOnce)
        group.push_back(
            add_group(kNone, sources(kept() + m, moved(), itself), order_.count(),
                      [&](std::size_t r, std::size_t e) { return value(driving, m + r, e); }));
    for (std::size_t k = 0; k < kept(); k += kRowsAtOnce)
        group.push_back(add_group(
            kNone, sources(k, kept(), itself), PairOrder::count(std::min(k + kRowsAtOnce, kept())),
            [&](std::size_t r, std::size_t e) { return value(cubic, k + r, e); }));
    for (std::size_t k = 0; k < kept(); ++k)
        for (std::size_t l = k; l < kept(); l += kRowsAtOnce)
            group.push_back(
                add_group(static_cast<std::uint32_t>(l),
                          sources(l, kept(),
                                  [&](std::size_t r) { return first_pair_ + PairOrder::at(k, r); }),
                          PairOrder::count(k + 1), [&](std::size_t r, std::size_t e) {
                              return value(quartic, PairOrder::at(k, l + r), e);
                          }));
    for (std::size_t active = kFewest; active < kept(); active += kRowsAtOnce)
        add_level(active, group);
    add_level(kept(), group);
    follow_row_.assign(pairs_ * from.follow.size(), 0.0f);
    for (std::size_t s = 0; s < from.follow.size(); ++s)
        for (std::size_t e = 0; e < order_.count(); ++e)
            follow_row_[s * pairs_ + e] =
                static_cast<float>(value(from.following, s, e) * (unit * unit));
    const std::size_t rows = from.follow.empty() ? 0 : from.shape.size() / from.follow.size();
    shape_.assign(rows * columns_, 0.0f);
    for (std::size_t s = 0; s < from.follow.size(); ++s)
        for (std::size_t r = 0; r < rows; ++r)
            shape_[r * columns_ + s] = static_cast<float>(from.shape[s * rows + r]);
}

CubicTerms::Group
CubicTerms::add_group(std::uint32_t greatest, std::vector<std::uint32_t> source,
                      std::size_t entries,
                      const std::function<double(std::size_t row, std::size_t entry)>& value) {
    const auto registers = static_cast<std::uint32_t>(whole_lanes(entries) / kLanes);
    const std::size_t offset = coefficient_.size();
    for (std::size_t r = 0; r < source.size(); ++r) {
        const std::size_t begin = coefficient_.size();
        coefficient_.resize(begin + registers * kLanes, 0.0f);
        for (std::size_t e = 0; e < entries; ++e)
            coefficient_[begin + e] = static_cast<float>(value(r, e));
    }
    return {std::move(source), registers, greatest, offset};
}

void CubicTerms::add_level(std::size_t active, std::span<const Group> groups) {
    Level level{active, {}, {}, 0, 0};
    const auto most = static_cast<std::uint32_t>(whole_lanes(PairOrder::count(active)) / kLanes);
    for (const Group& group : groups) {
        std::size_t rows = group.source.size();
        if (group.greatest != kNone)
            rows = std::min(rows, active - std::min<std::size_t>(active, group.greatest));
        if (rows == 0)
            continue;
        const std::uint32_t registers = std::min(group.registers, most);
        level.block.push_back(
            {group.offset, group.registers, registers, static_cast<std::uint32_t>(rows)});
        level.source.insert(level.source.end(), group.source.begin(),
                            group.source.begin() + static_cast<std::ptrdiff_t>(rows));
        level.entries += rows * registers * kLanes;
        if (group.greatest == kNone)
            level.single = level.source.size();
    }
    level_.push_back(std::move(level));
}

CubicTerms::Work CubicTerms::make_work() const {
    Work work;
    work.source.assign(first_pair_ + pairs_, 0.0f);
    for (AlignedVector<float>* row : {&work.by, &work.answer})
        row->assign(level_.back().source.size() + kRowsAtOnce, 0.0f);
    work.sum.assign(pairs_, 0.0f);
    return work;
}

void CubicTerms::fill(std::size_t active, std::span<const double> amplitude,
                      Work& work) const noexcept {
    for (std::size_t i = 0; i < amplitude.size(); ++i)
        work.source[i] = static_cast<float>(scale_ * amplitude[i]);
    float* p = work.source.data() + first_pair_;
    for (std::size_t j = 0; j < active; ++j)
        for (std::size_t i = 0; i <= j; ++i)
            *p++ = work.source[i] * work.source[j];
    std::fill(p, work.source.data() + first_pair_ + whole_lanes(PairOrder::count(active)), 0.0f);
}

double CubicTerms::evaluate(std::size_t at, std::span<const double> amplitude,
                            std::span<double> force, Work& work) const noexcept {
    const Level& level = level_[at];
    fill(level.active, amplitude, work);
    std::fill_n(work.sum.begin(), whole_lanes(PairOrder::count(level.active)), 0.0f);
    const std::size_t rows = level.source.size();
    for (std::size_t r = 0; r < rows; ++r)
        work.by[r] = work.source[level.source[r]];
    add_rows_(coefficient_.data(), level.block, work.by.data(), work.source.data() + first_pair_,
              work.answer.data(), work.sum.data());
    std::fill(force.begin(), force.end(), 0.0);
    for (std::size_t r = 0; r < level.single; ++r)
        force[level.source[r]] = -scale_ * static_cast<double>(work.answer[r]);
    for (std::size_t r = level.single; r < rows; ++r)
        work.sum[level.source[r] - first_pair_] += work.answer[r];
    add_slope(level.active, -scale_, force, work);
    const auto doubles = [&](const AlignedVector<float>& from) {
        return Eigen::Map<const Eigen::VectorXf>(from.data(), static_cast<Eigen::Index>(rows))
            .cast<double>();
    };
    return doubles(work.by).dot(doubles(work.answer));
}

// From a slope by products to one by amplitudes.
void CubicTerms::add_slope(std::size_t active, double sign, std::span<double> force,
                           const Work& work) const noexcept {
    const float* d = work.sum.data();
    for (std::size_t j = 0; j < active; ++j) {
        const auto few = static_cast<Eigen::Index>(j + 1);
        const auto slope = Eigen::Map<const Eigen::VectorXf>(d, few).cast<double>();
        const auto q = Eigen::Map<const Eigen::VectorXf>(work.source.data(), few).cast<double>();
        const double own = slope.dot(q);
        Eigen::Map<Eigen::VectorXd>(force.data(), few) +=
            sign * static_cast<double>(work.source[j]) * slope;
        force[j] += sign * own;
        d += few;
    }
}

void CubicTerms::add_push(std::span<const double> amplitude, std::span<const double> push,
                          std::span<double> force, Work& work) const noexcept {
    fill(kept(), amplitude.first(kept()), work);
    std::fill(work.sum.begin(), work.sum.end(), 0.0f);
    auto* const sum = reinterpret_cast<Lanes*>(work.sum.data());
    for (std::size_t s = 0; s < follow_.size(); ++s) {
        const auto* const c = reinterpret_cast<const Lanes*>(follow_row_.data() + s * pairs_);
        const auto by = static_cast<float>(push[s]);
        for (std::size_t k = 0; k < pairs_ / kLanes; ++k)
            sum[k] += c[k] * by;
    }
    add_slope(kept(), scale_, force, work);
}

void CubicTerms::follow(std::span<const double> amplitude, std::span<const double> rate,
                        std::span<double> place, std::span<double> speed,
                        Work& work) const noexcept {
    fill(kept(), amplitude.first(kept()), work);
    // The products' rates.
    float* d = work.sum.data();
    for (std::size_t j = 0; j < kept(); ++j)
        for (std::size_t i = 0; i <= j; ++i)
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
        float sums[2][kLanes];
        std::memcpy(sums[0], &at, sizeof sums[0]);
        std::memcpy(sums[1], &pace, sizeof sums[1]);
        place[s] = static_cast<double>(std::accumulate(sums[0], sums[0] + kLanes, 0.0f));
        speed[s] = static_cast<double>(std::accumulate(sums[1], sums[1] + kLanes, 0.0f));
    }
}

} // namespace ode::soft
