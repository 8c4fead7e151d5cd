// Meshes as they come: each works, or is refused in a sentence.
#include "stability/suite.h"

#include "base/error.h"
#include "mesh/generate.h"
#include "mesh/quality.h"

namespace ode::test {
namespace {

using namespace ode::soft;

StressResult run(const TetMesh& mesh, int order, double seconds) {
    Scene scene(-9.81);
    scene.add_floor();
    try {
        Body& body = scene.add(mesh, solid_of(1e6, 0.3, 1000), "stvk", order);
        body.move_to({0, 0, 0.06});
        body.set_velocity({0, 0, -1});
        scene.run(seconds, seconds / 10);
        return judged(scene, !body.stopped(),
                      format("%zu elements, quality %.1g, critical step %.2g s",
                             mesh.element_count(), measure_quality(mesh).min_quality,
                             body.critical_step()));
    } catch (const InputError& e) {
        const std::string sentence = e.what();
        return {"refused", sentence.size() > 10, sentence};
    }
}

TetMesh cube() { return make_box({0.1, 0.1, 0.1}, 2, 2, 2); }

TetMesh one_element() {
    TetMesh mesh;
    mesh.node = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
    mesh.element = {0, 1, 2, 3};
    return mesh;
}

/// The middle node all but on another.
TetMesh slivers() {
    TetMesh mesh = cube();
    for (Vec3& x : mesh.node)
        if (x.norm() < 1e-9) {
            x = 0.9985 * Vec3(0.05, 0, 0);
            break;
        }
    return mesh;
}

TetMesh duplicated() {
    TetMesh mesh = cube();
    mesh.node.push_back(mesh.node[0]); // a second node at the same place, in an element of its own
    const int copy = static_cast<int>(mesh.node.size()) - 1;
    mesh.element.insert(mesh.element.end(), {0, copy, 1, 2});
    return mesh;
}

TetMesh inverted() {
    TetMesh mesh = cube();
    std::swap(mesh.element[0], mesh.element[1]);
    return mesh;
}

TetMesh flat() {
    TetMesh mesh = one_element();
    mesh.node[3] = {0.05, 0.05, 0};
    return mesh;
}

TetMesh in_two_parts() {
    TetMesh mesh = cube();
    const TetMesh other = cube();
    const int first = static_cast<int>(mesh.node.size());
    for (const Vec3& x : other.node)
        mesh.node.push_back(x + Vec3(0.3, 0, 0));
    for (const int n : other.element)
        mesh.element.push_back(first + n);
    return mesh;
}

} // namespace

void add_mesh_cases(std::vector<StressCase>& cases) {
    struct Input {
        const char* name;
        TetMesh (*make)();
    };
    static const Input inputs[] = {{"slivers", slivers},
                                   {"a duplicate node", duplicated},
                                   {"an inverted element", inverted},
                                   {"an element without volume", flat},
                                   {"two parts", in_two_parts},
                                   {"one element", one_element}};
    for (const Input& input : inputs)
        for (const int order : {1, 2})
            cases.push_back({"mesh", format("%s, order %d", input.name, order), true,
                             [make = input.make, order] { return run(make(), order, 0.02); }});
    cases.push_back({"mesh", "105 456 elements", false, [] {
                         return run(make_box({0.1, 0.1, 0.1}, 26, 26, 26), 1, 0.002);
                     }});
}

} // namespace ode::test
