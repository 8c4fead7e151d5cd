#include "source/node_rule.h"

#include "transfer/outgoing.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace ode::sound {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;
using Complex = std::complex<double>;

/// A surface at rest, as nodes are heard.
struct RestNodes {
    explicit RestNodes(const BoundaryMesh& mesh, Leaning leaning, const Air& air, double rate)
        : surface(flat(mesh)), point(points_of(surface, mesh)), area(areas_of(surface, point)),
          lean(leaning, surface, point.data(), area.data(), rate, air.speed) {
        if (lean.leans())
            lean.aim(point.data(), area.data());
    }

    static std::vector<int> flat(const BoundaryMesh& mesh) {
        std::vector<int> out;
        for (const auto& t : mesh.triangle)
            out.insert(out.end(), t.begin(), t.end());
        return out;
    }
    static AlignedVector points_of(const Surface& surface, const BoundaryMesh& mesh) {
        AlignedVector out(4 * static_cast<std::size_t>(surface.nodes()), 0.0);
        surface.collect(mesh.node.front().data(), 3, out.data());
        return out;
    }
    static AlignedVector areas_of(const Surface& surface, const AlignedVector& point) {
        AlignedVector out(point.size(), 0.0);
        surface.areas(point.data(), out.data());
        return out;
    }
    Eigen::Map<const Vec3> place(int i) const { return Eigen::Map<const Vec3>(&point[at(i)]); }
    Eigen::Map<const Vec3> normal(int i) const { return Eigen::Map<const Vec3>(&area[at(i)]); }
    Vec3 way(int i) const {
        return lean.leans() ? Vec3(Eigen::Map<const Vec3>(lean.direction() + at(i)))
                            : Vec3(Vec3::Zero());
    }
    static std::size_t at(int i) { return 4 * static_cast<std::size_t>(i); }

    Surface surface;
    AlignedVector point, area;
    Lean lean;
};

} // namespace

TransferTable node_table(const ModalSurface& given, Leaning leaning, const Air& air, double rate) {
    const RestNodes rest(given.mesh, leaning, air, rate);
    TransferTable table;
    table.centre = given.mesh.centre();
    table.radius = given.mesh.radius(table.centre);
    table.speed = air.speed;
    table.triangles = static_cast<int>(given.mesh.triangle.size());
    table.boundary_limit = rate / 2.0;

    const std::size_t modes = given.frequency.size();
    std::vector<OutgoingSum::Wave> wave;
    std::vector<Lean::Response> response;
    for (const double f : given.frequency) {
        const double k = kTau * f / air.speed;
        wave.push_back({k, OutgoingSum::order_for(k * table.radius)});
        response.push_back(rest.lean.response(f, rate));
    }
    const auto flow_of = [&](std::size_t m, int i) {
        const auto n = static_cast<std::size_t>(rest.surface.body_node()[i]);
        return rest.normal(i).dot(
            Eigen::Map<const Vec3>(given.shape.data() + 3 * (m * given.mesh.node.size() + n)));
    };
    std::vector<double> all(modes, 0.0);
    for (std::size_t m = 0; m < modes; ++m)
        for (int i = 0; i < rest.surface.real_nodes(); ++i)
            all[m] += flow_of(m, i);

    OutgoingSum sum(wave, table.radius);
    std::vector<Complex> pressure(modes), slope(modes);
    for (int i = 0; i < rest.surface.real_nodes(); ++i) {
        for (std::size_t m = 0; m < modes; ++m) {
            const double flow = flow_of(m, i);
            slope[m] = -air.density * flow;
            // A flow that leans by d radiates as if rho / (ik) of it pressed along d.
            const Complex leans =
                response[m].own * flow + response[m].common * rest.lean.share(i) * all[m];
            pressure[m] = air.density * leans / Complex(0.0, wave[m].k);
        }
        sum.add(rest.place(i) - table.centre, rest.way(i), pressure, slope);
    }
    for (std::size_t m = 0; m < modes; ++m)
        table.add(given.frequency[m], wave[m].order, sum.on_sphere(m));
    return table;
}

RigidSound rigid_sound(const BoundaryMesh& mesh, const Vec3& origin, const Air& air) {
    constexpr double kAnyRate = 48000.0; // directions don't hang on it
    const RestNodes rest(mesh, Leaning::kCarried, air, kAnyRate);
    RigidSound out;
    out.speed = air.speed;
    for (int i = 0; i < rest.surface.real_nodes(); ++i) {
        const Vec3 x = rest.place(i) - origin;
        const Vec3 a = rest.normal(i);
        RigidSound::Six flow;
        flow << a, x.cross(a); // A . (w x x) = w . (x x A)
        out.dipole += (x + air.speed * rest.lean.time() * rest.way(i)) * flow.transpose();
    }
    out.dipole /= 2.0 * kTau;
    // Of a sphere it is a^3 / 2 now.
    out.radius = std::cbrt(2.0 / 3.0 * out.dipole.leftCols<3>().trace());
    out.dipole *= air.density;
    return out;
}

} // namespace ode::sound
