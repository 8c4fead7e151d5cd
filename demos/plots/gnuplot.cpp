#include "plots/gnuplot.h"

#include <csignal>
#include <sys/wait.h>

namespace plots {

Gnuplot::Gnuplot() {
    // A gnuplot that ends early must not end us: writes then fail, and finish() tells.
    std::signal(SIGPIPE, SIG_IGN);
    pipe_ = popen("gnuplot >/dev/null 2>&1", "w");
}

Gnuplot::~Gnuplot() { finish(); }

void Gnuplot::say(const std::string& commands) {
    if (pipe_)
        std::fwrite(commands.data(), 1, commands.size(), pipe_);
}

void Gnuplot::send(std::span<const float> data) {
    if (pipe_)
        std::fwrite(data.data(), sizeof(float), data.size(), pipe_);
}

std::string Gnuplot::finish() {
    if (!pipe_)
        return "gnuplot could not be started";
    const int status = pclose(pipe_);
    pipe_ = nullptr;
    constexpr int kNotFound = 127; // of the shell
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return "";
    if (WIFEXITED(status) && WEXITSTATUS(status) == kNotFound)
        return "gnuplot is not installed (package gnuplot-nox)";
    return "gnuplot failed; can the file be written?";
}

std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text)
        out += c == '\'' ? std::string("''") : std::string(1, c);
    return out + "'";
}

} // namespace plots
