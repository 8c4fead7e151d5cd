#include "base/kept_file.h"

#include "base/error.h"

#include <unistd.h>

#include <atomic>
#include <fstream>

namespace ode::soft {

namespace fs = std::filesystem;

bool keep_file(const fs::path& path, const std::function<void(std::ostream& out)>& write) {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    static std::atomic<unsigned> serial{0};
    const fs::path own = path.string() + format(".%ld.%u", static_cast<long>(::getpid()), serial++);
    std::ofstream out(own, std::ios::binary);
    write(out);
    out.close();
    if (out.good())
        fs::rename(own, path, error);
    if (out.good() && !error)
        return true;
    fs::remove(own, error);
    return false;
}

void put_numbers(std::ostream& out, std::span<const double> numbers) {
    out.write(reinterpret_cast<const char*>(numbers.data()),
              static_cast<std::streamsize>(numbers.size_bytes()));
}

std::vector<double> get_numbers(std::istream& in, std::uint64_t count) {
    std::vector<double> out(count);
    in.read(reinterpret_cast<char*>(out.data()),
            static_cast<std::streamsize>(count * sizeof(double)));
    return out;
}

} // namespace ode::soft
