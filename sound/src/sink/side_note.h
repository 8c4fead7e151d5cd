#pragma once

#include "sink/sink.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ode::sound {

/// What a sound file cannot say itself, as JSON beside it: unit, calibration, format, events.
class SideNote {
public:
    explicit SideNote(std::string path) : path_(std::move(path)) {}

    void set(const Calibration& calibration) { calibration_ = calibration; }
    void add_event(std::uint64_t frame, std::string text) {
        event_.push_back({frame, std::move(text)});
    }

    /// Writes the note anew, whole or not at all. @param frames  in the sound file so far.
    /// @return nullptr, or the reason of the failure in the words of the system.
    const char* write(const std::string& sound, const char* encoding, const Format& format,
                      std::uint64_t frames) const;

    const std::string& path() const noexcept { return path_; }

private:
    struct Event {
        std::uint64_t frame;
        std::string text;
    };
    std::string path_;
    Calibration calibration_;
    std::vector<Event> event_;
};

} // namespace ode::sound
