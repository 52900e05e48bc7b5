#include "sim/text/temporary_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "sim/failure.hpp"

namespace sim {

namespace {

Failure cannot_make(const std::string& why) {
  return {ExitCode::environment,
          "cannot make a temporary folder (" + why + ") set TMPDIR to one that can be written"};
}

}  // namespace

std::filesystem::path temporary_folder() {
  const char* const named = std::getenv("TMPDIR");
  std::filesystem::path folder = named == nullptr || *named == '\0' ? "/tmp" : named;
  std::error_code ignored;
  if (std::filesystem::is_directory(folder, ignored)) return folder;
  throw cannot_make(folder.string() + " is no folder");
}

std::filesystem::path new_temporary_folder(const std::string& name_begin) {
  const std::filesystem::path in = temporary_folder();
  std::string name = (in / (name_begin + "XXXXXX")).string();
  if (::mkdtemp(name.data()) != nullptr) return name;
  throw cannot_make(in.string() + ": " + std::generic_category().message(errno));
}

}  // namespace sim
