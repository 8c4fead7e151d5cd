// Bodies treated roughly: thrown at a wall at a good share of the speed of sound in them, twisted,
// pulled, squashed, turned inside out, scrambled. They recover or it is told; stable neo-Hookean
// ones recover.
#include "stability/suite.h"

#include "base/error.h"
#include "mesh/generate.h"

#include <random>

namespace ode::test {
namespace {

using namespace ode::soft;

constexpr double kSide = 0.1; ///< [m]

TetMesh cube_of(int order) {
    const int cells = order == 1 ? 4 : 2;
    return make_box({kSide, kSide, kSide}, cells, cells, cells);
}

StressResult thrown(const std::string& law, int order, double share) {
    Scene scene;
    scene.add_floor();
    const Solid rubber = solid_of(1e6, 0.3, 1000);
    Body& cube = scene.add(cube_of(order), rubber, law, order);
    cube.move_to({0, 0, kSide / 2 + 0.002});
    const double speed = share * wave_speed(rubber);
    cube.set_velocity({0, 0, -speed});
    const double before = cube.kinetic_energy();
    scene.run(0.06, 0.002);
    const double after = cube.kinetic_energy() + cube.elastic_energy();
    const bool must_recover = law == "stable-neo-hookean";
    return judged(
        scene, (!must_recover || scene.verdict().recovered()) && after <= 1.1 * before,
        format("least J %.2g, energy x %.3g", scene.verdict().least_jacobian, after / before));
}

StressResult released(const std::string& law, int order,
                      const std::function<Vec3(const Vec3&)>& place) {
    Scene scene;
    Solid jelly = solid_of(1e6, 0.3, 1000);
    jelly.phi = jelly.psi = 100; // [Pa s]: comes to rest
    Body& cube = scene.add(cube_of(order), jelly, law, order);
    deform(cube, place);
    const double before = cube.elastic_energy();
    scene.run(0.3, 0.005);
    const double after = cube.kinetic_energy() + cube.elastic_energy();
    const bool must_recover = law == "stable-neo-hookean";
    const bool at_rest = cube.elastic_energy() <= 1e-3 * before;
    return judged(scene,
                  (!must_recover || (scene.verdict().recovered() && at_rest)) &&
                      after <= EnergyBudget::kMost * std::max(before, 1e-9),
                  format("J %.2g, then %.2g; energy %.2g J, then %.2g",
                         scene.verdict().least_jacobian, scene.verdict().last_jacobian, before,
                         after));
}

} // namespace

void add_deformation_cases(std::vector<StressCase>& cases) {
    struct Form {
        const char* name;
        std::function<Vec3(const Vec3&)> place;
    };
    const auto scramble = [bits = std::make_shared<std::mt19937>(11)](const Vec3&) {
        const auto random = [&] {
            return kSide * (double((*bits)()) / double(std::mt19937::max()) - 0.5);
        };
        const double x = random(), y = random(), z = random();
        return Vec3(x, y, z);
    };
    const Form forms[] = {
        {"twisted by 180 degrees",
         [](const Vec3& x) {
             return Vec3(Eigen::AngleAxisd(M_PI * x.z() / kSide, Vec3::UnitZ()) * x);
         }},
        {"pulled to 2", [](const Vec3& x) { return Vec3(x.x(), x.y(), 2 * x.z()); }},
        {"squashed to 0.3", [](const Vec3& x) { return Vec3(x.x(), x.y(), 0.3 * x.z()); }},
        {"turned inside out", [](const Vec3& x) { return Vec3(x.x(), x.y(), -x.z()); }},
        {"all nodes scrambled", scramble}};
    constexpr const char* kLaws[] = {"stvk", "corotated", "stable-neo-hookean"};
    for (const char* law : kLaws)
        for (const int order : {1, 2})
            for (const double share : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6})
                cases.push_back({"thrown at a wall",
                                 format("%s, order %d, %g of the wave speed", law, order, share),
                                 true, [=] { return thrown(law, order, share); }});
    for (const char* law : kLaws)
        for (const int order : {1, 2})
            for (const Form& form : forms)
                cases.push_back({"released", format("%s, order %d, %s", law, order, form.name),
                                 true, [=] { return released(law, order, form.place); }});
}

} // namespace ode::test
