// write_seeds DIRECTORY: puts a linear and a quadratic mesh in each format there, to start from.
#include "mesh/generate.h"
#include "unit/mesh/writers.h"

#include <cstdio>
#include <fstream>
#include <numeric>

int main(int argc, char** argv) {
    using namespace ode::soft;
    if (argc != 2) {
        std::fprintf(stderr, "usage: write_seeds DIRECTORY\n");
        return 2;
    }
    TetMesh linear = make_box({1, 1, 1}, 1, 1, 1);
    linear.group = {0, 0, 0, 1, 1, 1};
    linear.group_name = {"a", "b"};
    TetMesh quadratic;
    quadratic.order = 2;
    quadratic.node = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const auto& [i, j] : kTetEdge)
        quadratic.node.push_back(0.5 * (quadratic.node[static_cast<std::size_t>(i)] +
                                        quadratic.node[static_cast<std::size_t>(j)]));
    quadratic.element.resize(10);
    std::iota(quadratic.element.begin(), quadratic.element.end(), 0);
    for (const test::Dress& dress : test::all_dresses()) {
        const std::string stem = std::string(argv[1]) + "/" + dress.name;
        std::ofstream(stem + "_1", std::ios::binary) << dress.write(linear);
        std::ofstream(stem + "_2", std::ios::binary) << dress.write(quadratic);
    }
    return 0;
}
