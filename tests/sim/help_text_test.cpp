// --help as people see it in a terminal of 80 columns and 24 lines.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"

namespace {

std::vector<std::string> help_lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class HelpText : public CommandLine {
 protected:
  std::vector<std::string> commands() const {
    const std::string help = program({"--help"}).out;
    std::vector<std::string> names;
    for (const std::string& line : help_lines(help.substr(help.find("Commands:"))))
      if (line.starts_with("  ") && line[2] != ' ' && line[2] != '-')
        names.push_back(line.substr(2, line.find(' ', 2) - 2));
    return names;
  }
};

TEST_F(HelpText, FitsTheTerminal) {
  constexpr std::size_t two_screens = 48;
  const auto expect_narrow = [](const std::string& text, const std::string& what) {
    for (const std::string& line : help_lines(text)) EXPECT_LE(line.size(), 80U) << what << line;
  };
  ASSERT_GT(commands().size(), 10U);
  expect_narrow(program({"--help"}).out, "");
  for (const std::string& command : commands()) {
    const std::string help = program({command, "--help"}).out;
    expect_narrow(help, command);
    EXPECT_LE(help_lines(help).size(), two_screens) << command;
    expect_narrow(program({command, "--help-all"}).out, command);
  }
}

TEST_F(HelpText, BeginsWithAnExample) {
  for (const std::string& command : commands()) {
    if (command == "manual") continue;
    const std::string help = program({command, "--help"}).out;
    const std::size_t example = help.find("Example");
    EXPECT_LT(example, help.find("Usage: cosys-sim " + command)) << help;
    EXPECT_NE(help.find("cosys-sim " + command, example), std::string::npos) << help;
  }
}

TEST_F(HelpText, HasOptionsByWhatTheyAreFor) {
  const std::string help = program({"run", "--help"}).out, all = program({"run", "--help-all"}).out;
  const auto place = [](const std::string& text, const char* what) { return text.find(what); };
  EXPECT_LT(place(help, "\nWhat:\n"), place(help, "\n  --set KEY=VALUE"));
  EXPECT_LT(place(help, "\nHow long:\n"), place(help, "\n  -n, --max-frames N"));
  EXPECT_LT(place(help, "\nWhere to:\n"), place(help, "\n  -o, --output OUT.h5"));
  EXPECT_LT(place(help, "\n  --set"), place(help, "\nHow long:\n"));
  EXPECT_NE(place(help, "\nRarely needed (see --help-all): "), std::string::npos);
  EXPECT_EQ(place(help, "\n  --shard K/N"), std::string::npos);
  EXPECT_NE(place(all, "\n  --shard K/N"), std::string::npos);
  EXPECT_NE(place(all, "not with --plan, --plot"), std::string::npos);
}

}  // namespace
