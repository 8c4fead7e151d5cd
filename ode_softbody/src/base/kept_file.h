#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <span>
#include <vector>

namespace ode::soft {

/// Writes a file under a name of its own and renames it into place, making its folder if need be:
/// two processes at once are safe, each leaves it whole.
/// @return false: it couldn't be written, and nothing is left of it.
bool keep_file(const std::filesystem::path& path,
               const std::function<void(std::ostream& out)>& write);

/// In native byte order: what is kept belongs to one machine.
void put_numbers(std::ostream& out, std::span<const double> numbers);
std::vector<double> get_numbers(std::istream& in, std::uint64_t count);

} // namespace ode::soft
