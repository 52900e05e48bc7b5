// Completions: what bash and fish offer at a word, and that it is what the help says; zsh's in its
// own words.
#include <regex>

#include "program.hpp"
#include "sim/command/completion.hpp"
#include "sim/scenario/keys.hpp"

namespace {

using WordSet = std::set<std::string>;

/// All of a pattern's first group in a text.
WordSet groups_in(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern, std::regex::multiline);
  WordSet names;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    names.insert((*it)[1]);
  return names;
}

class Completion : public CommandLine {
 protected:
  Completion() { write("completion", program({"completion", "bash"}).out); }

  /// What bash offers in place of the last of the words, which follow the program's name.
  WordSet offers(Words words) const {
    const std::string script =
        "source completion; COMP_WORDS=(cosys-sim \"$@\") COMP_CWORD=$#; _cosys_sim; "
        "((${#COMPREPLY[@]} == 0)) || printf '%s\\n' \"${COMPREPLY[@]}\"";
    words.insert(words.begin(), {"--norc", "-u", "-c", script, "bash"});
    return groups_in(tool("bash", words), "^(.+)$");
  }

  WordSet commands() const {
    const std::string help = program({"--help"}).out;
    return groups_in(help.substr(help.find("Commands:")), "^  ([a-z]+) ");
  }
};

TEST_F(Completion, OffersEachCommandAndEachOptionOfTheHelp) {
  WordSet commands_and_help = commands();
  ASSERT_GT(commands_and_help.size(), 10u);
  for (const std::string& command : commands()) {
    const std::string help = program({command, "--help-all"}).out;
    WordSet options = groups_in(help, "^  (--?[A-Za-z-]+)");
    options.merge(groups_in(help, "^  -[^ ]+, (--[A-Za-z-]+)"));
    EXPECT_EQ(offers({command, "-"}), options) << command;
  }
  EXPECT_EQ(offers({"help", ""}), commands_and_help);
  commands_and_help.insert("help");
  EXPECT_EQ(offers({""}), commands_and_help);
  EXPECT_EQ(offers({"--"}), (WordSet{"--help", "--version"}));
}

TEST_F(Completion, OffersTheWordsOfAChoice) {
  const std::vector<std::string>& choices = sim::find_key("uart.receiver")->choices;
  EXPECT_EQ(offers({"decode", "--uart", ""}), WordSet(choices.begin(), choices.end()));
  EXPECT_EQ(offers({"decode", "--uart", "mid"}), WordSet{"mid-bit"});
  EXPECT_EQ(offers({"decode", "--uart", "=", "mid"}),
            WordSet{"mid-bit"});  // as bash takes --uart=mid
  EXPECT_EQ(offers({"run", "--quiet", "--method", "="}), (WordSet{"brute-force", "importance"}));
  EXPECT_TRUE(offers({"check", "--decoder", ""}).contains("soft-alone"));
  EXPECT_EQ(offers({"completion", ""}), (WordSet{"bash", "zsh", "fish"}));
}

TEST_F(Completion, OffersKeysAndWhatTheyMayBe) {
  WordSet keys;
  for (const sim::Key& key : sim::scenario_keys()) keys.insert(key.name() + "=");
  ASSERT_GT(keys.size(), 100u);
  EXPECT_EQ(offers({"run", "--set", ""}), keys);
  EXPECT_EQ(offers({"find", "x.toml", "--over", "receiver.ran"}), WordSet{"receiver.range_m="});
  EXPECT_EQ(offers({"run", "--set", "=", "receiver.ran"}), WordSet{"receiver.range_m="});
  EXPECT_EQ(offers({"run", "--set", "uart.receiver", "=", "mid"}), WordSet{"mid-bit"});
  EXPECT_EQ(offers({"run", "--set", "=", "uart.receiver", "=", "mid"}), WordSet{"mid-bit"});
  EXPECT_TRUE(offers({"run", "--set", "receiver.module", "="}).contains("TSOP4856"));
  EXPECT_EQ(offers({"run", "--set", "led.part", "=", "TSAL62"}), WordSet{"TSAL6200"});
}

TEST_F(Completion, OffersPartsOfTheKindThatIsAskedFor) {
  EXPECT_EQ(offers({"fit", "--module", "TSOP4856"}), WordSet{"TSOP4856"});
  EXPECT_EQ(offers({"fit", "--module", "TSAL62"}), WordSet());
  EXPECT_TRUE(offers({"locate", "--floor", ""}).contains("indoor"));
  EXPECT_FALSE(offers({"locate", "--floor", ""}).contains("BPW34"));
  EXPECT_EQ(offers({"parts", "BPW34"}), WordSet{"BPW34"});
  EXPECT_EQ(offers({"parts", "TSAL62"}), WordSet{"TSAL6200"});
}

