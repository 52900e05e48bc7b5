#include "sim/check/gate_files.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "sim/check/gate_templates.hpp"
#include "sim/text/existing_file.hpp"
#include "sim/text/list_text.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view gate_head = "# Receiver gate: ";
constexpr const char* gitlab_file = ".gitlab-ci.yml";

void replace_all(std::string& text, std::string_view name, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; at += by.size())
    text.replace(at, name.size(), by);
}

/// Each line as far in as a block of YAML has it.
std::string indented(std::string_view text, std::size_t columns) {
  std::string lines;
  for (const std::string_view line : split(text, '\n'))
    if (!line.empty()) lines += std::string(columns, ' ') + std::string(line) + "\n";
  lines.pop_back();
  return lines;
}

/// What a clone can be asked for: a commit without what was not committed.
std::string commit_of(const ProgramInfo& program) {
  return program.commit.substr(0, program.commit.find('-'));
}

/// A text of YAML that begins with no sign of its own.
std::string quoted_yaml(std::string text) {
  replace_all(text, "'", "''");
  return "'" + text + "'";
}

std::string filled(std::string_view form, const GateCommand& command, std::size_t columns) {
  std::string text(form);
  replace_all(text, "@INSTALL@", indented(gate_install, columns));
  replace_all(text, "@CHECK@", command.check);
  replace_all(text, "@BUILD@", quoted_yaml(command.build));
  replace_all(text, "@VERSION@", command.program.version);
  replace_all(text, "@COMMIT@", commit_of(command.program));
  return text;
}

}  // namespace

std::vector<WholeFile> gate_files(const GateCommand& command, const fs::path& folder) {
  const fs::path gitlab = gitlab_file, included = ".gitlab/receiver-gate.yml";
  const bool is_free = !fs::exists(folder / gitlab) || is_gate_file(folder / gitlab);
  return {{".github/workflows/receiver-gate.yml", filled(gate_github, command, 10)},
          {is_free ? gitlab : included, filled(gate_gitlab, command, 6)}};
}

std::string gate_hint(const std::vector<WholeFile>& files) {
  std::string text;
  if (files.back().place != gitlab_file)
    text += fmt::format("{} has jobs of its own: add a line there, include: {}\n", gitlab_file,
                        files.back().place.string());
  return text +
         "commit these, the baseline and the scenarios; where the server finds cosys-sim, say by "
         "its variable COSYS_SIM_DEB (package) or COSYS_SIM_SOURCE (git repository)\n";
}

bool is_gate_file(const fs::path& path) {
  return beginning_of(path, gate_head.size()) == gate_head;
}

std::string build_command(const fs::path& folder) {
  constexpr std::pair<const char*, const char*> known[] = {
      {"Makefile", "make"},
      {"CMakeLists.txt", "cmake -B build && cmake --build build"},
      {"meson.build", "meson setup build && meson compile -C build"},
      {"Cargo.toml", "cargo build --release"}};
  for (const auto& [file, command] : known)
    if (fs::exists(folder / file)) return command;
  return ":";
}

}  // namespace sim
