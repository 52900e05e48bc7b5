#include "sim/text/existing_file.hpp"

#include <algorithm>
#include <fstream>

namespace sim {

namespace fs = std::filesystem;

namespace {

std::string read_from(std::ifstream& file, std::size_t bytes) {
  std::string text(bytes, '\0');
  file.read(text.data(), static_cast<std::streamsize>(bytes));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

}  // namespace

std::string beginning_of(const fs::path& path, std::size_t bytes) {
  std::ifstream file(path, std::ios::binary);
  return read_from(file, bytes);
}

std::string end_of(const fs::path& path, std::size_t bytes) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::streamoff>(file.tellg());
  file.seekg(std::max<std::streamoff>(0, size - static_cast<std::streamoff>(bytes)));
  return read_from(file, bytes);
}

}  // namespace sim
