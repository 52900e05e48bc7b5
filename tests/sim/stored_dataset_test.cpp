// Results of experiments that are no links, written and read back.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>

#include "damage.hpp"
#include "sim/failure.hpp"
#include "sim/link_experiment/link_columns.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/result/store.hpp"
#include "sim/result/stored_dataset.hpp"
#include "sim/result/stored_result.hpp"
#include "sim/result/unfinished.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

constexpr const char* scenario_text =
    "title = \"µ\"\nexperiment = \"listening\"\n[sweep]\nlistening.air = [\"cosys\", "
    "\"remote\"]\nreceiver.range_m = [1, 2, 3]\n";
constexpr std::int64_t rare_number = 0x1122334455667788;

LoadedScenario scenario_from(const std::string& text) {
  return parse_scenario(text, "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"});
}

class StoredDatasetTest : public testing::Test {
 protected:
  StoredDatasetTest() { fs::create_directories(folder_); }
  ~StoredDatasetTest() override { fs::remove_all(folder_); }

  static Dataset dataset() {
    Dataset data = dataset_of(scenario_from(scenario_text), "cosys-sim run x");
    data.dimensions = {{{"false_alarm", "1", "as set"}, std::vector<double>{0.1, 0.5}},
                       {{"device", "", "devices"}, std::vector<std::string>{"a b", "c"}}};
    using Reals = std::vector<double>;
    using Counts = std::vector<std::int64_t>;
    data.variables = {
        {{"z_count", "1", "first of the digest"}, true, {}, Counts{1, 2, 3, 4, 5, rare_number}},
        {{"n_runs", "1", "runs"}, true, {}, Counts{7, 0, 7, 7, 7, 7}},
        {{"marks", "1", "flags"}, true, {}, Counts{0, 1, 2, 3, 0, 0}, {"one", "two"}},
        {{"a_real", "m", "on two dimensions"}, true, {"false_alarm", "device"}, Reals(24, 0.25)},
        {{"alone", "s", "on none of the axes"}, false, {"device"}, Reals{1.5, std::nan("")}}};
    return data;
  }
  fs::path written() const {
    write_dataset(file_, dataset(), {"cosys-sim", "1", "c"});
    return file_;
  }
  std::string image() const {
    std::ifstream in(file_, std::ios::binary);
    std::ostringstream all;
    all << in.rdbuf();
    return all.str();
  }
  void write(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }

  void expect_refused(const std::string& why) const {
    try {
      read_dataset(file_);
      FAIL() << "it was read";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::bad_input);
      EXPECT_NE(std::string(failure.what()).find(why), std::string::npos) << failure.what();
    }
  }

  fs::path folder_ = fs::temp_directory_path() / ("stored_dataset_" + std::to_string(getpid()));
  fs::path file_ = folder_ / "x.h5";
};

TEST_F(StoredDatasetTest, IsReadAsItWasWritten) {
  const StoredDataset stored = read_dataset(written());
  const Dataset& data = stored.data;
  EXPECT_EQ(data.title, "µ");
  EXPECT_EQ(data.command, "cosys-sim run x");
  EXPECT_EQ(data.experiment, "listening");
  EXPECT_EQ(data.scenario_toml, dataset().scenario_toml);
  EXPECT_EQ(data.axes.size(), 2U);
  EXPECT_EQ(data.n_runs, 35U);
  EXPECT_EQ(stored.scenario.base.experiment, "listening");
  EXPECT_EQ(dimension_named(data, "device").values, dataset().dimensions[1].values);
  EXPECT_EQ(dimension_named(data, "false_alarm").values, dataset().dimensions[0].values);
  ASSERT_EQ(data.variables.size(), 5U);
  for (const Dataset::Variable& wrote : dataset().variables) {
    const Dataset::Variable* read = find_variable(data, wrote.facts.name);
    ASSERT_NE(read, nullptr) << wrote.facts.name;
    EXPECT_EQ(read->facts.unit, wrote.facts.unit);
    EXPECT_EQ(read->facts.long_name, wrote.facts.long_name);
    EXPECT_EQ(read->on_axes, wrote.on_axes) << wrote.facts.name;
    EXPECT_EQ(read->dimensions, wrote.dimensions) << wrote.facts.name;
    EXPECT_EQ(read->flags, wrote.flags);
    EXPECT_EQ(read->values.index(), wrote.values.index()) << "whole numbers stay whole";
  }
  EXPECT_EQ(find_variable(data, "z_count")->values, dataset().variables[0].values);
  EXPECT_EQ(numbers_of(*find_variable(data, "alone"))[0], 1.5);
  EXPECT_TRUE(std::isnan(numbers_of(*find_variable(data, "alone"))[1]));
  EXPECT_EQ(dataset_digest(data), dataset_digest(dataset()));
  EXPECT_EQ(find_variable(data, "none"), nullptr);
  EXPECT_EQ(cells_a_point(data, *find_variable(data, "a_real")), 4U);
}

