// run --doubt, and the doubt that every range of a link is said with.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"
#include "small_experiments.hpp"
#include "text_lines.hpp"

namespace {

using sim::first_line_with;

class Doubt : public CommandLine {
 protected:
  static inline const std::string quickstart = COSYS_SOURCE_DIR "/scenarios/quickstart.toml";
};

TEST_F(Doubt, SaysHowManyUnitsCarry) {
  const Outcome run = program({"run", quickstart, "-n", "8", "-q", "--set", "receiver.unit=1:1:4",
                               "--set", "receiver.range_m=1,3"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out.find("bit error ratio"), std::string::npos) << "rows of units are not printed";
  EXPECT_NE(run.out.find("units drawn within what nobody printed"), std::string::npos);
  EXPECT_NE(run.out.find("(10 % quantile of 4 units), "), std::string::npos) << run.out;
  EXPECT_EQ(run.out.find("as assumed"), std::string::npos);
}

// It is a sweep as any other: it can be resumed, and says the same again.
TEST_F(Doubt, IsASweepOfUnits) {
  const Words words{"-n", "8", "-q", "--json", "--set", "receiver.range_m=2"};
  const auto with = [&](Words more) {
    more.insert(more.end(), words.begin(), words.end());
    more.insert(more.begin(), {"run", quickstart});
    return program(more);
  };
  const Outcome doubt = with({"--doubt"});
  ASSERT_EQ(doubt.code, 0) << doubt.err;
  const Outcome swept = with({"--set", "receiver.unit=1:1:32"});
  EXPECT_EQ(first_line_with(doubt.out, "result_digest"),
            first_line_with(swept.out, "result_digest"));
}

// The quick look of a plain run agrees with the whole sweep of the same units.
TEST_F(Doubt, APlainRunSaysHowFarItsRangeCanBeTrusted) {
  const Words sweep{"--set", "receiver.range_m=0.2,3,9", "-q", "-n", "8"};
  Words plain{"run", quickstart},
      whole{"run", quickstart, "-e", "1", "--set", "receiver.unit=1:1:16"};
  for (Words* words : {&plain, &whole}) words->insert(words->end(), sweep.begin(), sweep.end());
  const std::string said = first_line_with(program(plain).out, "as assumed");
  const std::string found = first_line_with(program(whole).out, "of 16 units)");
  ASSERT_NE(found.find("receiver.range_m 0.2 to 3 m (10 %"), std::string::npos) << found;
  ASSERT_NE(found.find("beyond 9 m (90 %"), std::string::npos) << found;
  EXPECT_EQ(said,
            "as assumed; 0.2 m to beyond 9 m for 8 of 10 units, as not all of TSOP4856 is known "
            "(--doubt says more; measure yours: cosys-sim fit)");
}

TEST_F(Doubt, IsInTheJsonOfAPlainRunAndOfASweepOfUnits) {
  Words words{"run", quickstart, "-q", "-n", "8", "--json", "--set", "receiver.range_m=0.2,3,9"};
  const auto plain = nlohmann::json::parse(program(words).out);
  EXPECT_EQ(
      plain["crossings"][0]["doubt"],
      nlohmann::json::parse(R"({"part": "TSOP4856", "units": 16, "low": 0.2, "high": null})"));
  EXPECT_FALSE(plain.contains("units"));
  words.insert(words.end(), {"-e", "1", "--set", "receiver.unit=1:1:16"});
  const auto swept = nlohmann::json::parse(program(words).out);
  EXPECT_FALSE(swept["crossings"][0].contains("doubt"));
  EXPECT_EQ(swept["units"]["shares"].size(), 3U);
  EXPECT_EQ(swept["units"]["ranges"][0]["quantiles"][0],
            nlohmann::json::parse(R"({"quantile": 0.1, "low": 0.2, "high": 3.0})"));
}

TEST_F(Doubt, IsSaidOfEachRowOfAListAndExplainedOnce) {
  const Outcome run =
      program({"run", quickstart, "-q", "-n", "8", "--set", "receiver.range_m=0.2,9", "--set",
               "receiver.module=TSOP4856,TSOP4456"});
  const auto lines = sim::lines_of(run.out);
  const auto with = [&](const std::string& words) {
    return std::ranges::count_if(
        lines, [&](const auto& line) { return line.find(words) != std::string::npos; });
  };
  EXPECT_EQ(with(" passes at        8 of 10 units"), 1) << run.out;
  EXPECT_EQ(with("as assumed; 8 of 10 units: of 16 drawn within"), 1) << run.out;
}

// Two devices of which one is in reach.
TEST_F(Doubt, SaysWhatUnitsOfAnArenaHaveTogether) {
  write("arena.toml", sim::test::scenario_of(sim::test::small_experiments[0], false));
  const Outcome run = program({"run", "arena.toml", "-q", "--set", "receiver.unit=0:1:4"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto lines = sim::lines_of(run.out);
  EXPECT_EQ(lines.at(0), "units drawn within what nobody printed of their parts:");
  EXPECT_NE(sim::first_line_with(run.out, " 4  devices "), "") << run.out;
  EXPECT_NE(sim::first_line_with(run.out, " 4  throughput S "), "") << run.out;
}

TEST_F(Doubt, IsNotSaidOfWhatIsKnown) {
  for (const std::string known :
       {"module.agc_attack_db_per_ms=0.1", "receiver.population=constants", "receiver.unit=2",
        "receiver.module=ideal-coherent"}) {
    const Outcome run = program(
        {"run", quickstart, "-q", "-n", "8", "--set", known, "--set", "receiver.range_m=1,10"});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.out.find("as assumed"), std::string::npos) << known;
  }
}

}  // namespace
