#include "sim/command/help_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "sim/failure.hpp"
#include "sim/text/list_text.hpp"

namespace sim {
namespace {

constexpr std::size_t help_width = 80, option_column = 26, command_column = 14;

/// What options are for: they are listed under that.
struct OptionGroup {
  std::string_view heading, names;
};

/// The first one has all that none of the others names.
constexpr std::array<OptionGroup, 4> option_groups{
    {{"What", ""},
     {"How long", "--threads --max-frames --time-budget --minutes --duration --tolerance"},
     {"Where to", "--output --json --quiet --page --svg --png --pdf --junit --summary"},
     {"Rarely needed",
      "--method --rel-ci --target-flr --max-frame-errors --shard --profile --plot --table "
      "--point --format --sample-rate --time-unit --skip-rows --sample-bytes --ambient --drive "
      "--message "
      "--polarity "
      "--decoder-mode --decoder-output --decoder-timeout --golden --minimise --alpha --power "
      "--negligible --drop-framing-errors --led-current-ma --led-yaw-deg --floor --height-mm "
      "--version --help --help-all"}}};

const OptionGroup& group_of(const OptionUsage& option) {
  for (const OptionGroup& group : option_groups)
    for (const std::string_view name : split(group.names, ' '))
      if (name == option.names.back()) return group;
  return option_groups.front();
}

/// From a column on; lines behind the first begin at `indent`. A longer word is not broken.
std::string wrapped(std::string_view text, std::size_t column, std::size_t indent,
                    std::string_view line_end = "") {
  std::string lines;
  for (const std::string_view word : split(text, ' ')) {
    if (word.empty()) continue;
    if (!lines.empty()) {
      const bool fits = column + 1 + word.size() + line_end.size() <= help_width;
      lines += fits ? " " : fmt::format("{}\n{:{}}", line_end, "", indent);
      column = fits ? column + 1 : indent;
    }
    lines += word;
    column += word.size();
  }
  return lines + "\n";
}

std::string help_row(const std::string& tag, const std::string& text, std::size_t column) {
  const std::string begin = "  " + tag;
  const std::string words = wrapped(text, column, column);
  if (begin.size() + 2 <= column) return fmt::format("{:{}}{}", begin, column, words);
  return fmt::format("{}\n{:{}}{}", begin, "", column, words);
}

/// "-o, --output OUT.h5"
std::string tag_of(const OptionUsage& option) {
  const std::string names = fmt::format("{}", fmt::join(option.names, ", "));
  return option.value.empty() ? names : names + " " + option.value;
}

std::string usage_line(const std::string& program, const CommandUsage& command) {
  std::string line = command.name.empty() ? program + " COMMAND" : program + " " + command.name;
  for (const OptionUsage& argument : command.arguments) {
    const std::string name = argument.names.front() + (argument.repeated ? "..." : "");
    line += argument.required ? " " + name : " [" + name + "]";
  }
  for (const OptionUsage& option : command.options)
    if (option.required) line += " " + option.names.back() + " " + option.value;
  constexpr std::string_view begin = "Usage: ";
  return std::string(begin) + wrapped(line + " [OPTIONS]", begin.size(), begin.size());
}

std::string example_lines(const std::vector<std::string>& examples) {
  if (examples.empty()) return "";
  std::string lines = examples.size() == 1 ? "Example:\n" : "Examples:\n";
  for (const std::string& example : examples) lines += "  " + wrapped(example, 2, 6, " \\");
  return lines + "\n";
}

std::string help_section(std::string_view heading, const std::string& rows) {
  return rows.empty() ? "" : fmt::format("\n{}:\n{}", heading, rows);
}

std::string argument_rows(const CommandUsage& command) {
  std::string rows;
  for (const OptionUsage& argument : command.arguments)
    rows += help_row(argument.names.front(), option_text(argument), option_column);
  return rows;
}

/// The whole help also says which options do not go together.
std::string option_rows(const CommandUsage& command, const OptionGroup& group, bool all) {
  std::string rows;
  for (const OptionUsage& option : command.options)
    if (&group_of(option) == &group)
      rows += help_row(tag_of(option), all ? option_text(option) : option.help, option_column);
  return rows;
}

/// Their names alone.
std::string rarely_needed(const CommandUsage& command) {
  std::vector<std::string> names;
  for (const OptionUsage& option : command.options)
    if (&group_of(option) == &option_groups.back() && !option.names.back().starts_with("--help"))
      names.push_back(option.names.back());
  if (names.empty()) return "";
  const std::string list = fmt::format("{}", fmt::join(names, ", "));
  return "\n" + wrapped("Rarely needed (see --help-all): " + list, 0, 2);
}

std::string option_sections(const CommandUsage& command, bool all) {
  std::string text;
  for (const OptionGroup& group : option_groups) {
    const bool is_rare = &group == &option_groups.back();
    text += is_rare && !all ? rarely_needed(command)
                            : help_section(group.heading, option_rows(command, group, all));
  }
  return text;
}

std::string command_rows(const ProgramUsage& usage) {
  std::string rows;
  for (const CommandUsage& command : usage.commands)
    rows += help_row(command.name, command.summary, command_column);
  return rows;
}

std::string help_of_program(const ProgramUsage& usage) {
  const CommandUsage& program = usage.program;
  std::string rows;
  for (const OptionUsage& option : program.options)
    rows += help_row(tag_of(option), option_text(option), option_column);
  return wrapped(program.summary, 0, 0) + "\n" + example_lines(program.examples) +
         usage_line(program.name, {}) + help_section("Commands", command_rows(usage)) +
         help_section("Options", rows);
}

}  // namespace

std::string help_text(const ProgramUsage& usage, const std::string& command, bool all) {
  if (command.empty()) return help_of_program(usage);
  const auto found = std::ranges::find(usage.commands, command, &CommandUsage::name);
  if (found == usage.commands.end())
    throw bad_input(command, "no such command", "see cosys-sim --help");
  const std::string notes = found->notes.empty() ? "" : "\n" + wrapped(found->notes, 0, 0);
  return wrapped(found->summary + ".", 0, 0) + "\n" + example_lines(found->examples) +
         usage_line(usage.program.name, *found) + help_section("Arguments", argument_rows(*found)) +
         option_sections(*found, all) + notes;
}

}  // namespace sim
