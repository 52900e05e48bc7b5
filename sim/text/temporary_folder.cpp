#include "sim/text/temporary_folder.hpp"

#include <cstdlib>
#include <string>

#include "sim/failure.hpp"

namespace sim {

std::filesystem::path temporary_folder() {
  const char* const named = std::getenv("TMPDIR");
  std::filesystem::path folder = named == nullptr || *named == '\0' ? "/tmp" : named;
  std::error_code ignored;
  if (std::filesystem::is_directory(folder, ignored)) return folder;
  throw Failure(ExitCode::environment, "cannot make a temporary file (" + folder.string() +
                                           " is no folder) set TMPDIR to one that can be written");
}

}  // namespace sim