TEST_F(Completion, OffersFilesByTheirEnding) {
  std::filesystem::create_directory(path("folder"));
  for (const char* name : {"a scenario.toml", "result.h5", "capture.vcd", "b.svg"}) write(name, "");
  EXPECT_EQ(offers({"run", ""}), (WordSet{"a scenario.toml", "folder"}));
  EXPECT_EQ(offers({"run", "x.toml", "a"}), WordSet{"a scenario.toml"});
  EXPECT_EQ(offers({"run", "-o", ""}), (WordSet{"result.h5", "folder"}));
  EXPECT_EQ(offers({"run", "--parts", ""}), WordSet{"folder"});
  EXPECT_EQ(offers({"decode", "c"}), WordSet{"capture.vcd"});
  EXPECT_EQ(offers({"trace", "-o", "b"}), WordSet{"b.svg"});
  EXPECT_EQ(offers({"report", "-o", ""}).size(), 6u);  // any, and the completion
}

TEST_F(Completion, OffersNothingWhereNothingIsKnown) {
  write("3.toml", "");
  EXPECT_EQ(offers({"run", "-n", ""}), WordSet());
  EXPECT_EQ(offers({"run", "--set", "receiver.range_m", "=", ""}), WordSet());
  EXPECT_EQ(offers({"run", "--threads", "a", "=", ""}), WordSet());
  EXPECT_EQ(offers({"run", "-o", "a", "=", ""}), WordSet());
  EXPECT_EQ(offers({"rnu", ""}), WordSet());
}

TEST_F(Completion, IsForThreeShells) {
  expect_refused({"completion", "ksh"}, 2,
                 "SHELL: ksh not in {bash,zsh,fish} (wrong usage) see cosys-sim completion --help");
  write("_cosys-sim", program({"completion", "zsh"}).out);
  EXPECT_EQ(tool("zsh", {"-n", "_cosys-sim"}), "");
}

TEST_F(Completion, IsTheSameInFish) {
  write("completion.fish", program({"completion", "fish"}).out);
  const auto fish_offers = [&](const std::string& line) {
    const std::string script = "source completion.fish; complete -C 'cosys-sim " + line + "'";
    return groups_in(tool("fish", {"--no-config", "-c", script}), "^([^\t\n]+)");
  };
  write("a.toml", "");
  write("b.h5", "");
  for (const std::string& command : commands())
    EXPECT_EQ(fish_offers(command + " -"), offers({command, "-"})) << command;
  EXPECT_EQ(fish_offers(""), offers({""}));
  EXPECT_EQ(fish_offers("help "), offers({"help", ""}));
  EXPECT_EQ(fish_offers("decode --uart "), offers({"decode", "--uart", ""}));
  EXPECT_EQ(fish_offers("run --set "), offers({"run", "--set", ""}));
  EXPECT_EQ(fish_offers("run --set uart.receiver=mid"), WordSet{"uart.receiver=mid-bit"});
  EXPECT_EQ(fish_offers("run --set=uart.receiver=mid"), WordSet{"--set=uart.receiver=mid-bit"});
  EXPECT_EQ(fish_offers("run --set receiver.range_m="), WordSet());
  EXPECT_EQ(fish_offers("run -n "), WordSet());
  EXPECT_EQ(fish_offers("fit --module TSOP4856"), WordSet{"TSOP4856"});
  EXPECT_EQ(fish_offers("run a"), WordSet{"a.toml"});
  EXPECT_EQ(fish_offers("run -o b"), WordSet{"b.h5"});
}

/// The line of zsh's script that begins so.
std::string script_line(const std::string& text, const std::string& start) {
  const std::size_t at = text.find(start);
  return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

TEST(ZshCompletion, QuotesWhatItsShellWouldTakeForItsOwn) {
  sim::OptionUsage file{.names = {"-o", "--output"},
                        .value = "A:B",
                        .help = "it's [one] of C:\\",
                        .kind = sim::ValueKind::file,
                        .words = {},
                        .endings = {".h5"},
                        .excludes = {"--no-output"}};
  sim::OptionUsage choice{.names = {"--choice"},
                          .value = "NAME",
                          .help = "words",
                          .kind = sim::ValueKind::words,
                          .words = {"a", "b"},
                          .endings = {},
                          .excludes = {},
                          .repeated = true};
  const std::string text = sim::zsh_completion({.program = {.name = "cosys-sim",
                                                            .summary = "",
                                                            .notes = "",
                                                            .examples = {},
                                                            .arguments = {},
                                                            .options = {}},
                                                .commands = {{.name = "write",
                                                              .summary = "Writes it's",
                                                              .notes = "",
                                                              .examples = {},
                                                              .arguments = {},
                                                              .options = {file, choice}}}});
  EXPECT_EQ(script_line(text, "'write:"), "'write:Writes it'\\''s'");
  EXPECT_EQ(
      script_line(text, "'(--no-output"),
      "'(--no-output -o --output)'{-o+,--output=}'[it'\\''s \\[one\\] of C:\\\\]:A\\:B:_files "
      "-g \"*.h5\"' \\");
  EXPECT_EQ(script_line(text, "'*'--choice"), "'*'--choice='[words]:NAME:(a b)' && ret=0");
}

}  // namespace
