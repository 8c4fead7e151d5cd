#include "transfer/table_cache.h"

#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <type_traits>

namespace ode::sound {
namespace {

namespace fs = std::filesystem;

/// Raise when the numbers in a table, or how they are laid out here, change.
constexpr std::uint32_t kVersion = 2;
constexpr char kMagic[8] = {'O', 'S', 'B', 's', 'o', 'u', 'n', 'd'};

/// Not meant to resist forgery. The standard library may hash otherwise elsewhere: a table is then
/// made anew, as the cache of one machine may.
std::uint64_t hash(std::string_view bytes) { return std::hash<std::string_view>{}(bytes); }

struct Key {
    std::uint64_t first, second;
    bool operator==(const Key&) const = default;
};

template <class T>
void put(std::string& out, const T* first, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec3>);
    out.append(reinterpret_cast<const char*>(first), count * sizeof(T));
}

template <class T>
void put_all(std::string& out, const std::vector<T>& all) {
    const std::uint64_t count = all.size();
    put(out, &count, 1);
    put(out, all.data(), all.size());
}

Key key_of(const ModalSurface& surface, const std::string& rule) {
    std::string all = rule;
    all.push_back('\0');
    put_all(all, surface.mesh.node);
    put_all(all, surface.mesh.triangle);
    put_all(all, surface.frequency);
    put_all(all, surface.shape);
    const std::uint64_t first = hash(all);
    all.push_back('+');
    return {first, hash(all)};
}

/// Native byte order: the cache belongs to one machine.
struct Header {
    char magic[8];
    std::uint32_t version, unused;
    Key key;
    std::uint64_t checksum; ///< of what follows
};
static_assert(std::is_trivially_copyable_v<Header>);

/// Numbers of a table that are not in its arrays.
struct Frame {
    double centre[3], radius, speed, boundary_limit;
    std::int64_t triangles;
};

std::string as_bytes(const TransferTable& t) {
    std::string out;
    const Frame frame{
        {t.centre[0], t.centre[1], t.centre[2]}, t.radius, t.speed, t.boundary_limit, t.triangles};
    put(out, &frame, 1);
    put_all(out, t.mode);
    put_all(out, t.coefficient);
    put_all(out, t.per_sphere);
    return out;
}

class Reader {
public:
    explicit Reader(std::string_view rest) : rest_(rest) {}
    template <class T>
    bool get(T* out, std::size_t count) {
        if (count > rest_.size() / sizeof(T))
            return false;
        std::memcpy(static_cast<void*>(out), rest_.data(), count * sizeof(T));
        rest_.remove_prefix(count * sizeof(T));
        return true;
    }
    template <class T>
    bool get_all(std::vector<T>& out) {
        std::uint64_t count = 0;
        if (!get(&count, 1) || count > rest_.size() / sizeof(T))
            return false;
        out.resize(count);
        return get(out.data(), count);
    }
    bool at_end() const { return rest_.empty(); }

private:
    std::string_view rest_;
};

bool from_bytes(std::string_view bytes, TransferTable& t) {
    Reader in(bytes);
    Frame frame{};
    if (!in.get(&frame, 1) || !in.get_all(t.mode) || !in.get_all(t.coefficient) ||
        !in.get_all(t.per_sphere) || !in.at_end())
        return false;
    t.centre = Vec3(frame.centre[0], frame.centre[1], frame.centre[2]);
    t.radius = frame.radius;
    t.speed = frame.speed;
    t.boundary_limit = frame.boundary_limit;
    t.triangles = static_cast<int>(frame.triangles);
    return true;
}

/// The table, or what is wrong with the file.
std::optional<TransferTable> read(const fs::path& path, const Key& key, std::string& fault) {
    std::ifstream in(path, std::ios::binary);
    const std::string all((std::istreambuf_iterator<char>(in)), {});
    Header h{};
    if (all.size() < sizeof h) {
        fault = "has been cut short";
        return {};
    }
    std::memcpy(&h, all.data(), sizeof h);
    const std::string_view rest = std::string_view(all).substr(sizeof h);
    TransferTable table;
    if (std::memcmp(h.magic, kMagic, sizeof kMagic) != 0)
        fault = "is no table of radiation";
    else if (h.version != kVersion)
        fault = "is of version " + std::to_string(h.version) + ", not " + std::to_string(kVersion);
    else if (h.key != key)
        fault = "is of another body";
    else if (hash(rest) != h.checksum || !from_bytes(rest, table))
        fault = "is damaged";
    else
        return table;
    return {};
}

bool write(const fs::path& path, const Key& key, const TransferTable& table) {
    const std::string bytes = as_bytes(table);
    Header h{};
    std::memcpy(h.magic, kMagic, sizeof kMagic);
    h.version = kVersion;
    h.key = key;
    h.checksum = hash(bytes);
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(&h), sizeof h);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    return out.good();
}

std::string name_of(const Key& key) {
    char text[48];
    std::snprintf(text, sizeof text, "%016llx%016llx.sound",
                  static_cast<unsigned long long>(key.first),
                  static_cast<unsigned long long>(key.second));
    return text;
}

} // namespace

std::string TableCache::name(const ModalSurface& surface, const std::string& rule) {
    return name_of(key_of(surface, rule));
}

TransferTable TableCache::get(const ModalSurface& surface, const std::string& rule,
                              const std::function<TransferTable()>& make) const {
    if (directory.empty())
        return make();
    const auto say = [this](const std::string& sentence) {
        if (tell)
            tell(sentence);
    };
    const Key key = key_of(surface, rule);
    const fs::path path = directory / name_of(key);
    std::error_code error;
    if (fs::exists(path, error)) {
        std::string fault;
        if (std::optional<TransferTable> table = read(path, key, fault))
            return std::move(*table);
        say("radiation cache '" + path.string() + "' " + fault + ": the table is made anew");
    }
    TransferTable table = make();
    fs::create_directories(directory, error);
    static std::atomic<unsigned> serial{0};
    const fs::path own =
        path.string() + "." + std::to_string(::getpid()) + "." + std::to_string(serial++);
    const bool written = write(own, key, table);
    if (written)
        fs::rename(own, path, error);
    if (!written || error) {
        say("radiation cache '" + directory.string() +
            "' can't be written: the table will be made again next time (set ODE_SOFTBODY_CACHE to "
            "a directory of yours, or to nothing)");
        fs::remove(own, error);
    }
    return table;
}

} // namespace ode::sound
