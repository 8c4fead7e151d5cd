#include "sink/side_by_side.h"

#include <algorithm>
#include <numeric>

namespace ode::sound {

/// What a listener sees of it. The whole's clock and errors are each part's.
class SideBySide::Part final : public Sink {
public:
    Part(SideBySide& all, std::size_t index) : all_(all), index_(index) {}
    bool open(const Format& format) override { return all_.open(format, index_); }
    void calibrate(const Calibration& calibration) override { all_.whole_->calibrate(calibration); }
    std::size_t write(std::span<const float> interleaved) noexcept override {
        return all_.write(interleaved, index_);
    }
    void close() noexcept override { all_.finish(); }
    const char* error() const noexcept override { return all_.whole_->error(); }
    const char* kind() const noexcept override { return all_.whole_->kind(); }
    unsigned long underruns() const noexcept override { return all_.whole_->underruns(); }
    std::size_t backlog() const noexcept override { return all_.whole_->backlog(); }
    int rate() const noexcept override { return all_.whole_->rate(); }
    double latency() const noexcept override { return all_.whole_->latency(); }

private:
    SideBySide& all_;
    std::size_t index_;
};

SideBySide::SideBySide(std::shared_ptr<Sink> whole, const std::vector<int>& channels)
    : whole_(std::move(whole)), channels_(channels),
      all_channels_(std::accumulate(channels.begin(), channels.end(), 0)), ring_(channels.size()) {
    for (std::size_t i = 0; i < channels.size(); ++i)
        parts_.push_back(std::make_shared<Part>(*this, i));
    const auto most = static_cast<std::size_t>(*std::max_element(channels.begin(), channels.end()));
    part_.resize(kBlock * most);
    block_.resize(kBlock * static_cast<std::size_t>(all_channels_));
}

bool SideBySide::open(const Format& format, std::size_t part) {
    if (!whole_->open({format.rate, all_channels_}))
        return false;
    if (!ring_[part])
        ring_[part] = std::make_unique<FrameRing>(
            static_cast<std::size_t>(kRingSeconds * format.rate), channels_[part]);
    return true;
}

std::size_t SideBySide::write(std::span<const float> interleaved, std::size_t part) noexcept {
    FrameRing& ring = *ring_[part];
    const std::size_t offered = interleaved.size() / static_cast<std::size_t>(channels_[part]);
    std::size_t taken = ring.write(interleaved);
    hand_on(false);
    if (taken < offered) {
        hand_on(true); // the others stay away
        taken += ring.write(interleaved.subspan(taken * static_cast<std::size_t>(channels_[part])));
    }
    return taken;
}

void SideBySide::hand_on(bool all) noexcept {
    const auto channels = static_cast<std::size_t>(all_channels_);
    for (;;) {
        if (taken_ < in_block_)
            taken_ += whole_->write(
                std::span(block_).subspan(taken_ * channels, (in_block_ - taken_) * channels));
        if (taken_ < in_block_)
            return; // full for now
        std::size_t least = kBlock, most = 0;
        for (const auto& ring : ring_) {
            const std::size_t has = ring ? ring->size() : 0;
            least = std::min(least, has);
            most = std::max(most, has);
        }
        const std::size_t frames = all ? std::min(most, kBlock) : least;
        taken_ = 0;
        in_block_ = frames;
        if (frames == 0)
            return;
        std::size_t at = 0; // channel
        for (std::size_t p = 0; p < ring_.size(); ++p) {
            const auto own = static_cast<std::size_t>(channels_[p]);
            const std::size_t has =
                ring_[p] ? ring_[p]->read(std::span(part_).first(frames * own)) : 0;
            std::fill_n(part_.begin() + static_cast<std::ptrdiff_t>(has * own),
                        (frames - has) * own, 0.0F);
            for (std::size_t f = 0; f < frames; ++f)
                std::copy_n(&part_[f * own], own, &block_[f * channels + at]);
            at += own;
        }
    }
}

} // namespace ode::sound
