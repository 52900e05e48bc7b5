#pragma once
// What stands where a file shall be written. The program replaces files of its own of the same
// kind; what else a user has there, named by mistake, must not be lost.
#include <filesystem>
#include <string>

namespace sim {

/// The first bytes of a file; fewer if it is shorter, none if it cannot be read.
std::string beginning_of(const std::filesystem::path& path, std::size_t bytes);
/// The last ones.
std::string end_of(const std::filesystem::path& path, std::size_t bytes);

}  // namespace sim
