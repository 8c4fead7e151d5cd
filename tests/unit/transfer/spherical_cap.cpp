#include "unit/transfer/spherical_cap.h"

#include <Eigen/LU>

#include <cmath>
#include <numbers>
#include <vector>

namespace ode::sound::test {
namespace {

using Complex = SphericalCap::Complex;

/// Legendre functions P_n^m(x), n from m, whose squares integrate to 1 over -1 .. 1.
void legendre(double x, int m, std::vector<double>& out) {
    double first = std::sqrt(0.5 * (2.0 * m + 1.0));
    for (int i = 1; i <= m; ++i)
        first *= std::sqrt((1.0 - x * x) * (2.0 * i - 1.0) / (2.0 * i));
    out[0] = first;
    double before = 0.0, ratio = 0.0;
    for (std::size_t i = 1; i < out.size(); ++i) {
        const double n = m + static_cast<double>(i);
        const double a = std::sqrt((4.0 * n * n - 1.0) / (n * n - m * m));
        out[i] = a * (x * out[i - 1] - ratio * before);
        before = out[i - 1];
        ratio = 1.0 / a;
    }
}

/// h_n'/h_n (of the second kind) and j_n'/j_n at x.
struct Slopes {
    std::vector<Complex> h;
    std::vector<double> j;

    Slopes(double x, int count) {
        Complex ratio = Complex(1.0 / x, 1.0); // h_1 / h_0 = 1/x + i
        for (int n = 0; n < count; ++n) {      // f' = n/x f_n - f_{n+1}
            h.push_back(static_cast<double>(n) / x - ratio);
            ratio = (2.0 * n + 3.0) / x - 1.0 / ratio;
        }
        j.resize(static_cast<std::size_t>(count));
        double over = 0.0; // j_{n+1} / j_n, downwards
        for (int n = count + 40; n >= 0; --n) {
            over = 1.0 / ((2.0 * n + 3.0) / x - over);
            if (n < count)
                j[static_cast<std::size_t>(n)] = n / x - over;
        }
    }
};

constexpr int kBasis = 10, kDegrees = 2000, kPoints = 6000;

} // namespace

SphericalCap::SphericalCap(double k, int m, const std::function<double(double)>& slope)
    : k_(k), m_(m) {
    // Projections of the basis and of the cap's slope on P_n: midpoints in u, theta = (1 - u^2) pi
    // / 2, in which everything is smooth.
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(kDegrees, kBasis);
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(kBasis);
    std::vector<double> p(kDegrees);
    for (int i = 0; i < kPoints; ++i) {
        const double u = (i + 0.5) / kPoints;
        const double theta = 0.5 * std::numbers::pi * (1.0 - u * u);
        const double x = std::cos(theta), weight = std::numbers::pi * u / kPoints * std::sin(theta);
        legendre(x, m, p);
        double f = weight * std::sqrt(x) * std::pow(std::sin(theta), m);
        for (int b = 0; b < kBasis; ++b, f *= 2.0 * x - 1.0) {
            wanted[b] += f * slope(theta);
            basis.col(b) += f * Eigen::Map<Eigen::VectorXd>(p.data(), kDegrees);
        }
    }
    const Slopes ratio(k, kDegrees + m);
    Eigen::VectorXcd inverse(kDegrees); // 1 / Z
    for (int i = 0; i < kDegrees; ++i) {
        const auto n = static_cast<std::size_t>(i + m);
        inverse[i] = k * ratio.h[n] * ratio.j[n] / (ratio.j[n] - ratio.h[n]);
    }
    const Eigen::MatrixXcd system = basis.transpose() * inverse.asDiagonal() * basis;
    const Eigen::VectorXcd jump = basis * system.fullPivLu().solve(wanted.cast<Complex>());
    // What is heard beyond some radii: degrees not far above k.
    Complex h = std::polar(1.0, -k) * Complex(0.0, 1.0 / k); // h_n(k), upwards from h_0
    const int heard = static_cast<int>(k) + 24;
    for (int n = 0; n < heard; ++n) {
        const auto at = static_cast<std::size_t>(n);
        if (n >= m)
            outside_.push_back(jump[n - m] * inverse[n - m] / (k * ratio.h[at] * h));
        h *= static_cast<double>(n) / k - ratio.h[at];
    }
}

Complex SphericalCap::pressure(const Eigen::Vector3d& x) const {
    const double r = x.norm();
    std::vector<double> p(outside_.size());
    legendre(x.z() / r, m_, p);
    const Slopes ratio(k_ * r, m_ + static_cast<int>(p.size()));
    Complex h = std::polar(1.0, -k_ * r) * Complex(0.0, 1.0 / (k_ * r));
    Complex sum = 0.0;
    for (int n = 0; n < m_ + static_cast<int>(p.size()); ++n) {
        if (n >= m_) {
            const auto i = static_cast<std::size_t>(n - m_);
            sum += outside_[i] * h * p[i];
        }
        h *= n / (k_ * r) - ratio.h[static_cast<std::size_t>(n)];
    }
    return sum * std::cos(m_ * std::atan2(x.y(), x.x()));
}

} // namespace ode::sound::test
