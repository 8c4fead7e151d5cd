#include "source/kicks.h"

#include "dsp/kernels.h"
#include "transfer/wave.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode::sound {

Kicks::Kicks(std::vector<Column> column, double rate)
    : column_(std::move(column)), rate_(rate),
      stride_((column_.size() + kModeLanes - 1) / kModeLanes * kModeLanes) {
    for (const Column& own : column_)
        damped_.push_back(
            std::sqrt(std::max(0.0, (own.omega - own.decay) * (own.omega + own.decay))));
    for (std::vector<double>* row :
         {&angle_, &cosine_, &sine_, &q_from_q_, &q_from_v_, &v_from_q_, &v_from_v_, &q_, &v_})
        row->assign(column_.size(), 0.0);
}

void Kicks::evolve(double time) noexcept {
    const std::size_t n = column_.size();
    if (time != lapse_) { // substeps are alike
        lapse_ = time;
        for (std::size_t k = 0; k < n; ++k)
            angle_[k] = damped_[k] * time;
        turn(angle_.data(), static_cast<int>(n), cosine_.data(), sine_.data());
        for (std::size_t k = 0; k < n; ++k) {
            const auto& [w, d] = column_[k];
            const double fade = std::exp(-d * time), c = fade * cosine_[k];
            // What creeps is no sound.
            const double s = damped_[k] > 0.0 ? fade * sine_[k] / damped_[k] : fade * time;
            q_from_q_[k] = w > 0.0 ? c + d * s : fade;
            q_from_v_[k] = w > 0.0 ? s : 0.0;
            v_from_q_[k] = -w * w * s;
            v_from_v_[k] = c - d * s;
        }
    }
    for (std::size_t k = 0; k < n; ++k) {
        const double q = q_[k], v = v_[k];
        q_[k] = q_from_q_[k] * q + q_from_v_[k] * v;
        v_[k] = v_from_q_[k] * q + v_from_v_[k] * v;
    }
}

void Kicks::add(double time, const double* q, const double* v) {
    const auto sample = static_cast<std::int64_t>(std::ceil(time * rate_));
    if (open_ && sample > collecting_)
        finish();
    if (!open_) {
        open_ = true;
        collecting_ = sample;
        at_ = time;
    } else if (time > at_) {
        evolve(time - at_);
        at_ = time;
    }
    for (std::size_t k = 0; k < column_.size(); ++k) {
        q_[k] += q ? q[k] : 0.0;
        v_[k] += v[k];
    }
}

void Kicks::finish() {
    evolve(std::max(0.0, static_cast<double>(collecting_) / rate_ - at_));
    sample_.push_back(collecting_);
    row_.resize(2 * sample_.size() * stride_);
    float* const row = row_.data() + 2 * (sample_.size() - 1) * stride_;
    std::fill(row, row + 2 * stride_, 0.0f);
    for (std::size_t k = 0; k < column_.size(); ++k) {
        row[k] = static_cast<float>(q_[k]);
        row[stride_ + k] = static_cast<float>(v_[k]);
        q_[k] = v_[k] = 0.0;
    }
    open_ = false;
}

void Kicks::close(double time) {
    if (open_ && static_cast<double>(collecting_) <= time * rate_)
        finish();
}

void Kicks::pop() noexcept {
    if (++first_ < sample_.size())
        return;
    sample_.clear();
    row_.clear();
    first_ = 0;
}

} // namespace ode::sound
