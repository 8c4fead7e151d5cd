// The drawing half of drawstuff's interface. Nothing is drawn: calls are fingerprinted.

#include "picture.h"

#include <drawstuff/drawstuff.h>

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace ode::conformance {

Picture& picture() noexcept {
    static Picture whole;
    return whole;
}

void Picture::set_colour(float r, float g, float b, float a) noexcept {
    const float colour[] = {r, g, b, a};
    std::copy_n(colour, 4, colour_);
}

void Picture::draw(Fingerprint thing) noexcept {
    thing.add(colour_, sizeof colour_);
    thing.add(&texture_, sizeof texture_);
    const std::uint64_t value = thing.value();
    sequence_.add(&value, sizeof value);
    frame_ += value;
    ++things_;
}

void Picture::begin_frame() noexcept {
    set_colour(1, 1, 1, 1);
    set_texture(0);
}

void Picture::end_frame() noexcept {
    seen_.add(&frame_, sizeof frame_);
    frame_ = 0;
}

namespace {

/// An array, of which `count` numbers count.
template <class Number>
struct Array {
    const Number* first;
    std::size_t count;
};

template <class Number>
void add(Fingerprint& to, const Array<Number>& a) noexcept {
    to.add(a.first, a.count * sizeof(Number));
}
template <class Number>
requires std::is_arithmetic_v<Number>
void add(Fingerprint& to, Number value) noexcept { to.add(&value, sizeof value); }

template <class... Arguments>
void drawn(const char* kind, const Arguments&... arguments) noexcept {
    Fingerprint thing;
    thing.add(kind, std::strlen(kind));
    (add(thing, arguments), ...);
    picture().draw(thing);
}

/// Position, and the three rows of a rotation: the fourth number of each row is padding.
template <class Number, class... Arguments>
void placed(const char* call, const Number* pos, const Number* R,
            const Arguments&... arguments) noexcept {
    drawn(call, Array{pos, 3}, Array{R, 3}, Array{R + 4, 3}, Array{R + 8, 3}, arguments...);
}

template <class Number>
void convex(const Number* pos, const Number* R, const Number* planes, unsigned plane_count,
            const Number* points, unsigned point_count, const unsigned* polygons) noexcept {
    // `polygons` holds for each plane the number of its corners and then their indices.
    std::size_t length = 0;
    for (unsigned i = 0; i < plane_count; ++i)
        length += 1 + polygons[length];
    placed("convex", pos, R, Array{planes, 4 * std::size_t{plane_count}},
           Array{points, 3 * std::size_t{point_count}}, Array{polygons, length});
}

} // namespace
} // namespace ode::conformance

using namespace ode::conformance;

extern "C" {

void dsSetTexture(int number) { picture().set_texture(number); }
void dsSetColor(float r, float g, float b) { picture().set_colour(r, g, b, 1); }
void dsSetColorAlpha(float r, float g, float b, float a) { picture().set_colour(r, g, b, a); }
void dsSetSphereQuality(int) {}
void dsSetCapsuleQuality(int) {}
void dsSetDrawMode(int) {}

void dsDrawBox(const float* pos, const float* R, const float* sides) {
    placed("box", pos, R, Array{sides, 3});
}
void dsDrawSphere(const float* pos, const float* R, float radius) {
    placed("sphere", pos, R, radius);
}
void dsDrawTriangle(const float* pos, const float* R, const float* v0, const float* v1,
                    const float* v2, int solid) {
    placed("triangle", pos, R, Array{v0, 3}, Array{v1, 3}, Array{v2, 3}, solid);
}
void dsDrawTriangles(const float* pos, const float* R, const float* v, int n, int solid) {
    placed("triangles", pos, R, Array{v, 9 * static_cast<std::size_t>(n)}, solid);
}
void dsDrawCylinder(const float* pos, const float* R, float length, float radius) {
    placed("cylinder", pos, R, length, radius);
}
void dsDrawCapsule(const float* pos, const float* R, float length, float radius) {
    placed("capsule", pos, R, length, radius);
}
void dsDrawLine(const float* a, const float* b) { drawn("line", Array{a, 3}, Array{b, 3}); }
void dsDrawConvex(const float* pos, const float* R, const float* planes, unsigned plane_count,
                  const float* points, unsigned point_count, const unsigned* polygons) {
    convex(pos, R, planes, plane_count, points, point_count, polygons);
}

void dsDrawBoxD(const double* pos, const double* R, const double* sides) {
    placed("box", pos, R, Array{sides, 3});
}
void dsDrawSphereD(const double* pos, const double* R, float radius) {
    placed("sphere", pos, R, radius);
}
void dsDrawTriangleD(const double* pos, const double* R, const double* v0, const double* v1,
                     const double* v2, int solid) {
    placed("triangle", pos, R, Array{v0, 3}, Array{v1, 3}, Array{v2, 3}, solid);
}
void dsDrawTrianglesD(const double* pos, const double* R, const double* v, int n, int solid) {
    placed("triangles", pos, R, Array{v, 9 * static_cast<std::size_t>(n)}, solid);
}
void dsDrawCylinderD(const double* pos, const double* R, float length, float radius) {
    placed("cylinder", pos, R, length, radius);
}
void dsDrawCapsuleD(const double* pos, const double* R, float length, float radius) {
    placed("capsule", pos, R, length, radius);
}
void dsDrawLineD(const double* a, const double* b) { drawn("line", Array{a, 3}, Array{b, 3}); }
void dsDrawConvexD(const double* pos, const double* R, const double* planes, unsigned plane_count,
                   const double* points, unsigned point_count, const unsigned* polygons) {
    convex(pos, R, planes, plane_count, points, point_count, polygons);
}

} // extern "C"
