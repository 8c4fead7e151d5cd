#pragma once

#include <chrono>
#include <string>

namespace softsound {

/// One line on a terminal: how far, and how long still. Elsewhere it says nothing.
class Progress {
public:
    /// @param total  of what is counted, in any unit
    Progress(std::string what, double total, bool quiet);
    ~Progress(); ///< wipes the line
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Cheap enough for every step: redraws five times a second.
    void at(double done);

private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    double total_;
    bool shown_; // standard error is a terminal, and nobody asked for quiet
    Clock::time_point start_ = Clock::now();
    Clock::time_point drawn_ = start_;
};

} // namespace softsound
