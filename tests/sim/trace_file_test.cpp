#include "sim/trace/trace_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scenarios.hpp"
#include "sim/failure.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

class TraceFile : public testing::Test {
 protected:
  TraceFile() {
    std::string name = (fs::temp_directory_path() / "trace_test.XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~TraceFile() override { fs::remove_all(folder_); }

  fs::path path(const std::string& name) const { return folder_ / name; }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }

 private:
  fs::path folder_;
};

// One message of 17 bytes, and light enough to move every tap.
TracedTrial short_trial() {
  const LoadedScenario scenario =
      loaded("title = 'Licht über 5 °'\n",
             {"simulation.warmup_messages=0", "simulation.sample_rate_hz=250000"});
  TracedTrial traced = trace_trial(point_scenario(scenario, {}), 3);
  traced.origin = {.program = {"cosys-sim", "0.1.0", "abc123"},
                   .scenario_toml = scenario.text,
                   .seed = 18446744073709551615U,
                   .point = 12,
                   .trial = 3};
  return traced;
}

nlohmann::json attributes_of(const TracedTrial& traced) {
  return {{"program", "cosys-sim"},
          {"version", "0.1.0"},
          {"commit", "abc123"},
          {"scenario_toml", traced.origin.scenario_toml},
          {"point", 12},
          {"trial", 3},
          {"sample_rate_hz", 2.5e5},
          {"seed", 18446744073709551615U}};
}

std::string failure_of(const fs::path& path) {
  try {
    check_trace_path(path);
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "no failure";
}

TEST_F(TraceFile, Hdf5HasTheTapsOfTheCsvAndTheirSpectraInEveryReader) {
  const TracedTrial traced = short_trial();
  write_trace(path("t.h5"), traced);
  write_trace(path("t.csv"), traced);
  std::ofstream(path("t.json")) << attributes_of(traced);
  const std::string command = "/usr/bin/python3 '" COSYS_SOURCE_DIR
                              "/tests/sim/open_trace_with_xarray.py' '" +
                              path("t.h5").string() + "' '" + path("t.csv").string() + "' '" +
                              path("t.json").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

// The instants are ends of samples, where the pin flips: the columns lose none of its flips.
TEST_F(TraceFile, ColumnsKeepEveryFlipOfThePin) {
  const TracedTrial traced = short_trial();
  const std::vector<double> times = sample_times_s(traced);
  ASSERT_EQ(times.size(), traced.taps.irradiance.size());
  const std::vector<std::uint8_t> levels = levels_at(traced.rx, times);
  std::vector<double> flips;
  for (std::size_t i = 1; i < levels.size(); ++i)
    if (levels[i] != levels[i - 1]) flips.push_back(times[i]);
  ASSERT_EQ(flips.size(), traced.rx.flips().size());
  EXPECT_GT(flips.size(), 80u);
  for (std::size_t i = 0; i < flips.size(); ++i) EXPECT_EQ(flips[i], traced.rx.flips()[i].value);
}

TEST_F(TraceFile, LeavesNothingButTheFile) {
  const TracedTrial traced = short_trial();
  for (const char* name : {"t.vcd", "t.sr", "t.ook", "t.csv", "t.h5"})
    write_trace(path(name), traced);
  EXPECT_EQ(files(), 5u);
}

TEST_F(TraceFile, ReplacesOnlyItsOwn) {
  const TracedTrial traced = short_trial();
  for (const char* name : {"t.vcd", "t.sr", "t.ook", "t.csv", "t.h5"}) {
    write_trace(path(name), traced);
    EXPECT_EQ(failure_of(path(name)), "no failure");
    std::ofstream(path(name)) << "time_s,voltage\n";
    EXPECT_EQ(failure_of(path(name)), "cannot write " + path(name).string() +
                                          " (it exists and is not a trace of cosys-sim) choose "
                                          "another name");
    std::ofstream(path(name)).close();
    EXPECT_EQ(failure_of(path(name)), "no failure");
  }
}

TEST_F(TraceFile, NamesTheFormatsThatItKnows) {
  EXPECT_EQ(failure_of("x.txt"),
            "cannot trace into x.txt (its ending names no format) end the name in .vcd or .sr or "
            ".ook or .csv or .h5");
  EXPECT_EQ(failure_of(path("missing") / "t.h5"),
            "cannot write " + (path("missing") / "t.h5").string() +
                " (its folder does not exist) create the folder or choose another");
  EXPECT_EQ(failure_of(path("t.h5")), "no failure");
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace sim
