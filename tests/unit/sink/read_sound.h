#pragma once

#include <sndfile.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace ode::sound::test {

/// A sound file as libsndfile, which is not what wrote WAV, understands it.
struct ReadSound {
    SF_INFO info{};
    std::vector<float> sample;

    explicit ReadSound(const std::string& path) {
        SNDFILE* file = sf_open(path.c_str(), SFM_READ, &info);
        if (!file)
            throw std::runtime_error(path + ": " + sf_strerror(nullptr));
        std::vector<float> block(static_cast<std::size_t>(4096 * info.channels));
        for (sf_count_t got = 1; got > 0;) { // not info.frames: an unfinished FLAC doesn't know it
            got = sf_readf_float(file, block.data(), 4096);
            sample.insert(sample.end(), block.begin(), block.begin() + got * info.channels);
        }
        sf_close(file);
    }
};

} // namespace ode::sound::test
