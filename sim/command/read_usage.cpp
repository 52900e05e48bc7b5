#include "sim/command/read_usage.hpp"

#include <algorithm>

#include "sim/text/list_text.hpp"

namespace sim {
namespace {

std::vector<std::string> option_names(const CLI::Option& option) {
  if (option.get_positional()) return {option.get_name(true)};
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// "-o,--output OUT.h5" names ".h5", and so does "a file (.h5)", but "0.5" and "report.html" do
/// not.
std::vector<std::string> endings_in(const std::string& text) {
  constexpr const char* letters = "abcdefghijklmnopqrstuvwxyz0123456789-";
  std::vector<std::string> endings;
  for (std::size_t at = text.find('.'); at != std::string::npos; at = text.find('.', at + 1)) {
    const bool starts_a_word = at == 0 || text[at - 1] == ' ' || text[at - 1] == '(';
    const std::string ending = text.substr(at, text.find_first_not_of(letters, at + 1) - at);
    if (starts_a_word && ending.size() > 1 && std::ranges::find(endings, ending) == endings.end())
      endings.push_back(ending);
  }
  return endings;
}

void describe_place(OptionUsage& usage) {
  usage.kind = usage.value == "DIR" ? ValueKind::folder : ValueKind::file;
  const std::size_t ending = std::min(usage.value.find('.'), usage.value.size());
  usage.endings = endings_in(usage.value.substr(ending) + " " + usage.help);
}

/// By the name of a check.
void describe_value(OptionUsage& usage, const std::string& check) {
  const std::vector<std::string_view> words = split(check, ' ');
  if (words.front() == place_check) return describe_place(usage);
  if (words.front() == words_check)
    usage.kind = ValueKind::words;
  else if (words.front() == some_words_check)
    usage.kind = ValueKind::some_words;
  else if (words.front() == key_check)
    usage.kind = ValueKind::key;
  else if (words.front() == part_check)
    usage.kind = ValueKind::part;
  else
    return;
  usage.words.assign(words.begin() + 1, words.end());
}

std::vector<std::string> check_names(CLI::Option& option) {
  std::vector<std::string> names;
  try {
    while (true) names.push_back(option.get_validator(static_cast<int>(names.size()))->get_name());
  } catch (const CLI::OptionNotFound&) {
    return names;  // CLI11 does not say how many there are
  }
}

bool may_be_repeated(const CLI::Option& option) {
  if (option.get_positional()) return option.get_items_expected_max() > 1;
  return option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
}

OptionUsage option_usage(CLI::Option& option) {
  OptionUsage usage;
  usage.names = option_names(option);
  usage.help = option.get_description();
  usage.required = option.get_required();
  usage.repeated = may_be_repeated(option);
  if (option.get_items_expected_max() == 0)
    usage.kind = ValueKind::none;
  else if (!option.get_positional())
    usage.value = option.get_type_name();
  for (const std::string& check : check_names(option)) describe_value(usage, check);
  for (const CLI::Option* other : option.get_excludes())
    for (const std::string& name : option_names(*other)) usage.excludes.push_back(name);
  std::ranges::sort(usage.excludes);  // CLI11 has them by their addresses
  return usage;
}

/// A footer is notes, then "Example: COMMAND" or "Examples: COMMAND; COMMAND".
void take_footer(const std::string& footer, CommandUsage& usage) {
  const std::size_t place = std::min(footer.find("Example"), footer.size());
  usage.notes = trimmed(footer.substr(0, place));
  const std::size_t colon = footer.find(": ", place);
  if (colon == std::string::npos) return;
  for (const std::string_view example : split(std::string_view(footer).substr(colon + 2), ';'))
    usage.examples.emplace_back(trimmed(example));
}

CommandUsage command_usage(CLI::App& command) {
  CommandUsage usage;
  usage.name = command.get_name();
  usage.summary = command.get_description();
  take_footer(command.get_footer(), usage);
  for (CLI::Option* option : command.get_options())
    (option->get_positional() ? usage.arguments : usage.options).push_back(option_usage(*option));
  return usage;
}

}  // namespace

ProgramUsage usage_of(CLI::App& app) {
  ProgramUsage usage;
  usage.program = command_usage(app);
  for (CLI::App* command : app.get_subcommands(nullptr))
    usage.commands.push_back(command_usage(*command));
  return usage;
}

}  // namespace sim
