#include "mesh/generate.h"
#include "mesh/lattice.h"

namespace ode::soft {

namespace {

TetMesh make_block(const Vec3& low, const Vec3& size, const std::array<int, 3>& cells,
                   const char* shape) {
    constexpr const char* kSize[3] = {"size along x", "size along y", "size along z"};
    constexpr const char* kCells[3] = {"the number of cells along x", "the number of cells along y",
                                       "the number of cells along z"};
    double elements = 6.0;
    for (std::size_t a = 0; a < 3; ++a) {
        require_length(size[static_cast<Eigen::Index>(a)], kSize[a], shape);
        require_count(cells[a], 1, kCells[a], shape);
        elements *= cells[a];
    }
    require_size(elements, shape);
    TetMesh mesh = cut_lattice(cells, false);
    std::size_t at = 0;
    for (int k = 0; k <= cells[2]; ++k)
        for (int j = 0; j <= cells[1]; ++j)
            for (int i = 0; i <= cells[0]; ++i)
                mesh.node[at++] =
                    low + size.cwiseProduct(Vec3(double(i) / cells[0], double(j) / cells[1],
                                                 double(k) / cells[2]));
    return mesh;
}

} // namespace

TetMesh make_box(const Vec3& size, int nx, int ny, int nz) {
    return make_block(-0.5 * size, size, {nx, ny, nz}, "box");
}

TetMesh make_bar(double length, double width, double thickness, int nx, int ny, int nz) {
    return make_block({0.0, -0.5 * width, -0.5 * thickness}, {length, width, thickness},
                      {nx, ny, nz}, "bar");
}

TetMesh make_plate(double length, double width, double thickness, int nx, int ny, int nz) {
    const Vec3 size(length, width, thickness);
    return make_block(-0.5 * size, size, {nx, ny, nz}, "plate");
}

} // namespace ode::soft
