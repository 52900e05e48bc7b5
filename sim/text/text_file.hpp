#pragma once
// Text files that users name: scenarios, parts, captures. Pipes are read too, as of `<(command)`.
#include <cstddef>
#include <filesystem>
#include <string>

namespace sim {

inline constexpr std::size_t mebibyte = std::size_t{1} << 20U;

/// The whole text of a file of at most `longest` bytes; throws for a longer one, for a folder and
/// for a pipe that nothing is written to. `what` says what the file should be: "scenario".
std::string read_text_file(const std::filesystem::path& path, const std::string& what,
                           std::size_t longest = mebibyte);

}  // namespace sim
