#pragma once
// The ends of a file, by which those that the program wrote itself are known.
#include <filesystem>
#include <string>

namespace sim {

/// The first bytes of a file; fewer if it is shorter, none if it cannot be read.
std::string beginning_of(const std::filesystem::path& path, std::size_t bytes);
/// The last ones.
std::string end_of(const std::filesystem::path& path, std::size_t bytes);

}  // namespace sim
