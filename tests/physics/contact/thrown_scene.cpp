#include "physics/contact/thrown_scene.h"

#include "integrate/central_difference.h"
#include "mesh/generate.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ode::soft {
namespace {

Solid solid_of(double young, double density) {
    Solid s;
    s.young = young;
    s.poisson = 0.3;
    s.density = density;
    return s;
}

// A box of half sides 1, 5/6, 2/3, as planes, corners and faces of a convex and as a trimesh.
constexpr double kHalf[] = {1, 5.0 / 6, 2.0 / 3};
constexpr unsigned kPolygon[] = {4, 1, 3, 7, 5, 4, 0, 4, 6, 2, 4, 2, 6, 7, 3,
                                 4, 0, 1, 5, 4, 4, 4, 5, 7, 6, 4, 0, 2, 3, 1};
constexpr dTriIndex kTriangle[] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};

/// ODE keeps pointers to these.
struct BoxTables {
    std::array<dReal, 24> corner;
    std::array<dReal, 24> plane;
};

BoxTables tables_of(double size) {
    BoxTables t{};
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            t.corner[3 * i + axis] = ((i >> axis) & 1U ? 1 : -1) * kHalf[axis] * size;
    for (std::size_t i = 0; i < 6; ++i) {
        t.plane[4 * i + i / 2] = i % 2 ? -1 : 1;
        t.plane[4 * i + 3] = kHalf[i / 2] * size;
    }
    return t;
}

/// Points by which the shape is watched, with radii.
std::vector<RigidSample> watched(const Throw& what) {
    RigidShape shape;
    shape.size = what.size * Vec3(kHalf[0], kHalf[1], kHalf[2]);
    switch (what.kind) {
    case Thrown::sphere:
        shape.kind = ShapeKind::sphere;
        break;
    case Thrown::capsule:
        shape.kind = ShapeKind::capsule;
        shape.size = what.size * Vec3(0.4, 0, 0.6);
        break;
    case Thrown::cylinder:
        shape.kind = ShapeKind::cylinder;
        shape.size = what.size * Vec3(0.6, 0, 0.8);
        break;
    default:
        shape.kind = ShapeKind::box;
    }
    return sample_shape(shape, what.size / 3);
}

} // namespace

const char* name_of(Thrown kind) noexcept {
    constexpr const char* kName[] = {"sphere", "box", "capsule", "cylinder", "convex", "trimesh"};
    return kName[static_cast<int>(kind)];
}

ThrownScene::ThrownScene(TetMesh mesh, double young, double density, double dt)
    : dt_(dt), mesh_(std::move(mesh)), surface_(extract_surface(mesh_)),
      model_(mesh_, solid_of(young, density)), nodes_(mesh_, surface_, model_.mass()) {
    const std::size_t n = mesh_.node.size();
    state_ = {NodeArray(n), NodeArray(n)};
    force_ = NodeArray(n);
    double top = -HUGE_VAL;
    for (const Vec3& x : mesh_.node)
        top = std::fmax(top, x.z());
    for (Vec3& x : mesh_.node)
        x.z() -= top;
    for (const double m : model_.mass())
        inverse_mass_.push_back(1 / m);
    dInitODE2(0);
    world_ = dWorldCreate();
}

ThrownScene::~ThrownScene() {
    dWorldDestroy(world_);
    dCloseODE();
}

double ThrownScene::soft_mass() const {
    double sum = 0;
    for (const double m : model_.mass())
        sum += m;
    return sum;
}

dGeomID ThrownScene::make_geom(const Throw& what, dMass& mass) {
    const double s = what.size;
    dMassSetBoxTotal(&mass, what.mass, 2 * kHalf[0] * s, 2 * kHalf[1] * s, 2 * kHalf[2] * s);
    switch (what.kind) {
    case Thrown::sphere:
        dMassSetSphereTotal(&mass, what.mass, s);
        return dCreateSphere(nullptr, s);
    case Thrown::capsule:
        dMassSetCapsuleTotal(&mass, what.mass, 3, 0.4 * s, 1.2 * s);
        return dCreateCapsule(nullptr, 0.4 * s, 1.2 * s);
    case Thrown::cylinder:
        dMassSetCylinderTotal(&mass, what.mass, 3, 0.6 * s, 1.6 * s);
        return dCreateCylinder(nullptr, 0.6 * s, 1.6 * s);
    case Thrown::box:
        return dCreateBox(nullptr, 2 * kHalf[0] * s, 2 * kHalf[1] * s, 2 * kHalf[2] * s);
    default:
        return nullptr;
    }
}

