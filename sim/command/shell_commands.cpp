#include <algorithm>

#include "sim/command/commands.hpp"
#include "sim/command/completion.hpp"
#include "sim/command/manual_page.hpp"
#include "sim/components/part_slot.hpp"
#include "sim/report/part_sheet.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/text/letters.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

using Names = std::vector<std::string>;

/// A part as it is written, and the folder that it is in.
struct NamedPart {
  std::string name, folder;
};

/// Its file's name in the letters in which the part writes it: TSOP4856, though any will do.
NamedPart named_part(const PartFile& file, const PartRoots& folders) {
  const std::string written = read_part_sheet(file, folders, Compare::no).name;
  const bool is_same = in_lower_case(written) == in_lower_case(file.name);
  return {is_same ? written : file.name, file.path.parent_path().filename()};
}

Names names_in(const std::vector<NamedPart>& parts, const Names& folders) {
  Names names;
  for (const NamedPart& part : parts)
    if (std::ranges::find(folders, part.folder) != folders.end()) names.push_back(part.name);
  return names;
}

std::vector<KeyUsage> key_usages(const std::vector<NamedPart>& parts) {
  std::vector<KeyUsage> keys;
  for (const Key& key : scenario_keys()) {
    const bool is_part = key.facts.type == KeyType::part;
    keys.push_back(
        {key.name(), is_part ? names_in(parts, {part_slot(key.name()).folder}) : key.choices});
  }
  return keys;
}

/// Names of parts in place of their folders.
void take_names(const std::vector<NamedPart>& parts, std::vector<OptionUsage>& options) {
  for (OptionUsage& option : options)
    if (option.kind == ValueKind::part) option.words = names_in(parts, option.words);
}

}  // namespace

ExitCode completion_command(const CompletionRequest& request, ProgramUsage usage) {
  std::vector<NamedPart> parts;
  for (const PartFile& file : list_parts(request.parts))
    parts.push_back(named_part(file, request.parts));
  usage.keys = key_usages(parts);
  for (CommandUsage& command : usage.commands) {
    take_names(parts, command.options);
    take_names(parts, command.arguments);
  }
  const bool is_bash = request.shell == "bash", is_zsh = request.shell == "zsh";
  print(is_bash ? bash_completion(usage) : is_zsh ? zsh_completion(usage) : fish_completion(usage));
  return ExitCode::done;
}

ExitCode manual_command(const ManualRequest& request, const ProgramUsage& usage) {
  print(manual_page(usage, request.program.version, request.date));
  return ExitCode::done;
}

}  // namespace sim
