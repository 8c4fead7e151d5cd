#include "reduced/cubic_kicks.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

// Of an interval: sums of substeps.
constexpr double kRounding = 1e-9;
// Longest interval by the highest mode moved [rad]: the filter is 1.34 there, and no two modes
// resonate with the impulses, whose sum of angles would have to reach 2 pi.
constexpr double kAngle = 2.2;

// Looks between those that ask whether fewer modes would do, and how many of these must say so.
constexpr int kAsked = 64;
constexpr int kPatience = 3;
// Of the force, in amplitudes that it would move: what may be left out. Half of it, to leave out
// more.
constexpr double kLeftOut = 0.02;

} // namespace

CubicKicks::CubicKicks(std::shared_ptr<const CubicTerms> terms, std::span<const double> omega)
    : terms_(std::move(terms)), work_(terms_->make_work()), level_(terms_->levels() - 1),
      omega_(omega.begin(), omega.begin() + static_cast<std::ptrdiff_t>(terms_->moved())),
      filter_(omega_.size(), 1.0), filtered_(omega_.size(), 0.0), force_(omega_.size(), 0.0),
      longest_(kAngle / *std::max_element(omega_.begin(), omega_.end())) {
    whole_ = kept_.force = force_;
    load_.assign(terms_->columns(), 0.0);
}

void CubicKicks::set_load(std::span<const double> push) noexcept {
    const bool loaded = std::any_of(push.begin(), push.end(), [](double f) { return f != 0; });
    if (loaded || loaded_)
        known_ = false;
    loaded_ = loaded;
    if (loaded_)
        widen();
    std::copy(push.begin(), push.end(), load_.begin());
}

void CubicKicks::set_length(double length) noexcept {
    if (length == filter_length_)
        return;
    filter_length_ = length;
    known_ = false;
    for (std::size_t k = 0; k < omega_.size(); ++k) {
        const double half = omega_[k] * length / 2;
        filter_[k] = half > 1e-4 ? std::sqrt(std::tan(half) / half) : 1.0;
    }
}

void CubicKicks::widen() noexcept {
    const std::size_t widest = terms_->levels() - 1;
    if (level_ != widest)
        known_ = false;
    level_ = widest;
    unasked_ = calm_ = 0;
}

double CubicKicks::left_out(std::size_t level) noexcept {
    terms_->evaluate(level, filtered_, force_, work_);
    double off = 0, all = 0;
    for (std::size_t k = 0; k < omega_.size(); ++k) {
        const double by = 1 / (omega_[k] * omega_[k]);
        off += by * (force_[k] - whole_[k]) * (force_[k] - whole_[k]);
        all += by * whole_[k] * whole_[k];
    }
    return off > 0 ? std::sqrt(off / all) : 0;
}

void CubicKicks::choose_level() noexcept {
    if (loaded_ || ++unasked_ < kAsked)
        return;
    unasked_ = 0;
    const std::size_t widest = terms_->levels() - 1;
    terms_->evaluate(widest, filtered_, whole_, work_);
    if (level_ < widest && left_out(level_) > kLeftOut) {
        ++level_;
        calm_ = 0;
        return;
    }
    const auto fewer_do = [&] { return level_ > 0 && left_out(level_ - 1) < kLeftOut / 2; };
    calm_ = fewer_do() ? calm_ + 1 : 0;
    if (calm_ < kPatience)
        return;
    calm_ = 0;
    do
        --level_;
    while (fewer_do());
}

void CubicKicks::look(std::span<const double> amplitude) noexcept {
    for (std::size_t k = 0; k < omega_.size(); ++k)
        filtered_[k] = filter_[k] * amplitude[k];
    choose_level();
    energy_ = terms_->evaluate(level_, filtered_, force_, work_);
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
    kept_.level = level_;
    kept_.unasked = unasked_;
    kept_.calm = calm_;
}

void CubicKicks::take_back() noexcept {
    std::copy(kept_.force.begin(), kept_.force.end(), force_.begin());
    length_ = 0;
    set_length(kept_.filter_length > 0 ? kept_.filter_length : longest_);
    length_ = kept_.length;
    done_ = kept_.done;
    energy_ = kept_.energy;
    known_ = kept_.known;
    level_ = kept_.level;
    unasked_ = kept_.unasked;
    calm_ = kept_.calm;
}

} // namespace ode::soft