Outcome ThrownScene::run(const Throw& what) {
    const std::size_t nodes = mesh_.node.size();
    for (std::size_t i = 0; i < nodes; ++i) {
        state_.position[i] = mesh_.node[i];
        state_.velocity[i] = Vec3::Zero();
    }
    const dBodyID body = dBodyCreate(world_);
    dMass mass;
    const BoxTables tables = tables_of(what.size);
    dTriMeshDataID triangles = nullptr;
    dGeomID geom = make_geom(what, mass);
    if (what.kind == Thrown::convex) {
        geom = dCreateConvex(nullptr, tables.plane.data(), 6, tables.corner.data(), 8, kPolygon);
    } else if (what.kind == Thrown::trimesh) {
        triangles = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildDouble(triangles, tables.corner.data(), 3 * sizeof(dReal), 8,
                                    kTriangle, 36, 3 * sizeof(dTriIndex));
        geom = dCreateTriMesh(nullptr, triangles, nullptr, nullptr, nullptr);
    }
    dGeomSetBody(geom, body);
    dBodySetMass(body, &mass);
    const dQuaternion q{what.turn.w(), what.turn.x(), what.turn.y(), what.turn.z()};
    dBodySetPosition(body, what.at.x(), what.at.y(), what.at.z());
    dBodySetQuaternion(body, q);
    dBodySetLinearVel(body, what.velocity.x(), what.velocity.y(), what.velocity.z());
    dBodySetAngularVel(body, what.spin.x(), what.spin.y(), what.spin.z());
    dBodySetMaxAngularSpeed(body, HUGE_VAL);

    RigidShadow shadow(body, what.seconds, dt_);
    NodeContact contact(nodes_, geom);
    ContactLaw law;
    law.friction = what.friction;
    law.damping = what.damping;
    contact.begin_step(*capture_shape(geom), law, inverse_mass_, dt_);
    // Leapfrog keeps the sum of potential energy and of v- v+ / 2 at the position between.
    const auto rigid_energy = [&] {
        const RigidMotion& m = shadow.motion();
        const Vec3 w = m.pose.rotation.transpose() * m.spin;
        const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> inertia(mass.I);
        return mass.mass * m.velocity.squaredNorm() / 2 + w.dot(inertia.leftCols<3>() * w) / 2;
    };
    const auto momentum = [&] {
        Vec3 sum = mass.mass * shadow.motion().velocity;
        for (std::size_t i = 0; i < nodes; ++i)
            sum += state_.velocity[i] / inverse_mass_[i];
        return sum;
    };
    const double start = rigid_energy();
    const Vec3 momentum_before = momentum();
    CentralDifference integrator;
    NodeArray velocity_before(nodes);
    Outcome out{};
    double energy = start;
    const auto samples = watched(what);
    double broad = 0;
    for (const Vec3& x : mesh_.node)
        broad = std::fmax(broad, x.x());
    for (double t = 0; t < what.seconds; t += dt_) {
        force_.set_zero();
        integrator.evaluate(model_, state_, force_);
        const double elastic = model_.energy(state_.position);
        const double rigid_before = rigid_energy();
        out.bearing += static_cast<double>(
            contact.add_force(state_.position, state_.velocity, shadow, dt_, force_).bearing);
        std::copy_n(state_.velocity.data(), NodeArray::kStride * nodes, velocity_before.data());
        shadow.advance(dt_);
        integrator.step(model_, {inverse_mass_, 0}, dt_, state_, force_);
        energy = elastic + (rigid_before + rigid_energy()) / 2;
        for (std::size_t i = 0; i < nodes; ++i)
            energy += velocity_before[i].dot(state_.velocity[i]) / inverse_mass_[i] / 2;
        out.most = std::fmax(out.most, energy / start - 1);
        for (const RigidSample& s : samples) {
            const Vec3 p = shadow.motion().pose.to_world(s.center);
            if (p.head<2>().cwiseAbs().maxCoeff() < 0.9 * broad)
                out.depth = std::fmax(out.depth, face_height(p) - (p.z() - s.radius));
        }
    }
    out.energy = energy / start - 1;
    out.velocity = shadow.motion().velocity;
    out.momentum = (momentum() - momentum_before).norm() / momentum_before.norm();
    dGeomDestroy(geom);
    if (triangles)
        dGeomTriMeshDataDestroy(triangles);
    dBodyDestroy(body);
    return out;
}

double ThrownScene::face_height(const Vec3& p) const {
    double height = -HUGE_VAL;
    for (const auto& t : surface_.triangle) {
        const Vec3 a = state_.position[static_cast<std::size_t>(t[0])];
        const Vec3 b = state_.position[static_cast<std::size_t>(t[1])];
        const Vec3 c = state_.position[static_cast<std::size_t>(t[2])];
        const Vec3 n = (b - a).cross(c - a);
        if (n.z() <= 0)
            continue;
        const auto side = [&](const Vec3& u, const Vec3& v) {
            return (v.x() - u.x()) * (p.y() - u.y()) - (v.y() - u.y()) * (p.x() - u.x());
        };
        if (side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0)
            height = std::fmax(height,
                               a.z() - (n.x() * (p.x() - a.x()) + n.y() * (p.y() - a.y())) / n.z());
    }
    return height;
}

} // namespace ode::soft
