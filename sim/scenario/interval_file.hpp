#pragma once
#include <filesystem>
#include <string>

namespace sim {

/// Numbers of a file, one a line, as a list: "100,250,900". Empty lines and those that begin with #
/// say nothing. `asked` opens the error line if there is no such file.
std::string read_number_lines(const std::filesystem::path& path, const std::string& asked);

}  // namespace sim
