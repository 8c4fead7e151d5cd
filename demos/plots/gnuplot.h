#pragma once

#include <cstdio>
#include <span>
#include <string>

namespace plots {

/// A running gnuplot that is fed commands and data through a pipe. It need not be installed.
class Gnuplot {
public:
    Gnuplot();
    ~Gnuplot();
    Gnuplot(const Gnuplot&) = delete;
    Gnuplot& operator=(const Gnuplot&) = delete;

    /// Appends commands; the caller ends lines.
    void say(const std::string& commands);
    /// Appends raw 32-bit floats, for `plot '-' binary`.
    void send(std::span<const float> data);

    /// Ends gnuplot. @return "" when all went well, else a sentence the user can act on.
    std::string finish();

private:
    std::FILE* pipe_ = nullptr;
};

/// A string in gnuplot's single quotes.
std::string quoted(const std::string& text);

} // namespace plots
