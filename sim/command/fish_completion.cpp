#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/command/completion.hpp"

namespace sim {
namespace {

constexpr const char* fish_head =
    R"(# Completes cosys-sim in fish. Printed by: cosys-sim completion fish

# The first word that is no option is this one; without a word: there is none yet.
function __cosys_sim_at
  for word in (commandline -opc)[2..-1]
    string match -q -- '-*' $word; and continue
    test "$word" = "$argv[1]"
    return
  end
  test -z "$argv[1]"
end

# A key and =, or where these are typed what it may be.
function __cosys_sim_keys
  switch (string replace -r '^--[a-z-]+=' '' -- (commandline -ct))
)";

constexpr const char* any_file = " -F";

/// In single quotes fish takes a backslash for itself before another one and before a quote alone.
std::string in_fish_quotes(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\\' || c == '\'') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

std::string fish_keys(const std::vector<KeyUsage>& keys) {
  std::string text, starts;
  for (const KeyUsage& key : keys) {
    starts += " " + key.name;
    if (!key.words.empty())
      text += fmt::format("    case '{0}=*'\n      printf '{0}=%s\\n' {1}\n", key.name,
                          fmt::join(key.words, " "));
  }
  return text + "    case '*=*'\n    case '*'\n      printf '%s=\\n'" + starts + "\n  end\nend\n\n";
}

/// What completes a value; nothing where nothing is known of it.
std::string fish_value(const OptionUsage& option) {
  switch (option.kind) {
    case ValueKind::words:
    case ValueKind::some_words:
    case ValueKind::part:
      return " -a " + in_fish_quotes(fmt::format("{}", fmt::join(option.words, " ")));
    case ValueKind::key:
      return " -a '(__cosys_sim_keys)'";
    case ValueKind::folder:
      return " -a '(__fish_complete_directories)'";
    case ValueKind::file:
      if (option.endings.empty()) return any_file;
      return fmt::format(" -k -a '(__fish_complete_suffix {})'", fmt::join(option.endings, " "));
    case ValueKind::none:
    case ValueKind::free:
      break;
  }
  return "";
}

/// A line that counts where this command has been typed, or none.
std::string fish_line(const std::string& command, const std::string& rest) {
  return "complete -c cosys-sim -n '__cosys_sim_at " + command + "'" + rest + "\n";
}

std::string fish_option(const std::string& command, const OptionUsage& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  const std::string value = fish_value(option), only = value == any_file ? "" : " -f";
  const std::string needed = option.kind == ValueKind::none ? "" : " -r" + only + value;
  return fish_line(command, names + needed + " -d " + in_fish_quotes(option.help));
}

/// A command's first argument of which something is known stands for all of them.
std::string fish_command(const CommandUsage& command) {
  std::string text;
  for (const OptionUsage& option : command.options) text += fish_option(command.name, option);
  for (const OptionUsage& argument : command.arguments)
    if (const std::string value = fish_value(argument); !value.empty())
      return text + fish_line(command.name, value);
  return text;
}

std::string fish_names(const std::vector<CommandUsage>& commands, const std::string& behind) {
  std::string text;
  for (const CommandUsage& command : commands)
    text += fish_line(behind, " -a " + command.name + " -d " + in_fish_quotes(command.summary));
  return text;
}

}  // namespace

std::string fish_completion(const ProgramUsage& usage) {
  std::string text = fish_head + fish_keys(usage.keys) + "complete -c cosys-sim -f\n";
  for (const OptionUsage& option : usage.program.options) text += fish_option("", option);
  text += fish_names(usage.commands, "") + fish_line("", " -a help -d 'Say how a command is used'");
  text += fish_names(usage.commands, "help");
  for (const CommandUsage& command : usage.commands) text += fish_command(command);
  return text;
}

}  // namespace sim
