#pragma once

#include "unit/model/box_mesh.h"

#include "model/elastic_model.h"
#include "model/solid.h"

#include <functional>
#include <memory>
#include <random>

namespace ode::soft {

/// A small body and its rest state, for tests that hold for every model.
struct Specimen {
    TetMesh mesh;
    std::unique_ptr<ElasticModel> model;
    NodeArray rest;
    double volume; ///< of the elements as the model integrates them [m^3]
    double size;   ///< [m]
};

inline Solid rubber() {
    Solid s;
    s.young = 1e6;
    s.poisson = 0.3;
    s.density = 1100;
    return s;
}

inline Solid viscous_rubber() {
    Solid s = rubber();
    s.phi = 40;
    s.psi = 25;
    s.beta = 1e-5;
    return s;
}

inline NodeArray node_array(const std::vector<Vec3>& x) {
    NodeArray out(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        out[i] = x[i];
    return out;
}

/// Each coordinate off by up to `amplitude`, the same at each run.
inline NodeArray disturbed(const NodeArray& x, double amplitude, unsigned seed) {
    std::mt19937 bits(seed);
    NodeArray out = x;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (int c = 0; c < 3; ++c)
            out[i][c] += amplitude * (2 * double(bits()) / double(std::mt19937::max()) - 1);
    return out;
}

/// Nodes from number `first` on that lie inside the box [0, size] moved by up to `amplitude`.
inline TetMesh with_inner_nodes_moved(TetMesh mesh, const Vec3& size, double amplitude,
                                      std::size_t first = 0) {
    const NodeArray moved = disturbed(node_array(mesh.node), amplitude, 7);
    for (std::size_t i = first; i < mesh.node.size(); ++i) {
        const auto& x = mesh.node[i];
        const bool inside = (x.array() > 1e-9 * size.array()).all() &&
                            (x.array() < (1 - 1e-9) * size.array()).all();
        if (inside)
            mesh.node[i] = moved[i];
    }
    return mesh;
}

/// No two elements alike.
inline TetMesh irregular_box(const Vec3& size, int nx, int ny, int nz) {
    const double cell = (size.array() / Eigen::Array3d(nx, ny, nz)).minCoeff();
    return with_inner_nodes_moved(box_mesh(size, nx, ny, nz), size, 0.15 * cell);
}

/// Quadratic, mid-edge nodes inside the box moved by up to `curvature`. [m]
inline TetMesh curved_box(const Vec3& size, int nx, int ny, int nz, double curvature) {
    const TetMesh linear = irregular_box(size, nx, ny, nz);
    return with_inner_nodes_moved(with_mid_nodes(linear), size, curvature, linear.node.size());
}

/// Largest entry.
inline double peak(const NodeArray& a) {
    double out = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        out = std::max(out, a[i].cwiseAbs().maxCoeff());
    return out;
}

inline double dot(const NodeArray& a, const NodeArray& b) {
    double out = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        out += a[i].dot(b[i]);
    return out;
}

inline NodeArray rotated(const NodeArray& x, const Quat& q, const Vec3& shift) {
    NodeArray out(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        out[i] = q * Vec3(x[i]) + shift;
    return out;
}

inline NodeArray force_of(const ElasticModel& model, const NodeArray& x, const NodeArray& v) {
    NodeArray force(model.node_count());
    model.add_force(x, v, force);
    return force;
}

} // namespace ode::soft
