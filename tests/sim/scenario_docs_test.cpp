// scenarios/KEYS.md must print the program's own key table. To re-bless it after a change of
// keys, run this test with COSYS_BLESS=1 and review the difference.
#include <cstdlib>
#include <fstream>
#include <string>

#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/location/location_keys.hpp"  // the kinds that some scenarios are of
#include "sim/scenario/key_reference.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/text/text_file.hpp"

namespace {

using sim::scenarios;

const std::string begin_mark = "<!-- keys: begin (printed by the program) -->\n";
const std::string end_mark = "\n<!-- keys: end -->";

struct KeysPage {
  std::string before, tables, after;
};

KeysPage read_keys_page() {
  const std::string text = sim::read_text_file(scenarios / "KEYS.md", "keys");
  const auto begin = text.find(begin_mark);
  const auto end = text.find(end_mark);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw std::runtime_error("scenarios/KEYS.md has lost its two key marks");
  const auto first = begin + begin_mark.size();
  return {text.substr(0, first), text.substr(first, end - first), text.substr(end)};
}

TEST(ScenarioDocs, ThePagePrintsTheKeyTable) {
  const KeysPage page = read_keys_page();
  if (std::getenv("COSYS_BLESS"))
    std::ofstream(scenarios / "KEYS.md") << page.before << sim::key_reference() << page.after;
  else
    EXPECT_EQ(page.tables, sim::key_reference())
        << "scenarios/KEYS.md differs from sim/scenario/keys.cpp; run this test once with "
           "COSYS_BLESS=1";
}

TEST(ScenarioDocs, EveryKeySaysWhatItIs) {
  for (const sim::Key& key : sim::scenario_keys()) {
    EXPECT_FALSE(key.facts.long_name.empty()) << key.name();
    EXPECT_NE(key.is_number(), static_cast<bool>(key.text)) << key.name();
    const bool of_numbers = key.is_number() || key.facts.type == sim::KeyType::number_list;
    EXPECT_EQ(of_numbers, !key.facts.unit.empty()) << key.name();
    EXPECT_EQ(of_numbers, key.facts.range.low < key.facts.range.high) << key.name();
  }
}

TEST(ScenarioDocs, EveryScenarioOfTheProjectLoadsAndOpensWithItsQuestion) {
  int n = 0;
  for (const auto& file : std::filesystem::directory_iterator(scenarios)) {
    if (file.path().extension() != ".toml") continue;
    ++n;
    EXPECT_NO_THROW(sim::load_scenario(file.path(), {}, {scenarios})) << file.path();
    const std::string text = sim::read_text_file(file.path(), "scenario");
    EXPECT_TRUE(text.starts_with("# ")) << file.path();
    EXPECT_NE(text.substr(0, text.find('\n')).find('?'), std::string::npos) << file.path();
  }
  EXPECT_GT(n, 0);
}

}  // namespace
