#include "sim/command/manual_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "sim/failure.hpp"
#include "sim/text/list_text.hpp"

namespace sim {
namespace {

/// What troff would take for its own is spelt out; hyphens are those that people type.
std::string troff_word(std::string_view word) {
  constexpr std::string_view special = "\\-'`^~";
  constexpr std::array spelt{"\\e", "\\-", "\\(aq", "\\(ga", "\\(ha", "\\(ti"};
  std::string text;
  for (const char c : word) {
    const std::size_t which = special.find(c);
    text += which == std::string_view::npos ? std::string(1, c) : spelt[which];
  }
  return text;
}

/// In lines of at most 78 bytes where words allow it, none of which begins like a request.
std::string troff_text(const std::string& text) {
  std::string lines;
  std::size_t column = 0;
  for (const std::string_view word : split(text, ' ')) {
    const std::string next = troff_word(word);
    if (next.empty()) continue;
    const bool fits = column > 0 && column + 1 + next.size() <= 78;
    if (column > 0) lines += fits ? ' ' : '\n';
    if (!fits && next.front() == '.') lines += "\\&";
    column = (fits ? column + 1 : 0) + next.size();
    lines += next;
  }
  return lines + "\n";
}

std::string bold(const std::string& text) { return "\\fB" + troff_word(text) + "\\fR"; }

std::string italic(const std::string& text) { return "\\fI" + troff_word(text) + "\\fR"; }

std::string section(const std::string& name) { return ".SH " + name + "\n"; }

std::string item(const std::string& tag, const std::string& text) {
  return ".TP\n" + tag + "\n" + troff_text(text);
}

/// "-o, --output OUT.h5"
std::string option_tag(const OptionUsage& option) {
  std::string tag;
  for (const std::string& name : option.names) tag += (tag.empty() ? "" : ", ") + bold(name);
  return option.value.empty() ? tag : tag + " " + italic(option.value);
}

/// "cosys-sim trace SCENARIO -o FILE [OPTION ...]"
std::string command_line_of(const std::string& program, const CommandUsage& command) {
  std::string line = bold(program) + " " + bold(command.name);
  for (const OptionUsage& argument : command.arguments) {
    const std::string name = italic(argument.names.front()) + (argument.repeated ? " ..." : "");
    line += argument.required ? " " + name : " [" + name + "]";
  }
  for (const OptionUsage& option : command.options)
    if (option.required) line += " " + bold(option.names.front()) + " " + italic(option.value);
  return line + " [" + italic("OPTION") + " ...]\n";
}

std::string examples_in_words(const CommandUsage& command) {
  return fmt::format("{}: {}", command.examples.size() == 1 ? "Example" : "Examples",
                     fmt::join(command.examples, "; "));
}

std::string command_section(const std::string& program, const CommandUsage& command) {
  std::string text = ".SS " + troff_word(command.name) + "\n" + command_line_of(program, command);
  text += ".PP\n" + troff_text(command.summary + ".");
  for (const OptionUsage& argument : command.arguments)
    text += item(italic(argument.names.front()), option_text(argument));
  for (const OptionUsage& option : command.options)
    if (option.names.back() != "--help")  // said once, of all commands
      text += item(option_tag(option), option_text(option));
  if (!command.notes.empty()) text += ".PP\n" + troff_text(command.notes);
  return command.examples.empty() ? text : text + ".PP\n" + troff_text(examples_in_words(command));
}

std::string exit_status() {
  const auto of = [](ExitCode code, const std::string& text) {
    return item(bold(std::to_string(static_cast<int>(code))), text);
  };
  return section("EXIT STATUS") + of(ExitCode::done, "Done.") +
         of(ExitCode::check_failed, "A check failed, or what was compared is different.") +
         of(ExitCode::bad_input, "Wrong usage or wrong input.") +
         of(ExitCode::environment, "The machine failed: no room, no permission, a missing tool.") +
         of(ExitCode::inconclusive, "Done, but the question is still open.") +
         of(ExitCode::interrupted, "Interrupted by a signal.");
}

std::string description(const ProgramUsage& usage) {
  return section("DESCRIPTION") +
         troff_text(
             usage.program.summary +
             ". A message goes from the LED through the light and the receiver module to decoded "
             "frames; counted are wrong bits and lost frames. A scenario, a TOML file, says what "
             "is simulated. A table of the points goes to standard output, progress to standard "
             "error, and all counts to an HDF5 file. What goes wrong is said in one line: "
             "the problem, in brackets why, and what to do.") +
         ".PP\n" +
         troff_text(
             "Equal scenarios and seeds give equal counts on any machine, with any number "
             "of threads.");
}

std::string files(const std::string& program) {
  const std::string folder = "PREFIX/share/" + program;
  return section("FILES") +
         troff_text(
             "PREFIX is the folder of which bin/ has the program: /usr for that of a package.") +
         item(italic(folder + "/*.toml"), "Scenarios to begin with: quickstart.toml first.") +
         item(italic(folder + "/KEYS.md"), "All keys of a scenario.") +
         item(italic(folder + "/modules/") + ", " + italic("leds/") + ", " + italic("floors/") +
                  ", " + italic("photodiodes/"),
              "The parts, each number with its source. What is in folders of these names beside a "
              "scenario, or in a folder that --parts names, comes before them.") +
         item(italic(folder + "/sigrok/"), "The decoder for sigrok and PulseView.");
}

std::string see_also() {
  return section("SEE ALSO") + "\\fBgnuplot\\fR(1), \\fBmpirun\\fR(1), \\fBncdump\\fR(1), " +
         "\\fBsigrok\\-cli\\fR(1)\n";
}

}  // namespace

std::string manual_page(const ProgramUsage& usage, const std::string& version,
                        const std::string& date) {
  const std::string& program = usage.program.name;
  std::string name = program;
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
  std::string text = ".TH " + troff_word(name) + " 1 \"" + date + "\" \"" + troff_word(program) +
                     " " + version + "\" \"User Commands\"\n.nh\n.ad l\n";
  text += section("NAME") + troff_word(program) + " \\- simulate infrared links bit by bit\n";
  text += section("SYNOPSIS") + bold(program) + " " + italic("COMMAND") + " [" +
          italic("ARGUMENT") + " ...]\n.br\n" + bold(program) + " " + bold("help") + " [" +
          italic("COMMAND") + "]\n";
  text += description(usage) + section("OPTIONS");
  for (const OptionUsage& option : usage.program.options)
    text += item(option_tag(option), option_text(option));
  text += section("COMMANDS") + troff_text("Each of them takes -h, --help too.");
  for (const CommandUsage& command : usage.commands) text += command_section(program, command);
  return text + exit_status() + files(program) + see_also();
}

}  // namespace sim
