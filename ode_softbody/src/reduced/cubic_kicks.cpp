#include "reduced/cubic_kicks.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

// Of an interval: sums of substeps.
constexpr double kRounding = 1e-9;
// Longest interval by the highest mode moved [rad]: the filter's tangent is 1.27 there, and no two
// modes resonate with the impulses, whose sum of angles would have to reach 2 pi.
constexpr double kAngle = 1.5707963267948966;

} // namespace

CubicKicks::CubicKicks(std::shared_ptr<const CubicTerms> terms, std::span<const double> omega)
    : terms_(std::move(terms)), work_(terms_->make_work()),
      omega_(omega.begin(), omega.begin() + static_cast<std::ptrdiff_t>(terms_->moved())),
      filter_(omega_.size(), 1.0), filtered_(omega_.size(), 0.0), force_(omega_.size(), 0.0),
      longest_(kAngle / *std::max_element(omega_.begin(), omega_.end())) {
    kept_.force = force_;
    load_.assign(terms_->columns(), 0.0);
}

void CubicKicks::set_load(std::span<const double> push) noexcept {
    const bool loaded = std::any_of(push.begin(), push.end(), [](double f) { return f != 0; });
    if (loaded || loaded_)
        known_ = false;
    loaded_ = loaded;
    std::copy(push.begin(), push.end(), load_.begin());
}

void CubicKicks::set_length(double length) noexcept {
    if (length == filter_length_)
        return;
    filter_length_ = length;
    known_ = false;
    for (std::size_t k = 0; k < omega_.size(); ++k) {
        const double half = omega_[k] * length / 2;
        filter_[k] = half > 1e-4 ? std::tan(half) / half : 1.0;
    }
}

void CubicKicks::look(std::span<const double> amplitude) noexcept {
    for (std::size_t k = 0; k < omega_.size(); ++k)
        filtered_[k] = filter_[k] * amplitude[k];
    energy_ = terms_->evaluate(filtered_, force_, work_);
    if (loaded_)
        terms_->add_push(filtered_, load_, force_, work_);
    for (std::size_t k = 0; k < omega_.size(); ++k)
        force_[k] *= filter_[k];
    known_ = true;
}

void CubicKicks::begin(double dt, std::span<const double> amplitude,
                       std::span<double> rate) noexcept {
    if (length_ > 0 && done_ + dt > length_ * (1 + kRounding))
        close(amplitude, rate);
    if (length_ > 0)
        return;
    const double length = dt * std::fmax(1.0, std::floor(longest_ / dt * (1 + kRounding)));
    set_length(length);
    if (!known_)
        look(amplitude);
    for (std::size_t k = 0; k < force_.size(); ++k)
        rate[k] += length / 2 * force_[k];
    length_ = length;
    done_ = 0;
}

void CubicKicks::end(double dt, std::span<const double> amplitude,
                     std::span<double> rate) noexcept {
    known_ = false;
    done_ += dt;
    if (done_ >= length_ * (1 - kRounding))
        close(amplitude, rate);
}

void CubicKicks::close(std::span<const double> amplitude, std::span<double> rate) noexcept {
    if (length_ == 0)
        return;
    if (!known_)
        look(amplitude);
    const double left = done_ - length_ / 2;
    for (std::size_t k = 0; k < force_.size(); ++k)
        rate[k] += left * force_[k];
    length_ = 0;
}

void CubicKicks::keep() noexcept {
    std::copy(force_.begin(), force_.end(), kept_.force.begin());
    kept_.filter_length = filter_length_;
    kept_.length = length_;
    kept_.done = done_;
    kept_.energy = energy_;
    kept_.known = known_;
}

void CubicKicks::take_back() noexcept {
    std::copy(kept_.force.begin(), kept_.force.end(), force_.begin());
    length_ = 0;
    set_length(kept_.filter_length > 0 ? kept_.filter_length : longest_);
    length_ = kept_.length;
    done_ = kept_.done;
    energy_ = kept_.energy;
    known_ = kept_.known;
}

} // namespace ode::soft
