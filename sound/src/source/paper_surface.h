#pragma once

#include "dsp/dc_block.h"
#include "source/body_source.h"

#include <vector>

namespace ode::sound {

/// Sampling "paper": P01 3.2 as written, triangle by triangle.
///
/// Pressure at every substep (eq. 2-5), windowed-sinc low-pass of pressure, centre and normal
/// (eq. 6-8) on to the audio grid, DC block of pressure (eq. 9). The window's length is counted in
/// substeps as the paper has it, the kernel's sum is taken over the substeps that came.
class PaperSurface final : public BodySource {
public:
    /// Latest that an audio sample is given off after its own time [audio samples].
    static constexpr int kLag = 9;
    int lag() const noexcept override { return kLag; }

    /// @param rate       audio rate [Hz]; eq. 7's fmax is half of it.
    /// @param impedance  z = rho c [Pa s/m].
    /// @param block      whether eq. 9 is applied.
    PaperSurface(std::span<const int> triangle, double rate, double impedance, bool block);

    bool push(const SurfaceView& view, BlockSink& out) override;
    void advance_to(double time, BlockSink& out) override;
    const Patches& patches(std::span<std::array<double, 3>> centre) override;
    bool is_silent() const noexcept override { return silent_; }

private:
    static constexpr int kOpen = 16;  ///< audio samples being gathered, a power of two
    static constexpr int kFields = 7; ///< pressure, centre, normal

    void sense(const SurfaceView& view) noexcept;
    void substep(double time, double dt, BlockSink& out);
    void give_off(std::int64_t sample, BlockSink& out);
    double* open(std::int64_t sample) noexcept;

    Surface surface_;
    double rate_;
    double impedance_;
    bool block_;
    bool silent_ = true;
    double seen_ = 0.0;       ///< [s]
    double substep_ = 0.0;    ///< [s]
    double rest_begin_ = 0.0; ///< [s]
    bool resting_ = false;
    std::int64_t next_ = 0;      ///< audio sample that is given off next
    std::vector<double> now_;    ///< kFields a triangle
    std::vector<double> area_;   ///< [m^2]
    std::vector<double> sum_;    ///< kOpen times kFields a triangle
    std::vector<double> weight_; ///< of each open sample
    std::vector<DcBlock> dc_;
    std::vector<double> facet_;
    Patches patches_;
};

} // namespace ode::sound
