// An eighth experiment, all of which is in this file: it throws dice. With nothing said of it
// elsewhere it has keys, a table, HDF5, JSON and a page, and its runs are kept, shared out, merged
// and compared as those of the others.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cereal/types/vector.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "dsp/philox.hpp"
#include "sim/columns/columns_dataset.hpp"
#include "sim/columns/point_report.hpp"
#include "sim/command/command_line.hpp"
#include "sim/command/experiments.hpp"
#include "sim/failure.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/report/point_run.hpp"
#include "sim/result/stored_dataset.hpp"
#include "sim/scenario/key_making.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

// ---- the experiment ----

struct DiceSettings {
  double sides = 6, runs = 100;  // whole numbers
};

std::vector<Key> dice_keys() {
  constexpr SettingsOf<DiceSettings> at;
  return all_younger({whole("dice.sides", "1", from(2, 100), at, &DiceSettings::sides, "faces"),
                      no_physics(whole("dice.runs", "1", from(1, 1e6), at, &DiceSettings::runs,
                                       "throws of each point"))});
}

constexpr ExperimentKind dice_kind{
    .name = "dice", .tables = {"dice."}, .amount = "dice.runs", .keys = dice_keys};

struct Dice {
  std::uint32_t sides = 0;
  dsp::RandomAddress address{};
};

struct Throws {
  std::vector<std::uint64_t> faces{};

  std::uint64_t n() const { return std::accumulate(faces.begin(), faces.end(), std::uint64_t{0}); }
  Throws& operator+=(const Throws& next) {
    faces.resize(std::max(faces.size(), next.faces.size()));
    for (std::size_t i = 0; i < next.faces.size(); ++i) faces[i] += next.faces[i];
    return *this;
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(faces);
  }
};

struct DicePoint {
  std::vector<double> coordinates;
  Throws throws{};
  StopReason stop = StopReason::interrupted;

  bool reached() const { return throws.n() > 0; }
};

Throws throw_dice(const Dice& dice, std::uint32_t first, int n, const std::atomic<bool>*) {
  Throws throws{std::vector<std::uint64_t>(dice.sides)};
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
    dsp::RandomAddress address = dice.address;
    address.trial = first + i;
    ++throws.faces[static_cast<std::size_t>(address.uniform(0) * dice.sides)];
  }
  return throws;
}

Estimate ones(const Throws& throws, double level) {
  const auto part = static_cast<double>(throws.faces[0]);
  const auto whole = static_cast<double>(throws.n());
  const Interval ends = clopper_pearson(part, whole, level);
  return {part / whole, ends.low, ends.high};
}

constexpr Measurement<Dice, Throws, DicePoint> dice_measurement{
    .unreached = [](const Scenario&, const SourceLocations&,
                    const std::vector<double>& coordinates) { return DicePoint{coordinates}; },
    .prepare =
        [](const Scenario& s, const SourceLocations&, const Workers&) {
          return Dice{
              static_cast<std::uint32_t>(s.settings.of<DiceSettings>().sides),
              {.seed = static_cast<std::uint64_t>(s.simulation.seed), .point = point_hash(s)}};
        },
    .most_at_once = [](const Dice&, std::uint32_t, int) { return 10U; },
    .run = throw_dice,
    .ratio = [](const Dice&, const Throws& throws, double level) { return ones(throws, level); },
    .describe = [](DicePoint& point, const Dice&, const Throws& throws) { point.throws = throws; }};

double mean(const DicePoint& point) {
  double sum = 0;
  for (std::size_t i = 0; i < point.throws.faces.size(); ++i)
    sum += static_cast<double>((i + 1) * point.throws.faces[i]);
  return sum / static_cast<double>(point.throws.n());
}

const Columns<DicePoint>& dice_columns() {
  static const Columns<DicePoint> columns = [] {
    Columns<DicePoint> made;
    made.dimension({"face", "1", "faces of the dice"}, [](const DicePoint& point) {
      std::vector<Label> faces;
      for (std::size_t i = 1; i <= point.throws.faces.size(); ++i)
        faces.emplace_back(static_cast<double>(i));
      return faces;
    });
    made.count({"n_runs", "1", "throws"}, [](const DicePoint& p) { return p.throws.n(); })
        .headed({{"", "", "throws"}, 8});
    made.ratio({"share_of_ones", "1", "throws of a one over all"},
               [](const DicePoint& p) { return ones(p.throws, 0.95); })
        .headed({{"", "share of ones", "[interval]"}, -estimate_width})
        .drawn({"Share of ones", "share of ones", true});
    made.real({"mean_eyes", "1", "mean of the eyes thrown"}, mean, significant(3))
        .headed({{"", "mean", "eyes"}, 6});
    made.count({"n_of_face", "1", "throws of the face"},
               [](const DicePoint& p, std::size_t i) { return p.throws.faces[i]; })
        .on({"face"});
    return made;
  }();
  return columns;
}

