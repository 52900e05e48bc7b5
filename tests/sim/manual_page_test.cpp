// The manual page: it has what the help has, a reader of such pages finds nothing wrong, and shows
// each text as it was written.
#include <regex>

#include "program.hpp"
#include "sim/command/manual_page.hpp"

namespace {

class Manual : public CommandLine {
 protected:
  /// As a terminal shows it, in lines as long as it takes; a letter over itself is a bold one.
  std::string shown(const std::string& page) const {
    write("page.1", page);
    const std::string text = tool("mandoc", {"-Tascii", "-Owidth=1000", "page.1"});
    return std::regex_replace(text, std::regex(".\b"), "");
  }

  /// The options of a command's help, each with its value: "-o, --output OUT.h5|DIR/".
  std::vector<std::string> options_of(const std::string& command) const {
    const std::string help = program({command, "--help-all"}).out;
    const std::regex option("^  (-[^\n]*?)(  [^\n]*)?$", std::regex::multiline);
    std::vector<std::string> options;
    for (std::sregex_iterator it(help.begin(), help.end(), option), end; it != end; ++it)
      options.push_back((*it)[1].str());
    return options;
  }
};

/// From a title on to the next.
std::string section_of(const std::string& page, const std::string& title) {
  const std::size_t start = page.find("\n   " + title + "\n");
  if (start == std::string::npos) return "";
  const std::string rest = page.substr(start + 1);
  std::smatch next;
  return std::regex_search(rest, next, std::regex("\n(   )?[A-Za-z]")) ? next.prefix().str() : rest;
}

TEST_F(Manual, HasEachCommandWithItsOptions) {
  const std::string page = shown(program({"manual"}).out);
  for (const char* title : {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "COMMANDS", "EXIT STATUS",
                            "FILES", "SEE ALSO"})
    EXPECT_NE(page.find("\n" + std::string(title) + "\n"), std::string::npos) << title;
  for (const std::string command : {"run", "decode", "check", "serve", "completion"}) {
    const std::string section = section_of(page, command);
    const std::vector<std::string> options = options_of(command);
    EXPECT_GT(options.size(), command == "completion" ? 0U : 2U) << command;
    for (const std::string& option : options)
      EXPECT_TRUE(option == "-h, --help" || section.find("\n       " + option) != std::string::npos)
          << option << " in\n"
          << section;
  }
}

TEST_F(Manual, IsFreeOfFaults) {
  write("page.1", program({"manual"}).out);
  const std::string said = start_tool("mandoc", {"-Tlint", "page.1"}).finish().out;
  // Where there is no git, nobody knows the date.
  EXPECT_EQ(std::regex_replace(said, std::regex("[^\n]*missing date[^\n]*\n"), ""), "");
}

TEST_F(Manual, ShowsTextsAsTheyAre) {
  const std::string help = ".vcd 'or' \\fB and \\n, `such` ^ ~ \"x\" --y a-b .";
  sim::OptionUsage option{.names = {"-o", "--out-put"},
                          .value = "'A'|.B",
                          .help = help,
                          .kind = sim::ValueKind::words,
                          .words = {"or", "never-said"},
                          .endings = {},
                          .excludes = {"--other", "-x"}};
  sim::CommandUsage command{.name = "write",
                            .summary = ".TP is written",
                            .notes = "'quoted' at last",
                            .examples = {},
                            .arguments = {},
                            .options = {option}};
  sim::CommandUsage program{.name = "cosys-sim",
                            .summary = "S",
                            .notes = "",
                            .examples = {},
                            .arguments = {},
                            .options = {}};
  const std::string page =
      shown(sim::manual_page({.program = program, .commands = {command}}, "1.2.3", "2024-05-31"));
  const std::vector<std::string> texts = {
      "-o, --out-put 'A'|.B\n", help + "; one of or, never-said; not with --other\n",
      ".TP is written.\n", "'quoted' at last\n", "cosys-sim 1.2.3"};
  for (const std::string& text : texts)
    EXPECT_NE(page.find(text), std::string::npos) << text << "\n" << page;
}

}  // namespace
