#include "transfer/helmholtz.h"

#include "transfer/wave.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <numbers>

namespace ode::sound {
namespace {

constexpr double kFourPi = 4.0 * std::numbers::pi;

using Row = Eigen::ArrayXd;

} // namespace

struct HelmholtzProblem::Points {
    Row x, y, z, nx, ny, nz, weight;

    explicit Points(std::span<const Facet> facet) {
        const auto n = 3 * static_cast<Eigen::Index>(facet.size());
        for (Row* row : {&x, &y, &z, &nx, &ny, &nz, &weight})
            row->resize(n);
        Eigen::Index i = 0;
        for (const Facet& f : facet)
            for (const Vec3& bary : three_points()) {
                const Vec3 at = f.at(bary);
                x[i] = at[0], y[i] = at[1], z[i] = at[2];
                nx[i] = f.normal[0], ny[i] = f.normal[1], nz[i] = f.normal[2];
                weight[i++] = f.area / 3.0;
            }
    }
};

namespace {

/// G and dG/dn_y of one point against all, times 4 pi and the weights; 1/R itself is left out where
/// R = 0.
struct Kernel {
    Row r, inverse, cosine, sine, real, imag, slope_real, slope_imag;

    explicit Kernel(Eigen::Index n) {
        for (Row* row : {&r, &inverse, &cosine, &sine, &real, &imag, &slope_real, &slope_imag})
            row->resize(n);
    }

