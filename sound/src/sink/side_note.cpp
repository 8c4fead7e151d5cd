#include "sink/side_note.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace ode::sound {
namespace {

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (static_cast<unsigned char>(c) < 0x20) {
            char code[8];
            std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
            out += code;
        } else {
            out += c;
        }
    }
    return out + "\"";
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

} // namespace

const char* SideNote::write(const std::string& sound, const char* encoding, const Format& format,
                            std::uint64_t frames) const {
    std::string text = "{\n";
    const auto field = [&](const char* name, const std::string& value, bool last = false) {
        text += "  \"" + std::string(name) + "\": " + value + (last ? "\n" : ",\n");
    };
    field("sound", quoted(sound.substr(sound.find_last_of('/') + 1)));
    field("encoding", quoted(encoding));
    field("rate", std::to_string(format.rate));
    field("channels", std::to_string(format.channels));
    field("frames", std::to_string(frames));
    field("seconds", number(static_cast<double>(frames) / format.rate));
    field("start", number(calibration_.start));
    field("full_scale", number(calibration_.full_scale));
    field("unit", quoted(calibration_.unit));
    field("radiation", quoted(calibration_.radiation));
    field("sampling", quoted(calibration_.sampling));
    text += "  \"events\": [";
    for (std::size_t i = 0; i < event_.size(); ++i)
        text += std::string(i > 0 ? "," : "") + "\n    {\"seconds\": " +
                number(static_cast<double>(event_[i].frame) / format.rate) +
                ", \"frame\": " + std::to_string(event_[i].frame) +
                ", \"text\": " + quoted(event_[i].text) + "}";
    text += event_.empty() ? "]\n}\n" : "\n  ]\n}\n";

    const std::string beside = path_ + ".part";
    std::FILE* file = std::fopen(beside.c_str(), "wb");
    if (!file)
        return std::strerror(errno);
    const bool whole = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    const bool closed = std::fclose(file) == 0;
    if (!whole || !closed || std::rename(beside.c_str(), path_.c_str()) != 0) {
        const char* reason = std::strerror(errno);
        std::remove(beside.c_str());
        return reason;
    }
    return nullptr;
}

} // namespace ode::sound
