// A scenario may carry the files of its parts in its own text; the text that a result keeps does.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scenarios.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/scenario/canonical_text.hpp"
#include "sim/scenario/entries.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

LoadedScenario parse(const std::string& text, const std::vector<std::string>& overrides = {},
                     const std::vector<fs::path>& roots = {scenarios}) {
  return parse_scenario(text, "x.toml", overrides, roots);
}

std::string shipped(const std::string& file) { return read_text_file(scenarios / file, "part"); }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), to);
}

/// The TSOP4856 with another band-pass, as text that a scenario carries.
std::string carried_module(const std::string& tail = "") {
  return "[[part]]\n\"modules/tsop4856.toml\" = " +
         toml_lines(replaced(shipped("modules/tsop4856.toml"), "value = 56000", "value = 58000") +
                    tail);
}

TEST(CarriedPart, TheKeptTextNeedsNoPartFilesAnyMore) {
  const auto first = parse("receiver.range_m = 3\n", {"led.current_ma=20,50"});
  const auto again = parse(first.text, {}, {});
  EXPECT_EQ(canonical_text(again.base), canonical_text(first.base));
  EXPECT_EQ(again.sweep[0].values, first.sweep[0].values);
  EXPECT_EQ(again.text, first.text) << "what is carried already is not added again";
}

TEST(CarriedPart, ComesBeforeAllFolders) {
  EXPECT_EQ(parse(carried_module()).base.module.centre_hz, 58000);
  EXPECT_EQ(parse(carried_module(), {"module.centre_hz=40000"}).base.module.centre_hz, 40000);
  EXPECT_EQ(parse("").base.module.centre_hz, 56000);
}

// Names of files differ in case between systems; a part is named by any.
TEST(CarriedPart, IsFoundWhateverItsCase) {
  EXPECT_EQ(parse(carried_module(), {"receiver.module=tSOP4856"}).base.module.centre_hz, 58000);
}

TEST(CarriedPart, AnyCharacterOfAPartFileIsKept) {
  for (const char* tail : {"# it's \"quoted\" \\ back\n", "# ''' and \"\"\"\n", "# '",
                           "# cr\r\n# \t tab\n", "# \xc3\xa4 \u2014\n"}) {
    const auto first = parse(carried_module(tail));
    EXPECT_EQ(first.base.module.centre_hz, 58000) << tail;
    const auto entries = read_entries(carried_module(tail), "x.toml");
    EXPECT_TRUE(std::get<std::string>(entries.at(0).value).ends_with(tail)) << tail;
  }
}

TEST(CarriedPart, IsRefusedInOneLine) {
  EXPECT_EQ(refusal("[[part]]\n\"parts/x.toml\" = \"\"\n"),
            "parts/x.toml in x.toml:2 (no name of a part's file) write \"modules/NAME.toml\", "
            "\"leds/NAME.toml\", \"floors/NAME.toml\" or \"photodiodes/NAME.toml\" in quotes");
  EXPECT_EQ(
      refusal("[[part]]\n\"modules/x.toml\" = 5\n"),
      "part.modules/x.toml in x.toml:2 (a number where text is expected) write the part's file "
      "between ''' and '''");
  EXPECT_EQ(refusal(carried_module() + "\n" + carried_module()).substr(0, 24),
            "modules/tsop4856.toml in");
  EXPECT_EQ(refusal("[[part]]\n\"modules/tsop4856.toml\" = \"name = 5\"\n"),
            "name in x.toml/modules/tsop4856.toml:1 (a number where text is expected) add name = "
            "\"tsop4856\"");
}

// A part that is like another needs that one's file too.
TEST(CarriedPart, BringsThePartThatItIsLike) {
  const fs::path folder = fs::path(testing::TempDir()) / "carried_part_like";
  fs::create_directories(folder / "modules");
  std::ofstream(folder / "modules/mine.toml")
      << "name = \"MINE\"\nlike = \"TSOP94256\"\n"
         "emin_mw_per_m2 = { value = 0.09, source = \"measured\" }\n";
  const LoadedScenario mine = parse("receiver.module = \"MINE\"", {}, {folder, scenarios});
  EXPECT_EQ(mine.base.module.emin_mw_per_m2, 0.09);
  EXPECT_EQ(mine.base.module.agc_hold_ms, 9.2);
  const LoadedScenario again = parse(mine.text, {}, {});
  EXPECT_EQ(canonical_text(again.base), canonical_text(mine.base));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace sim
