#include "reduced/terms_cache.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/kept_file.h"
#include "modal/cache.h"

#include <array>
#include <cstring>
#include <fstream>
#include <optional>

namespace ode::soft {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;

/// Raise when the numbers that condense() gives, or the file's layout, change.
constexpr std::uint32_t kVersion = 1;
constexpr char kMagic[8] = {'O', 'S', 'B', 'c', 'u', 'b', 'e', '\n'};

struct Header {
    char magic[8];
    std::uint64_t version;
    std::uint64_t kept, driven, shapes, rows; ///< rows: three a node
    std::uint64_t checksum;                   ///< of the arrays
};
static_assert(std::is_trivially_copyable_v<Header>);

/// The arrays, in the file's order.
std::array<std::span<const double>, 6> arrays(const CubicTerms::Coefficients& c) {
    const auto all = [](const MatrixXd& m) {
        return std::span(m.data(), static_cast<std::size_t>(m.size()));
    };
    return {all(c.cubic), all(c.quartic), all(c.driving), all(c.following), c.shape, c.follow};
}

std::uint64_t checksum(const CubicTerms::Coefficients& c) {
    Hash hash;
    for (const std::span<const double> part : arrays(c))
        hash.bytes(part.data(), part.size_bytes());
    return hash.first();
}

void write(std::ostream& out, const CubicTerms::Coefficients& c) {
    Header h;
    std::memset(&h, 0, sizeof h);
    std::memcpy(h.magic, kMagic, sizeof kMagic);
    h.version = kVersion;
    h.kept = c.order.modes;
    h.driven = c.driven;
    h.shapes = c.follow.size();
    h.rows = h.shapes > 0 ? c.shape.size() / h.shapes : 0;
    h.checksum = checksum(c);
    out.write(reinterpret_cast<const char*>(&h), sizeof h);
    for (const std::span<const double> part : arrays(c))
        put_numbers(out, part);
}

/// @return none: the file isn't what is asked for.
std::optional<CubicTerms::Coefficients> read(const fs::path& path, std::size_t nodes,
                                             const CubicExtent& extent) {
    std::ifstream in(path, std::ios::binary);
    Header h;
    if (!in.read(reinterpret_cast<char*>(&h), sizeof h) ||
        std::memcmp(h.magic, kMagic, sizeof kMagic) != 0 || h.version != kVersion ||
        h.kept != extent.kept || h.driven != extent.driven || h.shapes > extent.following ||
        h.rows != (h.shapes > 0 ? 3 * nodes : 0))
        return {};
    CubicTerms::Coefficients c;
    c.order.modes = h.kept;
    c.driven = h.driven;
    const std::uint64_t pairs = c.order.count();
    // Checked against the file's size before anything is allocated by it.
    std::error_code error;
    if (fs::file_size(path, error) !=
            sizeof h + 8 * (pairs * (h.kept + pairs + h.driven + h.shapes) + h.shapes * h.rows +
                            h.shapes) ||
        error)
        return {};
    const auto matrix = [&](std::uint64_t rows) {
        const std::vector<double> all = get_numbers(in, rows * pairs);
        return MatrixXd(Eigen::Map<const MatrixXd>(all.data(), static_cast<Index>(rows),
                                                   static_cast<Index>(pairs)));
    };
    c.cubic = matrix(h.kept);
    c.quartic = matrix(pairs);
    c.driving = matrix(h.driven);
    c.following = matrix(h.shapes);
    c.shape = get_numbers(in, h.shapes * h.rows);
    c.follow = get_numbers(in, h.shapes);
    if (!in || checksum(c) != h.checksum)
        return {};
    return c;
}

} // namespace

CubicTerms::Coefficients cached_terms(const TetMesh& mesh, std::span<const Solid> solids,
                                      const ModalOptions& options, std::span<const double> mass,
                                      const CubicExtent& extent, const fs::path& directory) {
    const auto make = [&] {
        return condense(mesh, solids, options, cached_modes(mesh, solids, options, directory), mass,
                        extent);
    };
    if (directory.empty())
        return make();
    const fs::path path =
        directory / format("%s.%zu.%zu.cubic", content_hash(mesh, solids, options).c_str(),
                           extent.kept, extent.driven);
    std::error_code error;
    if (fs::exists(path, error)) {
        if (auto kept = read(path, mesh.node.size(), extent))
            return std::move(*kept);
        report(format("cache '%s' is damaged, or of another version: its terms are computed anew",
                      path.c_str()));
    }
    CubicTerms::Coefficients made = make();
    if (!keep_file(path, [&](std::ostream& out) { write(out, made); }))
        report(format("cache '%s' can't be written: the cubic tier's terms will be computed again "
                      "next time (set ODE_SOFTBODY_CACHE to a directory of yours, or to nothing)",
                      directory.c_str()));
    return made;
}

} // namespace ode::soft
