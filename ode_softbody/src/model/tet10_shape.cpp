#include "model/tet10_shape.h"

#include "mesh/tet_mesh.h"

namespace ode::soft {

Shapes10 tet10_shapes(const Eigen::Vector4d& l) noexcept {
    Shapes10 n;
    for (int a = 0; a < 4; ++a)
        n[a] = l[a] * (2 * l[a] - 1);
    for (int e = 0; e < 6; ++e)
        n[4 + e] = 4 * l[kTetEdge[e][0]] * l[kTetEdge[e][1]];
    return n;
}

Gradients10 tet10_gradients(const Eigen::Vector4d& l) noexcept {
    Eigen::Matrix<double, 4, 3> dl; // dL_a / dL_(1..3)
    dl << -1, -1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    Gradients10 g;
    for (int a = 0; a < 4; ++a)
        g.row(a) = (4 * l[a] - 1) * dl.row(a);
    for (int e = 0; e < 6; ++e) {
        const int a = kTetEdge[e][0], b = kTetEdge[e][1];
        g.row(4 + e) = 4 * (l[a] * dl.row(b) + l[b] * dl.row(a));
    }
    return g;
}

const std::array<TetPoint, 14>& tet_rule_of_degree_5() {
    static const auto rule = [] {
        std::array<TetPoint, 14> points;
        auto at = points.begin();
        for (const auto& [a, weight] :
             {std::pair(0.31088591926330060980, 0.11268792571801585080),
              std::pair(0.092735250310891226402, 0.073493043116361949544)})
            for (int i = 0; i < 4; ++i) {
                *at = {Eigen::Vector4d::Constant(a), weight};
                at->l[i] = 1 - 3 * a;
                ++at;
            }
        constexpr double kA = 0.045503704125649649492;
        for (const auto& edge : kTetEdge) {
            *at = {Eigen::Vector4d::Constant(kA), 0.042546020777081466438};
            at->l[edge[0]] = at->l[edge[1]] = 0.5 - kA;
            ++at;
        }
        return points;
    }();
    return rule;
}

} // namespace ode::soft
