// A struck body's samples: its oscillators, and what acts on them meanwhile.
#include "source/struck_voice.h"

#include <algorithm>
#include <utility>

namespace ode::sound {
namespace {

constexpr std::size_t kClick = ClickColumns::kCount;

} // namespace

/// Blows and forces of a run of samples, as the kernel is told of them.
class StruckVoice::Acting {
public:
    Acting(const StruckVoice& voice, std::int64_t first, int samples) noexcept
        : voice_(voice), first_(first), samples_(samples) {}

    /// @param series  its share from the run's first sample on; 0 outside begin .. end.
    void add(const float* series, const float* q, const float* v, std::size_t columns, int begin,
             int end) noexcept {
        if (begin < end)
            push_[count_++] = {series, q, v, static_cast<int>(columns), begin, end};
    }
    /// A pulse's share within the run. @return null: nothing.
    const float* row(const SampledPulse& pulse, int& begin, int& end) noexcept {
        begin = inside(pulse.first());
        end = inside(pulse.end());
        if (begin >= end)
            return nullptr;
        float* const out = fresh();
        pulse.read(first_, samples_, out);
        return out;
    }
    /// What follows one sample later finds a zero before the row.
    float* fresh() noexcept {
        float* const row = series_[rows_++];
        row[0] = 0.0f;
        return row + 1;
    }
    void add(const Pulse& pulse) noexcept {
        int begin = 0, end = 0;
        if (const float* own = row(pulse.modes, begin, end))
            add(own, nullptr, pulse.push.data(), columns_of(pulse.modes_heard), begin, end);
        const int last = inside(pulse.modes.end() - 1);
        if (pulse.modes.duration() <= kMended && pulse.modes.end() > first_ && last < samples_) {
            const std::size_t all = voice_.model_->columns;
            float* const q = voice_.model_->mend_rows.data() + 2 * all * mends_++;
            voice_.mend(pulse, q, q + all);
            add(kOnes, q, q + all, columns_of(pulse.modes_heard), last, last + 1);
        }
        if (const float* own = row(pulse.click, begin, end))
            jolt(own, pulse.jolt, begin, end);
    }
    void add(const Drive& drive) noexcept {
        float* const own = fresh();
        for (int i = 0; i < samples_; ++i) {
            const auto at = static_cast<std::size_t>(first_ + i - drive.begin - 1);
            own[i] = at < drive.series.size() ? drive.series[at] : 0.0f;
        }
        add(own, nullptr, drive.push.data(), columns_of(drive.modes_heard), 0, samples_);
        jolt(own, drive.jolt, 0, samples_);
    }
    void add_next(const float* q, const float* v) noexcept { add(kOnes, q, v, kModeLanes, 0, 1); }

    /// To the columns, over all samples or a part of them.
    RingPush* pushes() noexcept { return push_; }
    int count() const noexcept { return count_; }
    /// What the click's columns are still to get.
    bool next(float* q, float* v) const noexcept {
        bool any = false;
        for (int j = 0; j < jolts_; ++j) {
            const Jolt& own = jolt_[j];
            for (std::size_t k = 0; k < kClick && own.last != 0.0f; ++k) {
                q[k] = (any ? q[k] : 0.0f) + own.last * own.q[1][k];
                v[k] = (any ? v[k] : 0.0f) + own.last * own.v[1][k];
            }
            any = any || own.last != 0.0f;
        }
        return any;
    }

private:
    static constexpr int kMost = kMostPulses + kMostDrives;
    static_assert(4 * kMost < ode::sound::kMostPushes);
    static constexpr auto kOne = [] {
        std::array<float, ModalRun::kMost> out{};
        out.fill(1.0f);
        return out;
    }();
    static constexpr const float* kOnes = kOne.data();

