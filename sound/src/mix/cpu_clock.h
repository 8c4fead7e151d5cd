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
    /// Measures one job in kEvery. The number is coprime with the 4 and 16 or so substeps after
    /// which the sound path does its larger work, so that each kind is met in proportion.
    template <class Job>
    void run(Job&& job) {
        if (++count_ % kEvery != 0) {
            job();
            return;
        }
        const double begin = cpu_seconds();
        job();
        const double end = cpu_seconds();
        seconds_ += kEvery * (end - begin - (cpu_seconds() - end)); // less the clock's own time
    }

    /// Measures a long job in full.
    template <class Job>
    void run_whole(Job&& job) {
        const double begin = cpu_seconds();
        job();
        seconds_ += cpu_seconds() - begin;
    }

    double seconds() const noexcept { return seconds_ > 0.0 ? seconds_ : 0.0; }

private:
    static constexpr unsigned kEvery = 31;
    unsigned count_ = 0;
    double seconds_ = 0.0;
};

} // namespace ode::sound
