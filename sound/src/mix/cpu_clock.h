#pragma once

#include <ctime>

namespace ode::sound {

/// CPU time of the calling thread [s]. Reading it costs a system call: too much for every substep.
inline double cpu_seconds() noexcept {
    std::timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Time that passes [s]; no system call.
inline double wall_seconds() noexcept {
    std::timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Sums up the cost of many short jobs from a few of them.
///
/// Short jobs are timed by the wall's clock: a system call before a job of a microsecond makes it
/// half as long again. One that takes longer than kShort may have been interrupted: it is not
/// counted, and the next kCareful are timed by this thread's own clock, long ones among them.
class SampledCost {
public:
    using Clock = double() noexcept;
    explicit SampledCost(Clock* cpu = cpu_seconds, Clock* wall = wall_seconds) noexcept
        : cpu_(cpu), wall_(wall) {}

    /// Measures one job in kEvery. The number is coprime with the 4 and 16 or so substeps after
    /// which the sound path does its larger work, so that each kind is met in proportion.
    template <class Job>
    void run(Job&& job) {
        if (++count_ % kEvery != 0 && !again_) {
            job();
            return;
        }
        const bool careful = careful_ > 0;
        Clock* const now = careful ? cpu_ : wall_;
        once_ = 0.0;
        const double begin = now();
        job();
        const double end = now();
        careful_ = end - begin > kShort ? kCareful : careful_ - careful;
        again_ = !careful && end - begin > kShort;
        if (!again_)
            seconds_ += kEvery * (end - begin - once_ - (now() - end)); // less the clock's own time
    }

    /// Measures what will not come again, in full, within a job or not.
    template <class Job>
    auto run_once(Job&& job) {
        const double begin = cpu_(), passing = wall_();
        auto result = job();
        once_ += careful_ > 0 ? cpu_() - begin : wall_() - passing; // by the job's clock
        seconds_ += cpu_() - begin;
        return result;
    }

    /// Measures a long job in full.
    template <class Job>
    void run_whole(Job&& job) {
        const double begin = cpu_();
        job();
        seconds_ += cpu_() - begin;
    }

    double seconds() const noexcept { return seconds_ > 0.0 ? seconds_ : 0.0; }

private:
    static constexpr unsigned kEvery = 31;
    static constexpr double kShort = 1e-4; ///< [s]
    static constexpr int kCareful = 64;
    Clock *cpu_, *wall_;
    unsigned count_ = 0;
    int careful_ = 0;
    bool again_ = false; ///< the last one may have been interrupted
    double seconds_ = 0.0;
    double once_ = 0.0; ///< of the job under way, counted already
};

} // namespace ode::sound
