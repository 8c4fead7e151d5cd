#include "sink/openal_stream.h"

#include <AL/alext.h>
#include <algorithm>
#include <cmath>
#include <string>

namespace ode::sound {
namespace {

constexpr int kDevicePeriods = 4; ///< OpenAL Soft keeps three by default; one more to be sure

} // namespace

OpenAlStream::OpenAlStream(OpenAlDevice device, const Format& format,
                           const std::function<void(const char*)>& tell)
    : context_(std::move(device), format.rate), format_(format), fader_(format.channels) {
    if (format.channels != 1 && format.channels != 2)
        throw Refused("OpenAL sink: plays one or two channels, not " +
                      std::to_string(format.channels) + "; write those to a file");
    const OpenAlContext::Scope scope(context_);
    if (context_.rate() != format.rate)
        tell(("OpenAL sink: the device runs at " + std::to_string(context_.rate()) +
              " Hz and resamples sound rendered at " + std::to_string(format.rate) +
              " Hz; set the rate to the device's (dSoundSetRate) for exact sound")
                 .c_str());
    sample_format_ = AL_FORMAT_STEREO_FLOAT32;
    if (!alIsExtensionPresent("AL_EXT_FLOAT32")) {
        tell("OpenAL sink: this OpenAL library has no AL_EXT_FLOAT32, so sound is rounded to 16 "
             "bits; install OpenAL Soft for exact sound");
        sample_format_ = AL_FORMAT_STEREO16;
    }
    const int period = context_.period_frames();
    buffer_frames_ = (kMinFrames + period - 1) / period * period; // the least multiple from 256 on
    tail_frames_ = GapFader::kFade + static_cast<std::size_t>(kDevicePeriods * period);
    const auto frames = static_cast<std::size_t>(buffer_frames_);
    block_.resize(frames * static_cast<std::size_t>(format.channels));
    stereo_.resize(2 * frames);
    stereo16_.resize(2 * frames);

    // The application's error flag is the application's. Without roll-off its distance model does
    // nothing to our source.
    const bool shared = context_.is_borrowed();
    if (!shared)
        alGetError();
    alGenSources(1, &source_);
    for (Buffer& buffer : buffer_)
        alGenBuffers(1, &buffer.id);
    alSourcei(source_, AL_SOURCE_RELATIVE, AL_TRUE);
    alSourcef(source_, AL_ROLLOFF_FACTOR, 0);
    if (alIsExtensionPresent("AL_SOFT_direct_channels"))
        alSourcei(source_, AL_DIRECT_CHANNELS_SOFT, AL_TRUE);
    const bool made = alIsSource(source_) && alIsBuffer(buffer_.back().id);
    const ALenum error = shared ? AL_NO_ERROR : alGetError();
    if (!made || error != AL_NO_ERROR)
        throw Refused("OpenAL refuses a source with three buffers (error " + std::to_string(error) +
                      "); the application may have too many sources");
}

OpenAlStream::~OpenAlStream() {
    const OpenAlContext::Scope scope(context_);
    alSourceStop(source_);
    alSourcei(source_, AL_BUFFER, 0);
    alDeleteSources(1, &source_);
    for (Buffer& buffer : buffer_)
        alDeleteBuffers(1, &buffer.id);
}

void OpenAlStream::pump(FrameRing& ring, bool ending) noexcept {
    if (finished_)
        return;
    reclaim();
    if (started_ && state() == AL_STOPPED && queued_ == 0 && !(ending && tail_frames_ == 0)) {
        // This thread came too late and the device fell silent with a step that nobody can undo.
        ++underruns_;
        in_gap_ = true;
        fader_.restart();
    }
    const auto lead = static_cast<std::size_t>(kBuffers * buffer_frames_);
    if (!started_ && ring.size() < lead && !ending)
        return; // start with a full queue
    int fresh = 0;
    while (queued_ < kBuffers && refill(ring, ending))
        ++fresh;
    if (fresh > 0)
        play(fresh);
    finished_ = ending && queued_ == 0;
}

void OpenAlStream::reclaim() noexcept {
    ALint processed = 0;
    alGetSourcei(source_, AL_BUFFERS_PROCESSED, &processed);
    for (; processed > 0 && queued_ > 0; --processed) {
        ALuint id = 0;
        alSourceUnqueueBuffers(source_, 1, &id);
        const auto at = static_cast<std::size_t>(first_);
        played_frames_ += buffer_[at].frames;
        ++played_buffers_;
        first_ = (first_ + 1) % kBuffers;
        --queued_;
    }
}

bool OpenAlStream::refill(FrameRing& ring, bool ending) noexcept {
    const auto wanted = static_cast<std::size_t>(buffer_frames_);
    const std::size_t ready = std::min(ring.size(), wanted);
    if (ready < wanted) {
        if (!ending && queued_ > 1)
            return false; // the producer has time until the last buffer plays
        if (ending && ready == 0 && (tail_frames_ == 0 || !started_))
            return false;
        if (ending)
            tail_frames_ -= std::min(tail_frames_, wanted - ready);
        else if (!in_gap_)
            ++underruns_;
    }
    // A gap is over only when a whole buffer came: dribs and drabs are one underrun, not many.
    in_gap_ = ready < wanted;
    ring.read(std::span(block_).first(ready * static_cast<std::size_t>(format_.channels)));
    fader_.fill(block_, ready);
    Buffer& buffer = buffer_[static_cast<std::size_t>((first_ + queued_) % kBuffers)];
    buffer.frames = ready;
    upload(buffer.id);
    alSourceQueueBuffers(source_, 1, &buffer.id);
    ++queued_;
    started_ = true;
    return true;
}

void OpenAlStream::upload(ALuint buffer) noexcept {
    // OpenAL would pan a mono source; two equal channels go straight through.
    if (format_.channels == 1) {
        for (std::size_t i = 0; i < block_.size(); ++i)
            stereo_[2 * i] = stereo_[2 * i + 1] = block_[i];
    } else {
        std::copy(block_.begin(), block_.end(), stereo_.begin());
    }
    const void* data = stereo_.data();
    std::size_t bytes = stereo_.size() * sizeof(float);
    if (sample_format_ == AL_FORMAT_STEREO16) {
        to_int16(stereo_, stereo16_);
        data = stereo16_.data();
        bytes = stereo16_.size() * sizeof(short);
    }
    alBufferData(buffer, sample_format_, data, static_cast<ALsizei>(bytes), format_.rate);
}

/// Starts the source where it isn't playing. If it ran dry while the `fresh` buffers were being
/// queued, those before them have been heard and must not be heard again.
void OpenAlStream::play(int fresh) noexcept {
    if (state() == AL_PLAYING)
        return;
    if (state() == AL_STOPPED && queued_ > fresh) {
        ++underruns_;
        alSourcei(source_, AL_BUFFER, 0); // empties the queue
        for (; queued_ > fresh; --queued_, first_ = (first_ + 1) % kBuffers) {
            played_frames_ += buffer_[static_cast<std::size_t>(first_)].frames;
            ++played_buffers_;
        }
        for (int i = 0; i < queued_; ++i)
            alSourceQueueBuffers(source_, 1,
                                 &buffer_[static_cast<std::size_t>((first_ + i) % kBuffers)].id);
    }
    alSourcePlay(source_);
}

int OpenAlStream::state() const noexcept {
    ALint value = 0;
    alGetSourcei(source_, AL_SOURCE_STATE, &value);
    return value;
}

void to_int16(std::span<const float> from, std::span<short> to) noexcept {
    std::transform(from.begin(), from.end(), to.begin(), [](float x) {
        const float scaled = std::clamp(x * 32767.0F, -32768.0F, 32767.0F);
        return scaled == scaled ? static_cast<short>(std::lrint(scaled)) : short{0};
    });
}

} // namespace ode::sound
