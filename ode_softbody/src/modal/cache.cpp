#include "modal/cache.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/kept_file.h"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>

namespace ode::soft {
namespace {

namespace fs = std::filesystem;

/// Raise when the numbers that solve_modes() gives, or the file's layout, change.
constexpr std::uint32_t kVersion = 6;
constexpr char kMagic[8] = {'O', 'S', 'B', 'm', 'o', 'd', 'e', '\n'};

/// Fixed-size fields of the file, native byte order: the cache belongs to one machine, and a
/// foreign file fails the version or the checksum.
struct Header {
    char magic[8];
    std::uint32_t version;
    std::uint32_t complete;
    std::uint64_t modes, bands, nodes, rigid;
    double mass, volume, centre[3], inertia[9];
    std::uint64_t checksum; ///< of the header with this field zero, then of the arrays
};
static_assert(std::is_trivially_copyable_v<Header>);

std::uint64_t checksum(Header header, const ModalModel& model) {
    header.checksum = 0;
    Hash hash;
    hash.bytes(&header, sizeof header);
    hash.bytes(model.frequency.data(), model.frequency.size() * sizeof(double));
    hash.bytes(model.error_cents.data(), model.error_cents.size() * sizeof(double));
    hash.bytes(model.shape.data(), model.shape.size() * sizeof(double));
    return hash.first();
}

void write(std::ostream& out, const ModalModel& model) {
    Header h;
    std::memset(&h, 0, sizeof h);
    std::memcpy(h.magic, kMagic, sizeof kMagic);
    h.version = kVersion;
    h.complete = model.complete;
    h.modes = model.frequency.size();
    h.bands = model.error_cents.size();
    h.nodes = model.node_count;
    h.rigid = static_cast<std::uint64_t>(model.rigid_modes);
    h.mass = model.body.mass;
    h.volume = model.body.volume;
    std::copy_n(model.body.centre.data(), 3, h.centre);
    std::copy_n(model.body.inertia.data(), 9, h.inertia);
    h.checksum = checksum(h, model);
    out.write(reinterpret_cast<const char*>(&h), sizeof h);
    put_numbers(out, model.frequency);
    put_numbers(out, model.error_cents);
    put_numbers(out, model.shape);
}

/// The model, or what is wrong with the file.
std::optional<ModalModel> read(const fs::path& path, std::string& fault) {
    std::ifstream in(path, std::ios::binary);
    Header h;
    if (!in.read(reinterpret_cast<char*>(&h), sizeof h) ||
        std::memcmp(h.magic, kMagic, sizeof kMagic) != 0) {
        fault = "is not a modal model";
        return {};
    }
    if (h.version != kVersion) {
        fault = format("is of version %u, not %u", h.version, kVersion);
        return {};
    }
    // Sizes are checked against the file's before anything is allocated by them.
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    constexpr std::uint64_t kMost = std::uint64_t{1} << 31;
    if (error || h.modes > kMost || h.nodes > kMost || (h.bands != 0 && h.bands != h.modes) ||
        (h.nodes != 0 && h.modes > (std::uint64_t{1} << 58) / h.nodes) ||
        size != sizeof h + 8 * (h.modes + h.bands + 3 * h.modes * h.nodes)) {
        fault = "has been cut short or grown";
        return {};
    }
    ModalModel model;
    model.frequency = get_numbers(in, h.modes);
    model.error_cents = get_numbers(in, h.bands);
    model.shape = get_numbers(in, 3 * h.modes * h.nodes);
    model.node_count = h.nodes;
    model.rigid_modes = static_cast<int>(h.rigid);
    model.complete = h.complete != 0;
    model.body.mass = h.mass;
    model.body.volume = h.volume;
    std::copy_n(h.centre, 3, model.body.centre.data());
    std::copy_n(h.inertia, 9, model.body.inertia.data());
    if (!in || checksum(h, model) != h.checksum) {
        fault = "is damaged";
        return {};
    }
    return model;
}

} // namespace

fs::path cache_directory() {
    if (const char* own = std::getenv("ODE_SOFTBODY_CACHE"))
        return own;
    if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg)
        return fs::path(xdg) / "ode_softbody";
    if (const char* home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".cache" / "ode_softbody";
    return {};
}

std::string content_hash(const TetMesh& mesh, std::span<const Solid> solids,
                         const ModalOptions& options) {
    Hash h;
    h.number(std::uint64_t{kVersion});
    h.number(static_cast<std::uint64_t>(mesh.order));
    h.number(std::uint64_t{mesh.node.size()});
    for (const Vec3& x : mesh.node)
        for (int axis = 0; axis < 3; ++axis)
            h.number(x[axis]);
    h.indices(mesh.element);
    h.indices(mesh.group);
    h.number(std::uint64_t{solids.size()});
    for (const Solid& s : solids) // undamped modes: the damping fields don't matter
        for (const double v : {s.young, s.poisson, s.density})
            h.number(v);
    h.number(static_cast<std::uint64_t>(options.order));
    h.number(static_cast<std::uint64_t>(options.mass));
    h.number(options.max_frequency);
    h.number(std::uint64_t{options.max_modes});
    h.indices(options.clamped);
    for (const auto& roller : options.rollers)
        h.indices(roller);
    h.number(std::uint64_t{options.clamp});
    h.number(std::uint64_t{options.estimate});
    h.number(std::uint64_t{options.rebuilt_curves});
    h.number(std::uint64_t{options.facets.size()});
    for (const Vec3& x : options.facets)
        for (int axis = 0; axis < 3; ++axis)
            h.number(x[axis]);
    h.number(std::uint64_t{options.verify});
    return h.text();
}

ModalModel cached_modes(const TetMesh& mesh, std::span<const Solid> solids,
                        const ModalOptions& options) {
    return cached_modes(mesh, solids, options, cache_directory());
}

ModalModel cached_modes(const TetMesh& mesh, std::span<const Solid> solids,
                        const ModalOptions& options, const fs::path& directory) {
    if (directory.empty())
        return solve_modes(mesh, solids, options);
    const fs::path path = directory / (content_hash(mesh, solids, options) + ".modes");
    std::error_code error;
    if (fs::exists(path, error)) {
        std::string fault;
        if (std::optional<ModalModel> model = read(path, fault))
            if (model->node_count == mesh.node.size())
                return std::move(*model);
        report(format("modal cache '%s' %s: computing the modes anew", path.c_str(),
                      fault.empty() ? "belongs to another mesh" : fault.c_str()));
    }
    ModalModel model = solve_modes(mesh, solids, options);
    if (!keep_file(path, [&](std::ostream& out) { write(out, model); }))
        report(format("modal cache '%s' can't be written: the modes will be computed again next "
                      "time (set ODE_SOFTBODY_CACHE to a directory of yours, or to nothing)",
                      directory.c_str()));
    return model;
}

} // namespace ode::soft
