#pragma once
// What the command line offers, as plain data: help, completions and the manual page are written
// from it.
#include <string>
#include <vector>

namespace sim {

enum class ValueKind {
  none,        // that of a flag
  free,        // of which nothing is known
  words,       // one of a few
  some_words,  // one of a few, or another
  key,         // a key of a scenario, =, and what it is to be
  part,        // one of a folder of parts, or another
  file,
  folder
};

/// An option, or an argument: that has one name, which nobody types.
struct OptionUsage {
  std::vector<std::string> names;  // "-o", "--output"; "SCENARIO"
  std::string value;               // "OUT.h5"; empty of flags and arguments
  std::string help;
  ValueKind kind = ValueKind::free;
  std::vector<std::string> words;     // of both kinds of words; the folders of parts: "modules"
  std::vector<std::string> endings;   // of files, those that the help names: ".toml"; none: all
  std::vector<std::string> excludes;  // names of options that it cannot go with
  bool required = false;
  bool repeated = false;  // may be given several times
};

/// Its help, and what that leaves out: words of a choice, and options that it does not go with.
std::string option_text(const OptionUsage& option);

struct CommandUsage {
  std::string name, summary;
  std::string notes;                  // behind its options
  std::vector<std::string> examples;  // "cosys-sim parts TSOP4856"
  std::vector<OptionUsage> arguments, options;
};

/// A key of a scenario.
struct KeyUsage {
  std::string name;
  std::vector<std::string> words;  // that it may be; none: a number or any text
};

struct ProgramUsage {
  CommandUsage program;  // what it takes before a command
  std::vector<CommandUsage> commands;
  std::vector<KeyUsage> keys = {};  // filled for completions alone
};

}  // namespace sim
