#include "modal/cache.h"

#include "base/error.h"

#include <unistd.h>

#include <atomic>
#include <bit>
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

/// Two FNV-1a hashes of 64 bits with different offsets, each stirred at the end (SplitMix64).
class Hash {
public:
    void bytes(const void* data, std::size_t size) {
        const auto* p = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) {
            a_ = (a_ ^ p[i]) * 0x100000001B3u;
            b_ = (b_ ^ p[i]) * 0x100000001B3u + 0x9E3779B97F4A7C15u;
        }
    }
    void number(std::uint64_t v) { bytes(&v, sizeof v); }
    void number(double v) { number(std::bit_cast<std::uint64_t>(v == 0 ? 0.0 : v)); } // -0 is 0
    void indices(std::span<const int> v) {
        number(std::uint64_t{v.size()});
        bytes(v.data(), v.size_bytes());
    }
    std::uint64_t first() const { return stir(a_); }
    std::string text() const {
        return format("%016llx%016llx", static_cast<unsigned long long>(stir(a_)),
                      static_cast<unsigned long long>(stir(b_)));
    }

private:
    static std::uint64_t stir(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    std::uint64_t a_ = 0xCBF29CE484222325u, b_ = 0x84222325CBF29CE4u;
};

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

void put(std::ostream& out, const std::vector<double>& v) {
    out.write(reinterpret_cast<const char*>(v.data()),
              static_cast<std::streamsize>(v.size() * sizeof(double)));
}

void get(std::istream& in, std::vector<double>& v, std::uint64_t size) {
    v.resize(size);
    in.read(reinterpret_cast<char*>(v.data()), static_cast<std::streamsize>(size * sizeof(double)));
}

bool write(const fs::path& path, const ModalModel& model) {
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
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(&h), sizeof h);
    put(out, model.frequency);
    put(out, model.error_cents);
    put(out, model.shape);
    out.close();
    return out.good();
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
    get(in, model.frequency, h.modes);
    get(in, model.error_cents, h.bands);
    get(in, model.shape, 3 * h.modes * h.nodes);
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
    fs::create_directories(directory, error);
    static std::atomic<unsigned> serial{0};
    const fs::path own = path.string() + format(".%ld.%u", static_cast<long>(::getpid()), serial++);
    const bool written = write(own, model);
    if (written)
        fs::rename(own, path, error);
    if (!written || error) {
        report(format("modal cache '%s' can't be written: the modes will be computed again next "
                      "time (set ODE_SOFTBODY_CACHE to a directory of yours, or to nothing)",
                      directory.c_str()));
        fs::remove(own, error);
    }
    return model;
}

} // namespace ode::soft
