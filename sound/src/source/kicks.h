#pragma once

#include "dsp/storage.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace ode::sound {

/// What oscillators are given between samples, carried to the next sample: exact whatever the
/// times, so that nothing a force holds above half the rate is folded down.
class Kicks {
public:
    /// q'' + 2 decay q' + omega^2 q = 0; with omega = 0 q' = -decay q.
    struct Column {
        double omega; ///< undamped [rad/s]
        double decay; ///< [1/s]
    };

    /// @param column  padded up to whole kModeLanes in what comes out.  @param rate  [Hz].
    Kicks(std::vector<Column> column, double rate);

    /// q and q' jump at `time` [s], which is not before that of the last call, or counts as that.
    /// @param q  null: it doesn't. Allocates for more samples in store than ever before.
    void add(double time, const double* q, const double* v);
    /// No more will come up to `time`.
    void close(double time);

    /// The first sample in store, INT64_MAX if there is none, and by how much the columns jump
    /// there.
    std::int64_t next() const noexcept {
        return first_ < sample_.size() ? sample_[first_] : std::numeric_limits<std::int64_t>::max();
    }
    const float* q() const noexcept { return row_.data() + 2 * first_ * stride_; }
    const float* v() const noexcept { return q() + stride_; }
    std::size_t columns() const noexcept { return stride_; }
    void pop() noexcept;
    bool is_empty() const noexcept { return !open_ && first_ == sample_.size(); }

private:
    void evolve(double time) noexcept;
    void finish();

    std::vector<Column> column_;
    double rate_;
    std::size_t stride_;
    std::vector<double> damped_;                                    ///< [rad/s]
    std::vector<double> angle_, cosine_, sine_;                     ///< scratch
    std::vector<double> q_from_q_, q_from_v_, v_from_q_, v_from_v_; ///< over lapse_
    double lapse_ = -1.0;
    std::vector<double> q_, v_; ///< at at_, of the sample that is open
    double at_ = 0.0;           ///< [s]
    bool open_ = false;
    std::int64_t collecting_ = 0; ///< for this sample
    std::vector<std::int64_t> sample_;
    AlignedFloats row_; ///< q, then v, of each
    std::size_t first_ = 0;
};

} // namespace ode::sound