    int inside(std::int64_t sample) const noexcept {
        return static_cast<int>(std::clamp<std::int64_t>(sample - first_, 0, samples_));
    }
    void jolt(const float* series, const Vec3& dipole, int begin, int end) noexcept {
        Jolt& own = jolt_[jolts_++];
        own.last = end == samples_ ? series[samples_ - 1] : 0.0f;
        for (std::size_t half = 0; half < 2; ++half) {
            const ClickColumns::Hold& hold = voice_.model_->click.hold[half];
            std::fill_n(own.q[half], kModeLanes, 0.0f);
            std::fill_n(own.v[half], kModeLanes, 0.0f);
            for (std::size_t i = 0; i < 3; ++i) {
                const double share = dipole[static_cast<int>(i)];
                own.q[half][i] = static_cast<float>(hold.q * share);
                own.v[half][i] = static_cast<float>(hold.v * share);
                own.q[half][3 + i] = static_cast<float>(hold.u * share);
            }
        }
        add(series, own.q[0], own.v[0], kModeLanes, begin, end);
        add(series - 1, own.q[1], own.v[1], kModeLanes, begin + 1, std::min(end + 1, samples_));
    }

    const StruckVoice& voice_;
    std::int64_t first_;
    int samples_;
    int rows_ = 0, count_ = 0, jolts_ = 0;
    std::size_t mends_ = 0;
    float series_[2 * kMost][ModalRun::kMost + 1];
    RingPush push_[4 * kMost + 1];
    /// What the click's columns get at a sample and, beside what goes on, at the next.
    struct Jolt {
        alignas(64) float q[2][kModeLanes], v[2][kModeLanes];
        float last; ///< of the series
    };
    Jolt jolt_[kMost];
};

void StruckVoice::ring(std::int64_t first, int samples) noexcept {
    float* const q_rows = model_->amplitude_rows.data();
    float* const v_rows = model_->rate_rows.data();
    const auto columns = static_cast<int>(active_), stride = static_cast<int>(model_->columns);
    Acting acting(*this, first, samples);
    if (has_next_)
        acting.add_next(next_q_.data(), next_v_.data());
    for (std::size_t p = 0; p < pulses_; ++p)
        acting.add(pulse_[p]);
    for (std::size_t d = 0; d < drives_; ++d)
        acting.add(drive_[d]);
    RingPush* const push = acting.pushes();
    const int pushes = acting.count();
    const float* const step = damped_ ? damped_step_.data() : model_->step.data();
    // From kick to kick.
    for (int done = 0; done < samples;) {
        const std::int64_t kick = kicks_ ? kicks_->next() : INT64_MAX;
        const int upto = static_cast<int>(std::clamp<std::int64_t>(
            kick - first + 1, done + 1, static_cast<std::int64_t>(samples)));
        float *const q = q_rows + done * columns, *const v = v_rows + done * columns;
        if (pushes > 0)
            kernels().ring_pushed(columns, upto - done, step, stride, amplitude_.data(),
                                  rate_of_.data(), q, v, push, pushes);
        else
            kernels().ring(columns, upto - done, step, stride, amplitude_.data(), rate_of_.data(),
                           q, v);
        for (int p = 0; p < pushes && upto < samples; ++p) { // what is left of each
            push[p].series += upto - done;
            push[p].begin -= upto - done;
            push[p].end -= upto - done;
        }
        done = upto;
        if (kick <= first + done - 1)
            take_kicks(first + done - 1, q_rows + (done - 1) * columns,
                       v_rows + (done - 1) * columns);
    }
    has_next_ = acting.next(next_q_.data(), next_v_.data());
    std::size_t kept = 0;
    for (std::size_t p = 0; p < pulses_; ++p)
        if (pulse_[p].last() >= first + samples) {
            if (kept != p)
                std::swap(pulse_[kept], pulse_[p]);
            ++kept;
        }
    pulses_ = kept;
}

void StruckVoice::take_kicks(std::int64_t sample, float* q_row, float* v_row) noexcept {
    const auto take = [&](Kicks& from, std::size_t begin) {
        for (; from.next() <= sample; from.pop())
            for (std::size_t k = 0; k < from.columns() && begin + k < active_; ++k) {
                q_row[begin + k] = amplitude_[begin + k] += from.q()[k];
                v_row[begin + k] = rate_of_[begin + k] += from.v()[k];
            }
    };
    take(kicks_->modes, kClick);
    take(kicks_->click, 0);
}

} // namespace ode::sound
