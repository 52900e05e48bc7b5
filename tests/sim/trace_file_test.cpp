#include "sim/trace/trace_file.hpp"

#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
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

  std::string not_replaced(const std::string& name) const {
    const std::string kind =
        name == "t.bin" ? "known to be one of cosys-sim's" : "a trace of cosys-sim";
    return "cannot write " + path(name).string() + " (it exists and is not " + kind +
           ") choose another name";
  }

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

constexpr const char* all_names[] = {"t.vcd", "t.sr", "t.ook", "t.bin",
                                     "t.csv", "t.h5", "t.wav", "t.sigmf-meta"};

std::string path_failure(const fs::path& path) {
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

// The instants are ends of samples, where the pin changes: the columns lose none of its edges.
TEST_F(TraceFile, ColumnsKeepEveryEdgeOfThePin) {
  const TracedTrial traced = short_trial();
  const std::vector<double> times = sample_times_s(traced);
  ASSERT_EQ(times.size(), traced.taps.irradiance.size());
  const std::vector<std::uint8_t> levels = levels_at(traced.rx, times);
  std::vector<double> edges;
  for (std::size_t i = 1; i < levels.size(); ++i)
    if (levels[i] != levels[i - 1]) edges.push_back(times[i]);
  ASSERT_EQ(edges.size(), traced.rx.edges().size());
  EXPECT_GT(edges.size(), 80u);
  for (std::size_t i = 0; i < edges.size(); ++i) EXPECT_EQ(edges[i], traced.rx.edges()[i].value);
}

TEST_F(TraceFile, LeavesNothingButTheFile) {
  const TracedTrial traced = short_trial();
  for (const char* name : all_names) write_trace(path(name), traced);
  EXPECT_EQ(files(), 8u + 3);  // a SigMF recording is two files, and the baseband's two more
}

TEST_F(TraceFile, ReplacesOnlyItsOwn) {
  const TracedTrial traced = short_trial();
  for (const std::string name : all_names) {
    write_trace(path(name), traced);
    EXPECT_EQ(path_failure(path(name)), name == "t.bin" ? not_replaced(name) : "no failure");
    std::ofstream(path(name)) << "time_s,voltage\n";
    // A foreign SigMF recording is two foreign files, of which the data is looked at first.
    const std::string lost = name == "t.sigmf-meta" ? "t.sigmf-data" : name;
    EXPECT_EQ(path_failure(path(name)), not_replaced(lost));
    std::ofstream(path(name)).close();
    std::ofstream(path(lost)).close();
    EXPECT_EQ(path_failure(path(name)), "no failure");
  }
}

TEST_F(TraceFile, ReplacesNoFileOfAnotherBesideARecording) {
  for (const char* name : {"t.sigmf-data", "t-baseband.sigmf-meta", "t-baseband.sigmf-data"}) {
    std::ofstream(path(name)) << "of another";
    EXPECT_EQ(path_failure(path("t.sigmf-meta")), not_replaced(name));
    fs::remove(path(name));
  }
  EXPECT_EQ(path_failure(path("t.sigmf-meta")), "no failure");
}

/// What became of the names in a folder, in order.
class FolderEvents {
 public:
  explicit FolderEvents(const fs::path& folder)
      : watch_(::inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
    ::inotify_add_watch(watch_, folder.c_str(), IN_MOVED_TO | IN_DELETE);
  }
  ~FolderEvents() { ::close(watch_); }
  FolderEvents(const FolderEvents&) = delete;
  FolderEvents& operator=(const FolderEvents&) = delete;

  std::vector<std::string> all() const {
    alignas(inotify_event) std::array<char, 65536> bytes{};
    const ssize_t size = ::read(watch_, bytes.data(), bytes.size());
    std::vector<std::string> events;
    for (ssize_t at = 0; at < size;) {
      inotify_event event{};
      std::memcpy(&event, bytes.data() + at, sizeof(event));
      const char* name = bytes.data() + at + sizeof(event);
      events.push_back(((event.mask & IN_DELETE) != 0 ? "less " : "new ") + std::string(name));
      at += static_cast<ssize_t>(sizeof(event) + event.len);
    }
    return events;
  }

 private:
  int watch_;
};

// So a kill leaves no metadata beside data that is not its own.
TEST_F(TraceFile, MetadataComesBehindItsDataAndGoesBefore) {
  const TracedTrial traced = short_trial();
  const std::vector<std::string> placed = {"new t.sigmf-data", "new t-baseband.sigmf-data",
                                           "new t.sigmf-meta", "new t-baseband.sigmf-meta"};
  const FolderEvents first(path(""));
  write_trace(path("t.sigmf-meta"), traced);
  EXPECT_EQ(first.all(), placed);
  const FolderEvents second(path(""));
  write_trace(path("t.sigmf-meta"), traced);
  std::vector<std::string> replaced = {"less t-baseband.sigmf-meta", "less t.sigmf-meta",
                                       "less t-baseband.sigmf-data", "less t.sigmf-data"};
  replaced.insert(replaced.end(), placed.begin(), placed.end());
  EXPECT_EQ(second.all(), replaced);
}

TEST_F(TraceFile, NamesTheFormatsThatItKnows) {
  EXPECT_EQ(path_failure("x.txt"),
            "cannot trace into x.txt (its ending names no format) end the name in .vcd or .sr or "
            ".ook or .bin or .svg or .csv or .h5 or .wav or .sigmf-meta");
  EXPECT_EQ(path_failure(path("missing") / "t.h5"),
            "cannot write " + (path("missing") / "t.h5").string() +
                " (its folder does not exist) create the folder or choose another");
  EXPECT_EQ(path_failure(path("t.h5")), "no failure");
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace sim