constexpr PointReport<DicePoint> dice_report{dice_columns, nullptr};

constexpr Experiment dice{.kind = &dice_kind,
                          .engine = &experiment_engine<dice_measurement, dice_report>};

// ---- what the commands make of it ----

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::string last_word(const std::string& text) {
  const std::size_t space = text.find_last_of(' ');
  return text.substr(space + 1, text.find_last_not_of('\n') - space);
}

class ToyExperiment : public testing::Test {
 protected:
  ToyExperiment() : home_(std::filesystem::current_path()) {
    std::string name = (std::filesystem::temp_directory_path() / "dice.XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    std::filesystem::current_path(folder_);
    std::ofstream("d.toml") << "title = \"Dice\"\nexperiment = \"dice\"\n"
                               "[dice]\nruns = 300\n[sweep]\ndice.sides = [2, 6, 20]\n";
  }
  ~ToyExperiment() override {
    std::filesystem::current_path(home_);
    std::filesystem::remove_all(folder_);
  }

  /// What a command writes to stdout.
  static std::string said(std::vector<std::string> words) {
    words.insert(words.begin(), "cosys-sim");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    testing::internal::CaptureStdout();
    try {
      code_ = run_command_line(static_cast<int>(arguments.size()), arguments.data(),
                               {.program = {"cosys-sim", "test", ""},
                                .commit_date = "",
                                .command = "cosys-sim run d.toml",
                                .shipped_parts = COSYS_SOURCE_DIR "/scenarios"});
    } catch (const Failure& failure) {
      code_ = static_cast<int>(failure.code());
      return testing::internal::GetCapturedStdout() + failure.what();
    }
    return testing::internal::GetCapturedStdout();
  }

  /// The same of one that succeeds.
  static std::string done(std::vector<std::string> words) {
    const std::string text = said(std::move(words));
    EXPECT_EQ(code_, 0) << text;
    return text;
  }

  static inline int code_ = 0;
  const KnownExperiment known_{dice};

 private:
  std::filesystem::path home_, folder_;
};

TEST_F(ToyExperiment, HasATableOfItsColumns) {
  const std::string table = done({"run", "d.toml", "-q"});
  EXPECT_TRUE(
      table.starts_with("      dice\n"
                        "     sides            share of ones                 mean\n"
                        "              throws  [interval]                    eyes\n"))
      << table;
  EXPECT_NE(table.find("         2       300  0."), std::string::npos) << table;
}

TEST_F(ToyExperiment, IsInJsonAndInHdf5) {
  const auto json = nlohmann::json::parse(done({"run", "d.toml", "-q", "--json"}));
  const auto& variables = json["variables"];
  EXPECT_EQ(variables["n_runs"]["values"], (std::vector<int>{300, 300, 300}));
  EXPECT_NEAR(variables["mean_eyes"]["values"][1].get<double>(), 3.5, 0.5);
  EXPECT_EQ(variables["n_of_face"]["dimensions"], (std::vector<std::string>{"dice_sides", "face"}));
  EXPECT_EQ(json["dimensions"]["face"].size(), 20U);
  EXPECT_EQ(variables["n_of_face"]["values"][2], 0) << "two sides only";
  EXPECT_GT(variables["share_of_ones_ci_high"]["values"][0].get<double>(), 0.5);
  const Dataset stored = read_dataset("d.h5").data;
  EXPECT_EQ(stored.experiment, "dice");
  EXPECT_EQ(dataset_digest(stored), json["result_digest"].get<std::string>());
  EXPECT_NE(find_variable(stored, "share_of_ones_ci_low"), nullptr);
}

TEST_F(ToyExperiment, HasAPage) {
  done({"run", "d.toml", "-q"});
  done({"report", "d.h5", "-o", "d.html"});
  const std::string page = text_of("d.html");
  for (const char* words : {"The result is of 900 runs at 3 points.", "Share of ones is least at ",
                            "<desc>share of ones over dice.sides</desc>",
                            "<h2>Faces of the dice</h2>", ">mean eyes</th>"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
}

TEST_F(ToyExperiment, IsPlottedPlannedAndCompared) {
  EXPECT_NE(done({"run", "d.toml", "-q", "--plot"}).find("share of ones, logarithmic"),
            std::string::npos);
  EXPECT_NE(done({"run", "d.toml", "--plan"}).find("sides"), std::string::npos);
  done({"run", "d.toml", "-q", "-o", "one.h5", "-t", "1"});
  EXPECT_EQ(done({"diff", "d.h5", "one.h5"}), "equal: the same counts at every point\n");
  done({"run", "d.toml", "-q", "-o", "other.h5", "-S", "5"});
  EXPECT_TRUE(done({"diff", "d.h5", "other.h5"}).starts_with("compatible: no ratio of 3 "));
}

TEST_F(ToyExperiment, EndsWhereItsIntervalIsNarrow) {
  done({"run", "d.toml", "-q", "--rel-ci", "0.3"});
  const std::vector<double> runs = numbers_named(read_dataset("d.h5").data, "n_runs");
  EXPECT_LT(runs[0], 100);  // a one in two
  EXPECT_EQ(runs[2], 300);  // in twenty: all of them
  EXPECT_EQ(std::fmod(runs[0], 8), 0);
  EXPECT_EQ(said({"run", "d.toml", "-q", "--rel-ci", "0.3", "--shard", "1/2"}),
            "--shard 1/2 (--rel-ci and --target-flr need the counts of all shards) use dice.runs, "
            "which can be shared out");
}

TEST_F(ToyExperiment, SaysWhereItsTimeWent) {
  testing::internal::CaptureStderr();
  done({"run", "d.toml", "-q", "--profile"});
  const std::string profile = testing::internal::GetCapturedStderr();
  for (const char* stage : {"preparing", "runs", "describing", "writing", "all"})
    EXPECT_NE(profile.find(std::string("\n  ") + stage + " "), std::string::npos) << profile;
  EXPECT_NE(profile.find("ms a run"), std::string::npos) << profile;
}

TEST_F(ToyExperiment, IsSharedOut) {
  const std::string digest = last_word(done({"run", "d.toml", "-q"}));
  for (const char* shard : {"1/3", "2/3", "3/3"})
    done({"run", "d.toml", "-q", "--shard", shard, "-o", std::string(1, shard[0]) + ".h5"});
  EXPECT_EQ(last_word(done({"merge", "3.h5", "1.h5", "2.h5", "-o", "sum.h5"})), digest);
}

TEST_F(ToyExperiment, IsGoneOnWith) {
  const LoadedScenario scenario = load_scenario("d.toml", {}, {COSYS_SOURCE_DIR "/scenarios"});
  RunCounting<Dice, Throws, DicePoint> begun(dice_measurement, scenario),
      whole(dice_measurement, scenario);
  begun.count(0, {});
  RunCounting<Dice, Throws, DicePoint> resumed(dice_measurement, scenario);
  resumed.add(begun.checkpoint());
  EXPECT_EQ(resumed.n_begun(), 1U);
  for (std::size_t i = 0; i < 3; ++i) {
    resumed.count(i, {});
    whole.count(i, {});
  }
  resumed.describe_all({});
  EXPECT_EQ(dataset_digest(dataset_of(scenario, "", dice_columns(), resumed.points())),
            dataset_digest(dataset_of(scenario, "", dice_columns(), whole.points())));
}

TEST_F(ToyExperiment, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(said({"run", "d.toml", "--set", "arena.runs=2"}),
            "arena.runs in --set (it means nothing in the experiment \"dice\") remove it, or write "
            "experiment = \"arena\" or \"guard\" before the first table");
  EXPECT_EQ(said({"run", "d.toml", "--set", "dice.sides=1"}).find("dice.sides = 1"), 0U);
}

TEST(NoToyExperiment, IsKnownWithoutItsRow) {
  EXPECT_EQ(find_key("dice.sides"), nullptr);
  const KnownExperiment known(dice);
  EXPECT_NE(find_key("dice.sides"), nullptr);
}

}  // namespace
}  // namespace sim
