#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/command/completion.hpp"

namespace sim {
namespace {

constexpr const char* zsh_middle = R"(  case $state in
    command) _describe -t commands command commands && ret=0 ;;
    rest)
      curcontext=${curcontext%:*:*}:cosys-sim-$line[1]:
      case $line[1] in
        help) _describe -t commands command commands && ret=0 ;;
)";

constexpr const char* zsh_end = R"(      esac
      ;;
  esac
  return ret
}

_cosys-sim "$@"
)";

std::string with_backslashes(const std::string& text, const std::string& special) {
  std::string marked;
  for (const char c : text) {
    if (c == '\\' || special.find(c) != std::string::npos) marked += '\\';
    marked += c;
  }
  return marked;
}

std::string in_quotes(const std::string& text) {
  std::string quoted;
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + quoted + "'";
}

/// Brackets around one ending would be taken for a property of files.
std::string zsh_pattern(const std::vector<std::string>& endings) {
  if (endings.empty()) return "";
  if (endings.size() == 1) return " -g \"*" + endings.front() + "\"";
  return fmt::format(" -g \"*({})\"", fmt::join(endings, "|"));
}

/// Of a value: what it is called, and what completes it.
std::string zsh_value(const std::string& called, const OptionUsage& option) {
  const std::string start = ":" + with_backslashes(called, ":") + ":";
  switch (option.kind) {
    case ValueKind::none:
      return "";
    case ValueKind::words:
    case ValueKind::some_words:
    case ValueKind::part:
      return start + fmt::format("({})", fmt::join(option.words, " "));
    case ValueKind::key:
      return start + "_cosys-sim_keys";
    case ValueKind::folder:
      return start + "_files -/";
    case ValueKind::file:
      return start + "_files" + zsh_pattern(option.endings);
    case ValueKind::free:
      break;
  }
  return start + " ";
}

/// Which may not come behind it: its own names, unless it may be repeated, and what it excludes.
std::string zsh_exclusions(const OptionUsage& option) {
  std::vector<std::string> names = option.excludes;
  if (!option.repeated) names.insert(names.end(), option.names.begin(), option.names.end());
  std::string text = option.repeated ? "*" : "";
  if (!names.empty()) text = fmt::format("({})", fmt::join(names, " ")) + text;
  return text.empty() ? "" : in_quotes(text);
}

/// '(-o --output)'{-o+,--output=}'[result file]:OUT.h5:_files -g "*(.h5)"'
std::string zsh_option(const OptionUsage& option) {
  std::vector<std::string> names = option.names;
  if (option.kind != ValueKind::none)
    for (std::string& name : names) name += name.starts_with("--") ? "=" : "+";
  const std::string typed =
      names.size() == 1 ? names.front() : fmt::format("{{{}}}", fmt::join(names, ","));
  return zsh_exclusions(option) + typed +
         in_quotes("[" + with_backslashes(option.help, "[]") + "]" +
                   zsh_value(option.value, option));
}

std::string zsh_argument(const OptionUsage& argument) {
  const std::string start = argument.repeated ? "*" : argument.required ? "" : ":";
  return in_quotes(start + zsh_value(argument.names.front(), argument));
}

std::string zsh_case_of(const CommandUsage& command) {
  std::string text = "        " + command.name + ")\n          _arguments -s";
  for (const OptionUsage& option : command.options)
    text += " \\\n            " + zsh_option(option);
  for (const OptionUsage& argument : command.arguments)
    text += " \\\n            " + zsh_argument(argument);
  return text + " && ret=0\n          ;;\n";
}

std::string zsh_commands(const std::vector<CommandUsage>& commands) {
  std::string text = "  local -a commands=(\n";
  for (const CommandUsage& command : commands)
    text += "    " + in_quotes(command.name + ":" + command.summary) + "\n";
  return text + "  )\n";
}

/// A key and =, or where these are typed the words that it may be.
std::string zsh_keys(const std::vector<KeyUsage>& keys) {
  std::string text =
      "_cosys-sim_keys() {\n  if compset -P '*='; then\n    case ${${IPREFIX%=}##*=} in\n";
  for (const KeyUsage& key : keys)
    if (!key.words.empty())
      text += fmt::format("      {}) compadd -- {} ;;\n", key.name, fmt::join(key.words, " "));
  text += "    esac\n  else\n    compadd -S = --";
  for (const KeyUsage& key : keys) text += " " + key.name;
  return text + "\n  fi\n}\n\n";
}

}  // namespace

std::string zsh_completion(const ProgramUsage& usage) {
  std::string text =
      "#compdef cosys-sim\n# Completes cosys-sim in zsh. Printed by: cosys-sim completion zsh\n\n" +
      zsh_keys(usage.keys) +
      "_cosys-sim() {\n  local curcontext=$curcontext state line ret=1\n  local -A opt_args\n" +
      zsh_commands(usage.commands) + "  _arguments -C";
  for (const OptionUsage& option : usage.program.options) text += " \\\n    " + zsh_option(option);
  text += " \\\n    '1: :->command' '*:: :->rest' && ret=0\n";
  text += zsh_middle;
  for (const CommandUsage& command : usage.commands) text += zsh_case_of(command);
  return text + zsh_end;
}

}  // namespace sim
