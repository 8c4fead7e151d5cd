#pragma once

#include <ctime>

namespace ode::sound {

/// CPU time of the calling thread [s]. Reading it costs a system call: too much for every substep.
inline double cpu_seconds() noexcept {
    std::timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Sums up the cost of many short jobs from a few of them.
class SampledCost {
public:
    using Clock = double() noexcept;
    explicit SampledCost(Clock* clock = cpu_seconds) noexcept : now_(clock) {}

    /// Measures one job in kEvery. The number is coprime with the 4 and 16 or so substeps after
    /// which the sound path does its larger work, so that each kind is met in proportion.
    template <class Job>
    void run(Job&& job) {
        if (++count_ % kEvery != 0) {
            job();
            return;
        }
        once_ = 0.0;
        const double begin = now_();
        job();
        const double end = now_();
        // Less the clock's own time.
        seconds_ += kEvery * (end - begin - once_ - (now_() - end));
    }

    /// Measures what will not come again, in full, within a job or not.
    template <class Job>
    auto run_once(Job&& job) {
        const double begin = now_();
        auto result = job();
        const double spent = now_() - begin;
        seconds_ += spent;
        once_ += spent;
        return result;
    }

    /// Measures a long job in full.
    template <class Job>
    void run_whole(Job&& job) {
        const double begin = now_();
        job();
        seconds_ += now_() - begin;
    }

    double seconds() const noexcept { return seconds_ > 0.0 ? seconds_ : 0.0; }

private:
    static constexpr unsigned kEvery = 31;
    Clock* now_; ///< [s]
    unsigned count_ = 0;
    double seconds_ = 0.0;
    double once_ = 0.0; ///< of the job under way, counted already
};

} // namespace ode::sound
