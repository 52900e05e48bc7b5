#include "sim/text/existing_file.hpp"

#include <fstream>

#include "sim/failure.hpp"

namespace sim {

namespace fs = std::filesystem;

std::string beginning_of(const fs::path& path, std::size_t bytes) {
  std::ifstream file(path, std::ios::binary);
  std::string head(bytes, '\0');
  file.read(head.data(), static_cast<std::streamsize>(bytes));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

void refuse_to_lose(const fs::path& path, bool (*is_own)(const fs::path&),
                    const std::string& own_kind) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) == 0 || is_own(path)) return;
  throw bad_input("cannot write " + path.string(), "it exists and is not " + own_kind,
                  "choose another name");
}

}  // namespace sim
