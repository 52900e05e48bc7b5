#pragma once
// A check in a firmware's own repository: the workflows that install the program, run the check,
// and show its report, for GitHub Actions and GitLab CI.
#include <filesystem>
#include <string>
#include <vector>

#include "sim/program_info.hpp"
#include "sim/text/new_file.hpp"

namespace sim {

struct GateCommand {
  std::string check;  // for a shell in the repository's folder
  std::string build;  // what builds the decoder
  ProgramInfo program;
};

/// GitLab reads .gitlab-ci.yml alone: where the repository in `folder` has one of its own, the file
/// is another, to be included there.
std::vector<WholeFile> gate_files(const GateCommand& command, const std::filesystem::path& folder);

/// What is left to do, some lines.
std::string gate_hint(const std::vector<WholeFile>& files);

/// Whether such a file was written by it.
bool is_gate_file(const std::filesystem::path& path);

/// "make", if there is a Makefile, or such; of nothing that is known ":".
std::string build_command(const std::filesystem::path& folder);

}  // namespace sim