    template <class Points>
    void fill(const Points& p, const Vec3& at, double k) {
        const auto dx = at[0] - p.x, dy = at[1] - p.y, dz = at[2] - p.z;
        r = (dx * dx + dy * dy + dz * dz).sqrt();
        inverse = (r > 0.0).select(1.0 / (r + (r == 0.0).template cast<double>()), 0.0);
        Row& angle = slope_real; // scratch
        angle = k * r;
        turn(angle.data(), static_cast<int>(angle.size()), cosine.data(), sine.data());
        // e^{-ikR} / R, whose regular part at R = 0 is -ik.
        real = p.weight * cosine * inverse;
        imag = -p.weight * (r > 0.0).select(sine * inverse, k);
        // d/dn_y = (1 + ikR) e^{-ikR} / R^2 (x - y).n / R.
        const auto projection = (dx * p.nx + dy * p.ny + dz * p.nz) * inverse * inverse;
        slope_real = projection * (real - k * r * imag);
        slope_imag = projection * (imag + k * r * real);
    }
};

/// Kernels seen from the three hats of a triangle. A hat is 2/3 at its own point and 1/6 at the
/// other two: half the value there and a sixth of the sum.
class FacetRows {
public:
    explicit FacetRows(Eigen::Index n) {
        for (auto& part : row_)
            for (Row& row : part)
                row.resize(n);
    }
    void clear() {
        for (auto& part : row_)
            for (Row& row : part)
                row.setZero();
    }
    void add(const Kernel& kernel, int point) {
        const Row* from[4] = {&kernel.real, &kernel.imag, &kernel.slope_real, &kernel.slope_imag};
        for (std::size_t part = 0; part < 4; ++part)
            for (int i = 0; i < 3; ++i)
                row_[part][static_cast<std::size_t>(i)] +=
                    (i == point ? 2.0 / 3.0 : 1.0 / 6.0) * *from[part];
    }
    /// Of hat i with the three hats of the triangle whose points begin at r.
    void local(int i, Eigen::Index r, std::complex<double>* single,
               std::complex<double>* twice) const {
        double value[4][3];
        for (std::size_t part = 0; part < 4; ++part) {
            const double* v = row_[part][static_cast<std::size_t>(i)].data() + r;
            const double sum = (v[0] + v[1] + v[2]) * (1.0 / 6.0);
            for (int j = 0; j < 3; ++j)
                value[part][j] = sum + 0.5 * v[j];
        }
        for (int j = 0; j < 3; ++j) {
            single[j] = {value[0][j], value[1][j]};
            twice[j] = {value[2][j], value[3][j]};
        }
    }

private:
    std::array<std::array<Row, 3>, 4> row_;
};

} // namespace

HelmholtzProblem::HelmholtzProblem(BoundaryMesh mesh)
    : mesh_(std::move(mesh)), facet_(mesh_.facets()), near_(near_pairs(facet_)),
      reach_(mesh_.radius(mesh_.centre())) {}

HelmholtzProblem::Matrix HelmholtzProblem::solve(double k, const Matrix& slope) const {
    const Points points(facet_);
    const auto nodes = static_cast<Eigen::Index>(mesh_.node.size());
    // Far below the first resonance the combination's only task is to keep the jump over thin
    // walls: a real factor then leaves static problems real.
    const Complex a =
        k * reach_ > 1e-3 ? Complex(0.0, -1.0 / std::max(k, 1.0 / reach_)) : Complex(reach_, 0.0);
    Matrix left = Matrix::Zero(nodes, nodes); // transposed: a row of the system lies together
    Matrix right = Matrix::Zero(nodes, slope.cols());
    Kernel kernel(points.x.size());
    FacetRows rows(points.x.size());
    for (std::size_t t = 0; t < facet_.size(); ++t) {
        const Facet& f = facet_[t];
        const auto& node = mesh_.triangle[t];
        rows.clear();
        for (int p = 0; p < 3; ++p) {
            kernel.fill(points, f.at(three_points()[static_cast<std::size_t>(p)]), k);
            rows.add(kernel, p);
        }
        const double weight = f.area / 3.0 / kFourPi;
        const Vec3 curl[3] = {weight * f.normal.cross(f.slope[0]),
                              weight * f.normal.cross(f.slope[1]),
                              weight * f.normal.cross(f.slope[2])};
        const auto q = static_cast<Eigen::Index>(3 * t);
        auto pair = near_[t].begin();
        for (std::size_t u = 0; u < facet_.size(); ++u) {
            const Facet& g = facet_[u];
            const auto& other = mesh_.triangle[u];
            const auto r = static_cast<Eigen::Index>(3 * u);
            Complex single[3][3], twice[3][3];
            Complex all = 0.0;
            for (int i = 0; i < 3; ++i) {
                rows.local(i, r, single[i], twice[i]);
                all += single[i][0] + single[i][1] + single[i][2];
            }
            if (pair != near_[t].end() && pair->other == static_cast<int>(u)) {
                const double scale = 3.0 / f.area;
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j) {
                        single[i][j] += scale * pair->single(i, j);
                        twice[i][j] += scale * pair->twice(i, j);
                    }
                all += scale * pair->single.sum();
                ++pair;
            }
            const double facing = weight * k * k * f.normal.dot(g.normal);
            for (int j = 0; j < 3; ++j) {
                const Vec3 other_curl = g.normal.cross(g.slope[j]);
                const auto to = other[static_cast<std::size_t>(j)];
                for (int i = 0; i < 3; ++i)
                    left(to, node[static_cast<std::size_t>(i)]) -=
                        weight * twice[i][j] +
                        a * (facing * single[i][j] - curl[i].dot(other_curl) * all);
            }
            for (Eigen::Index c = 0; c < slope.cols(); ++c)
                for (int j = 0; j < 3; ++j) {
                    Complex back = 0.0; // K' is K with the points' parts exchanged
                    for (int i = 0; i < 3; ++i) {
                        right(node[static_cast<std::size_t>(i)], c) -=
                            weight * single[i][j] * slope(r + j, c);
                        back += twice[i][j] * slope(q + i, c);
                    }
                    right(other[static_cast<std::size_t>(j)], c) -= weight * a * back;
                }
        }
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const double m = 0.5 * f.area * (i == j ? 1.0 / 6.0 : 1.0 / 12.0);
                left(node[static_cast<std::size_t>(j)], node[static_cast<std::size_t>(i)]) += m;
                for (Eigen::Index c = 0; c < slope.cols(); ++c)
                    right(node[static_cast<std::size_t>(i)], c) -= a * m * slope(q + j, c);
            }
    }
    left.transposeInPlace();
    return left.partialPivLu().solve(right);
}

HelmholtzProblem::Complex HelmholtzProblem::at(const Vec3& x, double k,
                                               const Eigen::VectorXcd& slope,
                                               const Eigen::VectorXcd& pressure) const {
    const Points points(facet_);
    Kernel kernel(points.x.size());
    kernel.fill(points, x, k);
    Complex sum = 0.0;
    for (std::size_t t = 0; t < facet_.size(); ++t)
        for (std::size_t o = 0; o < 3; ++o) {
            const auto at = static_cast<Eigen::Index>(3 * t + o);
            Complex p = 0.0, q = 0.0;
            for (int j = 0; j < 3; ++j) {
                const double hat = three_points()[o][j];
                p += hat * pressure[mesh_.triangle[t][static_cast<std::size_t>(j)]];
                q += hat * slope[static_cast<Eigen::Index>(3 * t) + j];
            }
            sum += p * Complex(kernel.slope_real[at], kernel.slope_imag[at]) -
                   q * Complex(kernel.real[at], kernel.imag[at]);
        }
    return sum / kFourPi;
}

} // namespace ode::sound
