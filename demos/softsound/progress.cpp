#include "softsound/progress.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>
#include <utility>

namespace softsound {

Progress::Progress(std::string what, double total, bool quiet)
    : what_(std::move(what)), total_(total), shown_(!quiet && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (shown_)
        std::fputs("\r\033[K", stderr);
}

void Progress::at(double done) {
    using namespace std::chrono_literals;
    const auto now = Clock::now();
    if (!shown_ || now - drawn_ < 200ms || done <= 0)
        return;
    drawn_ = now;
    const double spent = std::chrono::duration<double>(now - start_).count();
    const double left = spent * std::max(0.0, total_ / done - 1);
    std::fprintf(stderr, "\r%s %3.0f %%, %.0f s left\033[K", what_.c_str(), 100 * done / total_,
                 left);
    std::fflush(stderr);
}

} // namespace softsound
