#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

namespace softsound {

/// The stretch of sound between two impacts.
struct Ring {
    double begin, end; ///< [s]
};

/// What rings after each impact.
/// @param late  what lies between an impact and its clean ring at the ear: travel and chatter [s]
std::vector<Ring> rings(const std::vector<double>& impacts, double end, double late);

/// How strong each line is after each impact: the same lines, weighed anew.
/// @param line   predicted frequencies, ascending [Hz]
/// @param reach  how far a line may be off for the body's speed and the window [cents]
/// @return keys lines_hz; levels_db, a row for each impact, null where a line isn't heard;
/// reweighted_db, the largest change of a line against the loudest one from impact to impact;
/// drift_cents, how far apart a line was heard after different impacts at most.
nlohmann::ordered_json follow_lines(std::span<const float> sound, double rate,
                                    std::span<const Ring> rings, std::span<const double> line,
                                    double reach);

} // namespace softsound
