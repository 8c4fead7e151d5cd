// The critical step against the exact one, by a dense eigensolver: at rest and deformed.
#include "stability/suite.h"

#include "base/error.h"
#include "integrate/critical_step.h"
#include "mesh/generate.h"

#include <Eigen/Eigenvalues>

#include <random>

namespace ode::test {
namespace {

using namespace ode::soft;

double exact_step(const Body& body, double beta) {
    const Eigen::MatrixXd k = body.model().stiffness(body.state().position);
    Eigen::VectorXd scale(k.rows());
    for (Eigen::Index i = 0; i < k.rows(); ++i)
        scale[i] = 1 / std::sqrt(body.mass()[static_cast<std::size_t>(i / 3)]);
    const double square = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                              scale.asDiagonal() * k * scale.asDiagonal(), Eigen::EigenvaluesOnly)
                              .eigenvalues()
                              .maxCoeff();
    return critical_step(std::sqrt(square), beta);
}

struct Form {
    const char* name;
    std::function<Vec3(const Vec3&)> place;
};

std::vector<Form> forms(double size) {
    return {{"at rest", [](const Vec3& x) { return x; }},
            {"pulled to 1.5", [](const Vec3& x) { return Vec3(1.5 * x.x(), x.y(), x.z()); }},
            {"blown up to 1.3", [](const Vec3& x) { return Vec3(1.3 * x); }},
            {"squashed to 0.7", [](const Vec3& x) { return Vec3(x.x(), x.y(), 0.7 * x.z()); }},
            {"twisted",
             [size](const Vec3& x) {
                 return Vec3(Eigen::AngleAxisd(2 * x.x() / size, Vec3::UnitX()) * x);
             }},
            // Not just mirrored: there the co-rotated law has no derivative.
            {"turned inside out",
             [](const Vec3& x) { return Vec3(-x.x(), 1.1 * x.y(), 0.9 * x.z()); }}};
}

StressResult run(const std::function<TetMesh()>& mesh, const Solid& solid, const std::string& law,
                 int order, const Form& form) {
    Scene scene;
    Body& body = scene.add(mesh(), solid, law, order);
    deform(body, form.place);
    const double ratio = body.present_critical_step() / exact_step(body, viscous_time(solid));
    return {"estimated", ratio >= 0.85 && ratio <= 1,
            format("%.4f of the exact step, %.3g of that at rest", ratio,
                   body.present_critical_step() / body.critical_step())};
}

} // namespace

void add_critical_step_cases(std::vector<StressCase>& cases) {
    struct Shape {
        const char* name;
        double size;
        TetMesh (*make)();
    };
    static const Shape shapes[] = {
        {"bar", 0.3, [] { return make_bar(0.3, 0.02, 0.01, 8, 1, 1); }},
        {"cube", 0.1,
         [] {
             return make_box({0.1, 0.1, 0.1}, 2, 2, 2);
         }},
        {"bowl", 0.1, [] { return make_bowl(0.1, 0.005, 1.57, 2, 8, 1); }},
        {"ball", 0.1, [] { return make_sphere(0.05, 1); }}};
    Solid viscous = solid_of(1e6, 0.3, 1000);
    viscous.beta = 1e-5;
    const std::pair<const char*, Solid> solids[] = {{"steel", solid_of(200e9, 0.29, 7850)},
                                                    {"rubber", solid_of(1e6, 0.49, 1100)},
                                                    {"viscous", viscous}};
    for (const Shape& shape : shapes)
        for (const auto& [solid_name, solid] : solids)
            for (const char* law : {"stvk", "corotated", "stable-neo-hookean"})
                for (const int order : {1, 2})
                    for (const Form& form : forms(shape.size))
                        cases.push_back({"critical step",
                                         format("%s, %s, %s, order %d, %s", shape.name, solid_name,
                                                law, order, form.name),
                                         true, [=, solid = solid, make = shape.make] {
                                             return run(make, solid, law, order, form);
                                         }});
}

} // namespace ode::test
