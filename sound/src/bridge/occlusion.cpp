#include "bridge/occlusion.h"

#include <ode_softbody/softbody.h>

#include <algorithm>
#include <array>
#include <limits>

namespace ode::sound {
namespace {

bool overlaps(const dReal* box, const dReal* low, const dReal* high) {
    for (int k = 0; k < 3; ++k)
        if (box[2 * k] > high[k] || box[2 * k + 1] < low[k])
            return false;
    return true;
}

/// A half space that the whole box lies outside of hides nothing: the floor.
bool is_clear_of(dGeomID plane, const dReal* low, const dReal* high) {
    dVector4 p;
    dGeomPlaneGetParams(plane, p);
    double least = -p[3];
    for (int k = 0; k < 3; ++k)
        least += p[k] * (p[k] > 0.0 ? low[k] : high[k]);
    return least > 0.0;
}

dGeomID geom_of(const void* body) {
    return dSoftBodyGetGeom(static_cast<dSoftBodyID>(const_cast<void*>(body)));
}

/// The middle of a box and half way to each corner, as shares of its sides.
constexpr int kBoxPoints = 9;
double box_share(int point, int axis) {
    return point == kBoxPoints - 1 ? 0.5 : (point >> axis) % 2 == 0 ? 0.25 : 0.75;
}

struct Search {
    dGeomID ray;
    const void* target;
    unsigned long hides;
    bool hit;
};

} // namespace

bool Occlusion::any_near(dSpaceID space, const Target& target, const dReal* low,
                         const dReal* high) const {
    const int count = dSpaceGetNumGeoms(space);
    for (int i = 0; i < count; ++i) {
        const dGeomID geom = dSpaceGetGeom(space, i);
        if (!dGeomIsEnabled(geom))
            continue;
        if (dGeomIsSpace(geom)) {
            if (any_near(reinterpret_cast<dSpaceID>(geom), target, low, high))
                return true;
            continue;
        }
        if (!(dGeomGetCategoryBits(geom) & hides_) || dGeomGetClass(geom) == dRayClass)
            continue;
        dReal box[6];
        dGeomGetAABB(geom, box);
        if (overlaps(box, low, high) && !target.owns(geom) &&
            (dGeomGetClass(geom) != dPlaneClass || !is_clear_of(geom, low, high)))
            return true;
    }
    return false;
}

void Occlusion::meet(void* data, dGeomID a, dGeomID b) {
    auto& search = *static_cast<Search*>(data);
    if (search.hit)
        return;
    if (dGeomIsSpace(a) || dGeomIsSpace(b)) {
        dSpaceCollide2(a, b, data, &meet);
        return;
    }
    const dGeomID other = a == search.ray ? b : a;
    if (static_cast<const Target*>(search.target)->owns(other) ||
        !(dGeomGetCategoryBits(other) & search.hides))
        return;
    dContactGeom contact;
    search.hit = dCollide(search.ray, other, 1, &contact, sizeof contact) > 0;
}

int Occlusion::Target::points(std::span<std::array<double, 3>> out) const {
    if (rigid) {
        const Eigen::Map<const Vec3> centre(dBodyGetPosition(rigid->body));
        const dReal* q = dBodyGetQuaternion(rigid->body);
        const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
        const Vec3 &low = rigid->model->low, &high = rigid->model->high;
        for (int p = 0; p < kBoxPoints; ++p) {
            Vec3 x;
            for (int k = 0; k < 3; ++k)
                x[k] = low[k] + box_share(p, k) * (high[k] - low[k]);
            const Vec3 world = centre + turn * x;
            std::copy_n(world.data(), 3, out[static_cast<std::size_t>(p)].begin());
        }
        return kBoxPoints;
    }
    if (!source->is_silent())
        return source->patches(out).count;
    // Of a body whose nodes nobody looks at.
    dReal box[6];
    dGeomGetAABB(geom, box);
    for (int p = 0; p < kBoxPoints; ++p)
        for (int k = 0; k < 3; ++k)
            out[static_cast<std::size_t>(p)][static_cast<std::size_t>(k)] =
                box[2 * k] + box_share(p, k) * (box[2 * k + 1] - box[2 * k]);
    return kBoxPoints;
}

void Occlusion::set(dSpaceID space, unsigned long hides) {
    if (ray_ && !space) {
        dGeomDestroy(ray_);
        ray_ = nullptr;
    }
    if (space && !ray_)
        ray_ = dCreateRay(nullptr, 1.0);
    space_ = space;
    hides_ = hides;
}

bool Occlusion::may_hide(const Target& target, const dReal* low, const dReal* high) const {
    return any_near(space_, target, low, high) ||
           std::any_of(soft_.begin(), soft_.end(), [&](dGeomID geom) {
               if (target.owns(geom) || !(dGeomGetCategoryBits(geom) & hides_))
                   return false;
               dReal box[6];
               dGeomGetAABB(geom, box);
               return overlaps(box, low, high);
           });
}

bool Occlusion::is_hidden(const Target& target, const Vec3& from, const Vec3& to) {
    // Off the surface, which may lie on a floor, and short of the ear, which may lie on a head.
    constexpr double kMargin = 5e-3; // [m]
    const Vec3 way = to - from;
    const double distance = way.norm();
    if (distance < 4.0 * kMargin)
        return false;
    const Vec3 unit = way / distance;
    const Vec3 start = from + kMargin * unit;
    dGeomRaySet(ray_, start[0], start[1], start[2], unit[0], unit[1], unit[2]);
    dGeomRaySetLength(ray_, distance - 2.0 * kMargin);
    Search search{ray_, &target, hides_, false};
    dSpaceCollide2(ray_, reinterpret_cast<dGeomID>(space_), &search, &meet);
    ++rays_;
    return search.hit;
}

void Occlusion::list(Scene& scene, const RigidBodies& rigid) {
    target_.clear();
    soft_.clear();
    scene.for_each_body([&](const void* body, BodySource& source) {
        target_.push_back({&source, &source, geom_of(body), nullptr});
        soft_.push_back(target_.back().geom);
    });
    rigid.for_each([&](const RigidBody& own) {
        const StruckVoice* voice = scene.find_struck(&own, own.place_in_scene);
        if (voice && !voice->is_silent())
            target_.push_back({voice, nullptr, nullptr, &own});
    });
}

void Occlusion::look(Listener& listener, const Target& target) {
    std::array<std::array<double, 3>, Patches::kMost> centre{};
    const int count = target.points(centre);
    const auto ears = listener.places();
    dReal low[3], high[3];
    for (int k = 0; k < 3; ++k) {
        low[k] = std::min(ears[0][k], ears[1][k]);
        high[k] = std::max(ears[0][k], ears[1][k]);
        for (int p = 0; p < count; ++p) {
            const double x = centre[static_cast<std::size_t>(p)][static_cast<std::size_t>(k)];
            low[k] = std::min(low[k], x);
            high[k] = std::max(high[k], x);
        }
    }
    const bool maybe = may_hide(target, low, high);
    credit_ -= kLook;
    if (!maybe && !listener.has_shade(target.key))
        return;
    Shade& shade = listener.shade(target.key);
    shade.set_patches(count);
    for (int e = 0; e < listener.ears(); ++e)
        for (int p = 0; p < count; ++p) {
            const auto& c = centre[static_cast<std::size_t>(p)];
            const bool hidden =
                maybe && is_hidden(target, {c[0], c[1], c[2]}, ears[static_cast<std::size_t>(e)]);
            shade.see(e, p, !hidden);
            credit_ -= maybe ? 1.0 : 0.0;
        }
}

void Occlusion::update(Scene& scene, const RigidBodies& rigid, double duration) {
    if (!space_)
        return;
    list(scene, rigid);
    // Of bodies and listeners: each takes its turn.
    const unsigned long pairs = target_.size() * scene.listeners();
    if (pairs == 0)
        return;
    const double sweep = 2.0 * Patches::kMost * static_cast<double>(pairs);
    credit_ = std::min(credit_ + kRaysPerSecond * duration, sweep);
    const unsigned long first = turn_ % pairs;
    for (unsigned long done = 0; done < pairs && credit_ >= 1.0; ++done) {
        const unsigned long mine = (first + done) % pairs;
        look(*scene.all()[mine % scene.listeners()], target_[mine / scene.listeners()]);
        ++turn_;
    }
}

} // namespace ode::sound
