#include "strike/sampled_pulse.h"

#include "strike/pulse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::sound {
namespace {

/// Taps about the middle whose response is 1 / sinc(w/2)^4 up to w = 5/6 pi, least errors by
/// weighted least squares.
constexpr int kReach = 4;
constexpr double kFlatTap[kReach + 1] = {1.956325, -0.660479, 0.251072, -0.100909, 0.032153};

/// sin^(3/2) of an angle that goes on from step to step, 0 where the sine is negative.
class Course {
public:
    Course(double angle, double step) noexcept
        : sine_(std::sin(angle)), cosine_(std::cos(angle)), turn_sine_(std::sin(step)),
          turn_cosine_(std::cos(step)) {}
    double next() noexcept {
        const double s = std::max(0.0, sine_);
        const double turned = sine_ * turn_cosine_ + cosine_ * turn_sine_;
        cosine_ = cosine_ * turn_cosine_ - sine_ * turn_sine_;
        sine_ = turned;
        return s * std::sqrt(s);
    }

private:
    double sine_, cosine_, turn_sine_, turn_cosine_;
};

/// The integral of sin^(3/2)(pi u) over all u.
double whole() noexcept {
    static const double made =
        std::tgamma(1.25) / (std::sqrt(std::numbers::pi) * std::tgamma(1.75));
    return made;
}

} // namespace

double SampledPulse::smoothing(double w) noexcept {
    const double half = 0.5 * w, sinc = half > 0.0 ? std::sin(half) / half : 1.0;
    return sinc * sinc * sinc;
}

void SampledPulse::aim(double begin, double duration, Window window) noexcept {
    begin_ = begin;
    duration_ = duration;
    late_ = 0.0f;
    if (!is_short()) {
        first_ = static_cast<std::int64_t>(std::ceil(begin));
        end_ = static_cast<std::int64_t>(std::ceil(begin + duration));
        return;
    }
    const int reach = window == Window::kFlat ? kReach : 0;
    // In parts that each come at one time, so many a sample that images of these fall where the
    // spline has its zeros. A part at x gives the samples next to it, by the spline's three pieces.
    const double apart = duration > 8.0 ? 0.5 : duration > 4.0 ? 0.25 : 0.125;
    const int parts = std::max(1, static_cast<int>(std::ceil(duration / apart - 0.5)));
    const double early = 0.5 * (duration - (parts - 1) * apart);
    const double origin = std::floor(begin + 0.5) - 1.0 - reach;
    std::array<float, kMost> smooth{};
    Course course(std::numbers::pi * early / duration, std::numbers::pi * apart / duration);
    float x = static_cast<float>(begin - origin + early), sum = 0.0f;
    int last = 0;
    for (int i = 0; i < parts; ++i) {
        const auto part = static_cast<float>(course.next());
        sum += part;
        const int near = static_cast<int>(x + 0.5f);
        const float off = x - static_cast<float>(near); // -1/2 .. 1/2
        float* const at = smooth.data() + near - 1;
        at[0] += part * 0.5f * (0.5f - off) * (0.5f - off);
        at[1] += part * (0.75f - off * off);
        at[2] += part * 0.5f * (0.5f + off) * (0.5f + off);
        last = near + 1;
        x += static_cast<float>(apart);
    }
    for (float& own : smooth)
        own *= 1.0f / sum;
    first_ = static_cast<std::int64_t>(origin);
    const int count = last + reach + 1;
    end_ = first_ + count;
    if (reach == 0) {
        short_ = smooth;
    } else {
        // Neighbours on both sides, off the ends there are none.
        std::array<float, kMost + 2 * kReach> wide{};
        std::copy(smooth.begin(), smooth.end(), wide.begin() + kReach);
        for (int i = 0; i < count; ++i) {
            const float* const at = wide.data() + kReach + i;
            float flat = static_cast<float>(kFlatTap[0]) * at[0];
            for (int j = 1; j <= kReach; ++j)
                flat += static_cast<float>(kFlatTap[j]) * (at[j] + at[-j]);
            short_[static_cast<std::size_t>(i)] = flat;
        }
    }
}

void SampledPulse::hurry(std::int64_t earliest) noexcept {
    if (first_ >= earliest)
        return;
    if (!is_short()) {
        late_ = static_cast<float>(
            pulse_share((static_cast<double>(earliest) - 0.5 - begin_) / duration_));
        first_ = earliest;
        end_ = std::max(end_, earliest + 1);
        return;
    }
    const auto count = static_cast<std::size_t>(end_ - first_);
    const auto missed = static_cast<std::size_t>(
        std::min<std::int64_t>(earliest - first_, static_cast<std::int64_t>(count) - 1));
    float sum = 0.0f;
    for (std::size_t i = 0; i < missed; ++i)
        sum += short_[i];
    short_[missed] += sum;
    std::copy(short_.begin() + static_cast<std::ptrdiff_t>(missed),
              short_.begin() + static_cast<std::ptrdiff_t>(count), short_.begin());
    first_ = earliest;
    end_ = first_ + static_cast<std::int64_t>(count - missed);
}

double SampledPulse::rest(std::int64_t from) const noexcept {
    if (from <= first_)
        return 1.0;
    if (from >= end_)
        return 0.0;
    if (!is_short())
        return 1.0 - pulse_share((static_cast<double>(from) - 0.5 - begin_) / duration_);
    double sum = 0.0;
    for (std::int64_t i = from; i < end_; ++i)
        sum += static_cast<double>(short_[static_cast<std::size_t>(i - first_)]);
    return sum;
}

void SampledPulse::read(std::int64_t from, int samples, float* out) const noexcept {
    const auto begin = static_cast<int>(std::clamp<std::int64_t>(first_ - from, 0, samples));
    const auto end = static_cast<int>(std::clamp<std::int64_t>(end_ - from, begin, samples));
    std::fill(out, out + begin, 0.0f);
    std::fill(out + end, out + samples, 0.0f);
    if (begin == end)
        return;
    if (is_short()) {
        const auto at = static_cast<std::ptrdiff_t>(from + begin - first_);
        std::copy_n(short_.begin() + at, end - begin, out + begin);
        return;
    }
    const double step = std::numbers::pi / duration_;
    Course course(step * (static_cast<double>(from + begin) - begin_), step);
    const double scale = 1.0 / (duration_ * whole());
    for (int i = begin; i < end; ++i) {
        const double force = course.next();
        const bool over = static_cast<double>(from + i) >= begin_ + duration_; // all was late
        out[i] = over ? 0.0f : static_cast<float>(scale * force);
    }
    if (from + begin == first_)
        out[begin] += late_;
}

} // namespace ode::sound