TEST_F(StoredDatasetTest, OfASinglePoint) {
  Dataset data = dataset_of(scenario_from("experiment = \"listening\"\n"), "c");
  data.variables = {{{"n_trials", "1", "trials"}, true, {}, std::vector<std::int64_t>{9}}};
  write_dataset(file_, data, {"cosys-sim", "1", "c"});
  const StoredDataset stored = read_dataset(file_);
  EXPECT_EQ(stored.data.n_runs, 9U);
  EXPECT_TRUE(stored.data.variables.at(0).on_axes);
  EXPECT_EQ(stored.data.variables.at(0).values, data.variables[0].values);
}

TEST_F(StoredDatasetTest, RefusesCountsThatDoNotFitTheDigest) {
  written();
  std::string bytes = image();
  const std::size_t at = bytes.find("\x88\x77\x66\x55\x44\x33\x22\x11");
  ASSERT_NE(at, std::string::npos);
  bytes[at] = '\x07';
  write(bytes);
  expect_refused("its counts do not fit its digest: it is damaged");
}

/// As by a program that wrote less into its files, or more than there is room for.
// More of them, with the whole program: damaged_files_test.cpp.
TEST_F(StoredDatasetTest, DamageIsReadOrRefused) {
  written();
  const test::Damage damage(image());
  for (std::uint64_t number = 0; number < 40; ++number) {
    write(damage.damaged(number));
    try {
      read_dataset(file_);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::bad_input) << number << ": " << failure.what();
    }
  }
}

TEST_F(StoredDatasetTest, DamageToALinksIsToo) {
  LinkResult result = unfinished(scenario_from("[sweep]\nreceiver.range_m = [1, 2]\n"), "");
  for (LinkPoint& point : result.points) point.tally = {.n_bits = 800, .n_frames = 8};
  write_dataset(file_, link_dataset(result), {"cosys-sim", "1", "c"});
  const test::Damage damage(image());
  int read = 0;
  for (std::uint64_t number = 0; number < 40; ++number) {
    write(damage.damaged(number));
    try {
      read += read_result(file_).result.points.size() == 2 ? 1 : 0;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::bad_input) << number << ": " << failure.what();
    }
  }
  EXPECT_LT(read, 40);
}

class ForeignFile : public StoredDatasetTest {
 protected:
  void write_file(const std::vector<double>& ranges, const std::vector<std::string>& dimensions,
                  std::size_t cells, const char* experiment = "listening",
                  const char* counted = "n_runs") const {
    NetcdfFile file(experiment_result_type, {"cosys-sim", "1", "c"});
    const std::vector<double> heard(4, 1);
    const std::vector<std::int64_t> counts(cells, 1);
    const std::vector<std::string> airs{"cosys", "remote"};
    file.add_dimension({"listening_air", "", ""}, std::span<const std::string>(airs));
    file.add_dimension({"receiver_range_m", "m", ""}, std::span<const double>(ranges));
    file.add_dimension({"heard", "", ""}, std::span<const double>(heard));
    file.add_variable({counted, "1", ""}, dimensions, std::span<const std::int64_t>(counts));
    for (const char* name : {"title", "command"}) file.set_user_text("/", name, "t");
    file.set_user_text("/", "scenario_toml", scenario_from(scenario_text).text);
    file.set_text("/", "experiment", experiment);
    const std::uint64_t seed = 1;
    file.set_numbers("/", "seed", std::span<const std::uint64_t>(&seed, 1));
    write(file.image());
  }
};

TEST_F(ForeignFile, WithoutDigestIsReadAsItIs) {
  write_file({1, 2, 3}, {"heard"}, 4);
  const StoredDataset stored = read_dataset(file_);
  EXPECT_FALSE(stored.data.variables.at(0).on_axes);
  EXPECT_EQ(stored.data.variables.at(0).dimensions, std::vector<std::string>{"heard"});
}

TEST_F(ForeignFile, OnAxesThatAreNotTheScenariosIsRefused) {
  write_file({1, 2, 3}, {"receiver_range_m"}, 3);
  expect_refused("its variables do not fit its sweep: it is damaged");
  write_file({1, 2, 3, 4}, {"listening_air", "receiver_range_m"}, 8);
  expect_refused("it is damaged");
  write_file({1, 2, 3}, {"listening_air", "receiver_range_m"}, 6);
  EXPECT_TRUE(read_dataset(file_).data.variables.at(0).on_axes);
}

TEST_F(ForeignFile, OfAnotherExperimentThanItsScenarioIsRefused) {
  write_file({1, 2, 3}, {"heard"}, 4, "arena");
  expect_refused("its scenario is of another experiment: it is damaged");
  write_file({1, 2, 3}, {"heard"}, 4, "listening", "n_others");
  expect_refused("it does not say how many runs it has: it is damaged");
}

TEST_F(StoredDatasetTest, RefusesWhatIsNone) {
  expect_refused("no such");
  write("text");
  expect_refused("not an HDF5 file");
}

}  // namespace
}  // namespace sim
