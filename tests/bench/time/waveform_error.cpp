#include "bench/time/waveform_error.h"

#include <Eigen/Dense>

#include <cmath>
#include <numbers>

namespace ode::soft {
namespace {

/// exp(-d t) (a cos w t + b sin w t), fitted to samples of constant spacing.
struct Fit {
    double w, d;
};

/// Amplitudes for given w and d by least squares. @return the squared error.
double error_of(const Eigen::VectorXd& y, double spacing, const Fit& fit) {
    Eigen::MatrixX2d basis(y.size(), 2);
    for (Eigen::Index n = 0; n < y.size(); ++n) {
        const double t = spacing * static_cast<double>(n + 1), fall = std::exp(-fit.d * t);
        basis.row(n) << fall * std::cos(fit.w * t), fall * std::sin(fit.w * t);
    }
    const Eigen::Vector2d c = basis.colPivHouseholderQr().solve(y);
    return (y - basis * c).squaredNorm();
}

/// The best of a grid of frequencies an octave and a half to both sides, then ever finer steps in
/// frequency and decay.
Fit fit_ringing(const Eigen::VectorXd& y, double spacing, const Fit& start) {
    Fit best = start;
    double least = error_of(y, spacing, best);
    const auto try_one = [&](const Fit& fit) {
        const double e = error_of(y, spacing, fit);
        if (!(e < least))
            return false;
        least = e;
        best = fit;
        return true;
    };
    const double whole = spacing * static_cast<double>(y.size());
    for (double w = start.w / 3; w < 3 * start.w; w += 0.5 / whole)
        try_one({w, start.d});
    for (double dw = 0.25 / whole, dd = 0.25 / whole; dw > 1e-7 * start.w;) {
        const bool moved = try_one({best.w + dw, best.d}) || try_one({best.w - dw, best.d}) ||
                           try_one({best.w, best.d + dd}) || try_one({best.w, best.d - dd});
        if (!moved)
            dw /= 2, dd /= 2;
    }
    return best;
}

} // namespace

double waveform_error(const Waveform& waveform, const Waveform& reference) {
    double off = 0, all = 0;
    for (std::size_t n = 0; n < reference.size(); ++n)
        for (std::size_t i = 0; i < reference[n].size(); ++i) {
            off += (waveform[n][i] - reference[n][i]).squaredNorm();
            all += reference[n][i].squaredNorm();
        }
    return std::sqrt(off / all);
}

RingingError ringing_error(const TimeScene& scene, const Waveform& waveform) {
    const auto modes = static_cast<Eigen::Index>(scene.amplitude.size());
    const auto nodes = static_cast<Eigen::Index>(scene.mesh.node.size());
    Eigen::MatrixXd shape(3 * nodes, modes);
    for (Eigen::Index k = 0; k < modes; ++k)
        for (Eigen::Index i = 0; i < nodes; ++i)
            shape.block<3, 1>(3 * i, k) =
                scene.modes.shape_at(static_cast<std::size_t>(k), static_cast<std::size_t>(i));
    const Eigen::MatrixXd gram = shape.transpose() * shape;
    Eigen::MatrixXd share(modes, static_cast<Eigen::Index>(waveform.size()));
    for (std::size_t n = 0; n < waveform.size(); ++n) {
        const Eigen::Map<const Eigen::VectorXd> v(waveform[n][0].data(), 3 * nodes);
        share.col(static_cast<Eigen::Index>(n)) = gram.ldlt().solve(shape.transpose() * v);
    }
    RingingError out;
    for (Eigen::Index k = 0; k < modes; ++k) {
        const auto mode = static_cast<std::size_t>(k);
        const double d = scene.decay[mode], w0 = 2 * std::numbers::pi * scene.modes.frequency[mode];
        const Fit truth{std::sqrt(w0 * w0 - d * d), d};
        const Fit found = fit_ringing(share.row(k).transpose(),
                                      scene.duration / static_cast<double>(waveform.size()), truth);
        out.cents = std::max(out.cents, std::abs(1200 * std::log2(found.w / truth.w)));
        // A mode that an element puts higher dies faster by beta w^2 / 2: that is pitch, not decay.
        const double expected = d * std::pow(found.w / truth.w, 2);
        out.decay = std::max(out.decay, std::abs(found.d / expected - 1));
    }
    return out;
}

} // namespace ode::soft
