#include "sim/text/text_file.hpp"

#include <fmt/format.h>

#include <array>

#include "sim/failure.hpp"
#include "sim/text/input_file.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

Failure too_long(const std::string& name, const std::string& what, std::size_t longest) {
  return bad_input(name, fmt::format("longer than {} MiB", longest / mebibyte),
                   "shorten it or name a " + what + " file");
}

std::string read_all(const fs::path& path, const std::string& what, std::size_t longest) {
  const std::string name = path.generic_string();
  InputFile file(path);
  std::array<char, 65536> chunk;
  std::string text;
  for (;;) {
    const std::size_t n = file.read(chunk.data(), chunk.size());
    if (n == 0) return text;
    text.append(chunk.data(), n);
    if (text.size() > longest) throw too_long(name, what, longest);
  }
}

}  // namespace

std::string read_text_file(const fs::path& path, const std::string& what, std::size_t longest) {
  const std::string name = path.generic_string();
  refuse_no_file(path, what);
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_regular_file(status) && fs::file_size(path, ignored) > longest)
    throw too_long(name, what, longest);
  std::string text = read_all(path, what, longest);
  if (text.empty() && fs::is_fifo(status))
    throw bad_input(name, "a pipe that nothing is written to", "start its writer first");
  return text;
}

}  // namespace sim
