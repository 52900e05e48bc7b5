#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "sim/command/completion.hpp"
#include "sim/text/shell_text.hpp"

namespace sim {
namespace {

/// What each command's lines below call, and how the current word is found.
constexpr const char* bash_head = R"(# shellcheck shell=bash
# Completes cosys-sim in bash. Printed by: cosys-sim completion bash

# Those of the words that go on as the current one does.
_cosys_sim_words() {
  mapfile -t COMPREPLY < <(compgen -W "$*" -- "$word")
}

# Folders, and files with one of the endings.
_cosys_sim_files() {
  local ending
  compopt -o filenames -o default 2>/dev/null
  mapfile -t COMPREPLY < <(
    compgen -d -- "$word"
    for ending; do compgen -f -X "!*$ending" -- "$word"; done
  )
}

_cosys_sim_folders() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$word")
}

)";

constexpr const char* bash_middle = R"(
_cosys_sim() {
  local word=${COMP_WORDS[COMP_CWORD]} at=$((COMP_CWORD - 1)) key='' before command='' i
  COMPREPLY=()
  # Bash takes --output=x for three words, and --set key=x for four.
  if [[ $word == = ]]; then
    word=''
    ((++at))
  fi
  if [[ ${COMP_WORDS[at]} == = ]]; then
    ((--at))
    if [[ ${COMP_WORDS[at]} != -* ]]; then
      key=${COMP_WORDS[at]}
      ((--at))
      [[ ${COMP_WORDS[at]} != = ]] || ((--at))
    fi
  fi
  before=${COMP_WORDS[at]}
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == -* ]] || {
      command=${COMP_WORDS[i]}
      break
    }
  done
)";

constexpr const char* bash_end = R"(  esac
}

complete -F _cosys_sim cosys-sim
)";

std::string bash_words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += " " + shell_word(word);
  return text;
}

/// What completes a value; empty where nothing is known of it.
std::string bash_action(const OptionUsage& option) {
  switch (option.kind) {
    case ValueKind::words:
    case ValueKind::some_words:
    case ValueKind::part:
      return "_cosys_sim_words" + bash_words(option.words);
    case ValueKind::key:
      return "_cosys_sim_keys";
    case ValueKind::file:
      return "_cosys_sim_files" + (option.endings.empty() ? " ''" : bash_words(option.endings));
    case ValueKind::folder:
      return "_cosys_sim_folders";
    case ValueKind::none:
    case ValueKind::free:
      break;
  }
  return "";
}

std::vector<std::string> all_names(const std::vector<OptionUsage>& options) {
  std::vector<std::string> names;
  for (const OptionUsage& option : options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

/// What comes where no option waits for its value: an option, or what `otherwise` completes.
std::string bash_next_word(const std::vector<OptionUsage>& options, const std::string& otherwise) {
  std::string names = "_cosys_sim_words" + bash_words(all_names(options));
  if (otherwise.empty()) return names;
  return "if [[ $word == -* ]]; then " + names + "; else " + otherwise + "; fi";
}

std::string bash_case_of(const CommandUsage& command) {
  std::string text = "    " + command.name + ")\n      case $before in\n";
  std::vector<std::string> unknown;  // names of options of whose values nothing is known
  for (const OptionUsage& option : command.options)
    if (option.kind == ValueKind::free)
      unknown.insert(unknown.end(), option.names.begin(), option.names.end());
    else if (option.kind != ValueKind::none)
      text +=
          fmt::format("        {}) {} ;;\n", fmt::join(option.names, " | "), bash_action(option));
  if (!unknown.empty()) text += fmt::format("        {}) ;;\n", fmt::join(unknown, " | "));
  std::string action;
  for (const OptionUsage& argument : command.arguments)
    if (action.empty()) action = bash_action(argument);
  return text + "        *) " + bash_next_word(command.options, action) +
         " ;;\n      esac\n      ;;\n";
}

/// A key and =, or where these are typed the words that it may be.
std::string bash_keys(const std::vector<KeyUsage>& keys) {
  std::vector<std::string> starts;
  for (const KeyUsage& key : keys) starts.push_back(key.name + "=");
  std::string text = "_cosys_sim_keys() {\n  case $key in\n    '')\n";
  text += "      compopt -o nospace 2>/dev/null\n      _cosys_sim_words" + bash_words(starts) +
          "\n      ;;\n";
  for (const KeyUsage& key : keys)
    if (!key.words.empty())
      text += fmt::format("    {}) _cosys_sim_words{} ;;\n", key.name, bash_words(key.words));
  return text + "  esac\n}\n";
}

/// Names of all options that take a key.
std::set<std::string> options_of_keys(const ProgramUsage& usage) {
  std::set<std::string> names;
  for (const CommandUsage& command : usage.commands)
    for (const OptionUsage& option : command.options)
      if (option.kind == ValueKind::key) names.insert(option.names.begin(), option.names.end());
  return names;
}

}  // namespace

std::string bash_completion(const ProgramUsage& usage) {
  std::vector<std::string> names;
  for (const CommandUsage& command : usage.commands) names.push_back(command.name);
  const std::string commands = "_cosys_sim_words" + bash_words(names);
  std::string text = bash_head + bash_keys(usage.keys) + bash_middle;
  text += fmt::format("  [[ -z $key || $before == @({}) ]] || return 0\n  case $command in\n",
                      fmt::join(options_of_keys(usage), "|"));
  text += "    '') " + bash_next_word(usage.program.options, commands + " help") + " ;;\n";
  text += "    help) " + commands + " ;;\n";
  for (const CommandUsage& command : usage.commands) text += bash_case_of(command);
  return text + bash_end;
}

}  // namespace sim
