#include "mix/settings.h"

#include "path/ear_line.h"
#include "path/paper_line.h"
#include "source/paper_surface.h"
#include "source/surface_flow.h"

#include <array>
#include <cmath>

namespace ode::sound {
namespace {

constexpr std::array<std::string_view, 2> kNames = {"sinc", "paper"};

} // namespace

std::string_view sampling_name(int i) noexcept {
    const auto at = static_cast<std::size_t>(i);
    return at < kNames.size() ? kNames[at] : std::string_view{};
}

bool find_sampling(std::string_view name, Sampling& sampling) noexcept {
    for (std::size_t i = 0; i < kNames.size(); ++i)
        if (kNames[i] == name) {
            sampling = static_cast<Sampling>(i);
            return true;
        }
    return false;
}

double Settings::send_rate() const noexcept {
    return sampling == Sampling::kSinc ? SurfaceFlow::kOversampling * static_cast<double>(rate)
                                       : static_cast<double>(rate);
}

int Settings::lag() const noexcept {
    return sampling == Sampling::kPaper ? PaperSurface::kLag : SurfaceFlow::kLag;
}

std::int64_t Settings::first_open_frame(double time, int lag) const noexcept {
    const auto sent = static_cast<std::int64_t>(std::floor(time * send_rate()));
    if (sampling == Sampling::kPaper)
        return sent - lag - PaperLine::kBefore;
    const std::int64_t ready = sent - lag - EarLine::lookahead(rate);
    return static_cast<std::int64_t>(std::floor(static_cast<double>(ready) / 2.0));
}

} // namespace ode::sound
