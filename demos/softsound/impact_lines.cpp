#include "softsound/impact_lines.h"

#include "plots/partials.h"

#include <algorithm>
#include <cmath>

namespace softsound {
namespace {

constexpr double kWindow = 0.04; // [s]: alike after all impacts, so that levels compare
constexpr double kFaint = 50;    // [dB] below the loudest line, what a window leaks is as strong

} // namespace

std::vector<Ring> rings(const std::vector<double>& impacts, double end, double late) {
    std::vector<Ring> out;
    for (std::size_t i = 0; i < impacts.size(); ++i)
        out.push_back({impacts[i] + late, i + 1 < impacts.size() ? impacts[i + 1] : end});
    return out;
}

nlohmann::ordered_json follow_lines(std::span<const float> sound, double rate,
                                    std::span<const Ring> rings, std::span<const double> line,
                                    double reach) {
    auto levels = nlohmann::ordered_json::array();
    std::vector<double> lowest(line.size(), HUGE_VAL), highest(line.size(), -HUGE_VAL);
    std::vector<double> weakest = lowest, strongest = highest;
    for (const Ring& ring : rings) {
        const auto first = static_cast<std::size_t>(ring.begin * rate);
        const auto count = static_cast<std::size_t>(kWindow * rate);
        std::vector<plots::Partial> heard;
        if (ring.end - ring.begin >= kWindow && first + count <= sound.size())
            heard = plots::find_partials(sound.subspan(first, count), rate, line, reach, 12);
        double loudest = -HUGE_VAL;
        for (const plots::Partial& p : heard)
            loudest = std::max(loudest, p.level);
        std::erase_if(heard, [&](const auto& p) { return p.level < loudest - kFaint; });
        auto row = nlohmann::ordered_json::array();
        for (std::size_t i = 0; i < line.size(); ++i) {
            const auto own = std::find_if(heard.begin(), heard.end(),
                                          [&](const auto& p) { return p.predicted == line[i]; });
            if (own == heard.end()) {
                row.push_back(nullptr);
                continue;
            }
            row.push_back(own->level);
            lowest[i] = std::min(lowest[i], own->measured);
            highest[i] = std::max(highest[i], own->measured);
            weakest[i] = std::min(weakest[i], own->level - loudest);
            strongest[i] = std::max(strongest[i], own->level - loudest);
        }
        levels.push_back(row);
    }
    double drift = 0, reweighted = 0;
    for (std::size_t i = 0; i < line.size(); ++i)
        if (highest[i] >= lowest[i]) {
            drift = std::max(drift, 1200 * std::log2(highest[i] / lowest[i]));
            reweighted = std::max(reweighted, strongest[i] - weakest[i]);
        }
    return {{"lines_hz", line},
            {"levels_db", levels},
            {"reweighted_db", reweighted},
            {"drift_cents", drift}};
}

} // namespace softsound
