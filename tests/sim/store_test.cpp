#include "sim/result/store.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/failure.hpp"
#include "sim/link_experiment/link_columns.hpp"
#include "sim/link_experiment/link_json.hpp"
#include "sim/result/netcdf.hpp"

namespace {

namespace fs = std::filesystem;

const sim::ProgramInfo program{"cosys-sim", "0.1.0", "abc123"};

class Store : public testing::Test {
 protected:
  Store() {
    std::string name = (fs::temp_directory_path() / "store_test.XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~Store() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }

  fs::path path(const std::string& name = "result.h5") const { return folder_ / name; }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }

 private:
  fs::path folder_;
};

std::string bytes_in(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

sim::LinkPoint point(std::vector<double> coordinates, std::uint64_t lost) {
  sim::LinkPoint p;
  p.coordinates = std::move(coordinates);
  p.operating = {0.25 + static_cast<double>(lost), 0.6, 14.25, 5000, 21.5};
  p.tally.n_bits = 17000;
  p.tally.n_bit_errors = 34 * lost;
  p.tally.n_frames_bit_errors = lost;
  p.tally.sum_bits_squared = 100 * 170 * 170;
  p.tally.sum_bit_errors_squared = 34 * 34 * lost;
  p.tally.sum_bit_errors_times_bits = 34 * 170 * lost;
  p.tally.n_frames = 100;
  p.tally.n_frames_ok = 100 - lost;
  p.tally.n_frames_lost = lost;
  p.tally.n_rejected_checksum = lost / 2;
  p.stop = lost > 5 ? sim::StopReason::max_frame_errors : sim::StopReason::max_frames;
  p.elapsed_s = 0.5;
  p.simulated_s = 80;
  p.n_samples = 80'000'000;
  return p;
}

sim::LinkResult single() {
  sim::LinkResult result;
  result.title = "one point at 5 °C";
  result.scenario_toml = "title = \"one point\"\n[receiver]\nrange_m = 3\n";
  result.command = "cosys-sim run \"one point.toml\"";
  result.seed = 18446744073709551615U;
  result.points = {point({}, 7)};
  return result;
}

// The last point was never reached.
sim::LinkResult sweep() {
  sim::LinkResult result = single();
  result.axes = {{"receiver.range_m", "m", "distance along the floor", {1, 2.5, 4}}};
  result.points = {point({1}, 0), point({2.5}, 10), {}};
  result.points[2].coordinates = {4};
  return result;
}

sim::LinkResult grid() {
  sim::LinkResult result = single();
  result.axes = {{"receiver.range_m", "m", "distance along the floor", {1, 2}},
                 {"led.current_ma", "mA", "LED current", {20, 50, 100}}};
  result.points.clear();
  for (std::uint64_t i = 0; i < 6; ++i) {
    result.points.push_back(
        point({1.0 + static_cast<double>(i / 3), result.axes[1].values[i % 3]}, i));
    result.points.back().operating.snr_bandwidth_hz = 4000 + static_cast<double>(i);
  }
  return result;
}

sim::LinkResult sweep_of_texts() {
  sim::LinkResult result = grid();
  result.axes = {{"receiver.module", "", "receiver module", {0, 1}, {"TSOP4856", "Gerät 2"}},
                 {"led.current_ma", "mA", "LED current", {20, 50, 100}}};
  for (std::size_t i = 0; i < 6; ++i) result.points[i].coordinates[0] = i < 3 ? 0 : 1;
  return result;
}

void expect_all_readers_agree(const fs::path& path, const sim::LinkResult& result) {
  auto expected =
      nlohmann::json::parse(sim::to_json(result, sim::link_dataset(result), sim::rank(result)));
  expected["scenario_toml"] = result.scenario_toml;
  const std::string json = path.string() + ".json";
  std::ofstream(json) << expected;
  const std::string command = "/usr/bin/python3 '" COSYS_SOURCE_DIR
                              "/tests/sim/open_with_xarray.py' '" +
                              path.string() + "' '" + json + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

std::string write_failure(const fs::path& path) {
  testing::internal::CaptureStderr();
  std::string message = "no failure";
  try {
    sim::write_dataset(path, sim::link_dataset(single()), program);
  } catch (const sim::Failure& failure) {
    EXPECT_EQ(failure.code(), sim::ExitCode::environment);
    message = failure.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(message.find('\n'), std::string::npos);
  return message;
}

std::string cannot_write(const fs::path& path, const std::string& rest) {
  return "cannot write " + path.string() + " " + rest;
}

void expect_refused(const fs::path& path, const std::string& rest) {
  EXPECT_EQ(write_failure(path), cannot_write(path, rest));
  EXPECT_THROW(sim::check_writable(path), sim::Failure);
}

TEST_F(Store, OnePointOpensEverywhere) {
  sim::write_dataset(path(), sim::link_dataset(single()), program);
  expect_all_readers_agree(path(), single());
}

TEST_F(Store, UnfinishedSweepOpensEverywhere) {
  sim::write_dataset(path(), sim::link_dataset(sweep()), program);
  expect_all_readers_agree(path(), sweep());
}

TEST_F(Store, GridOpensEverywhere) {
  sim::write_dataset(path(), sim::link_dataset(grid()), program);
  expect_all_readers_agree(path(), grid());
}

TEST_F(Store, TextsAsCoordinatesOpenEverywhere) {
  sim::write_dataset(path(), sim::link_dataset(sweep_of_texts()), program);
  expect_all_readers_agree(path(), sweep_of_texts());
}

TEST_F(Store, KeepsAScenarioOfAnyLength) {
  sim::LinkResult result = sweep();
  while (result.scenario_toml.size() < 200'000) result.scenario_toml += "# 0.6 W/m² at 45°\n";
  sim::write_dataset(path(), sim::link_dataset(result), program);
  expect_all_readers_agree(path(), result);
}

TEST_F(Store, KeepsEmptyTexts) {
  sim::LinkResult result = single();
  result.title = result.command = result.scenario_toml = "";
  sim::write_dataset(path(), sim::link_dataset(result), program);
  expect_all_readers_agree(path(), result);
}

TEST_F(Store, ReplacesTheLastFileAndLeavesNothingElse) {
  sim::write_dataset(path(), sim::link_dataset(single()), program);
  const std::string before = bytes_in(path());
  sim::write_dataset(path(), sim::link_dataset(grid()), program);
  EXPECT_NE(bytes_in(path()), before);
  EXPECT_EQ(files(), 1U);
}

TEST_F(Store, WritesThroughALink) {
  sim::write_dataset(path("target.h5"), sim::link_dataset(single()), program);
  fs::create_symlink("target.h5", path("link.h5"));
  const std::string before = bytes_in(path("target.h5"));
  sim::write_dataset(path("link.h5"), sim::link_dataset(grid()), program);
  EXPECT_TRUE(fs::is_symlink(path("link.h5")));
  EXPECT_NE(bytes_in(path("target.h5")), before);
}

TEST_F(Store, RefusesAFolder) {
  fs::create_directory(path());
  expect_refused(path(), "(it is a folder) add a file name");
  EXPECT_EQ(files(), 1U);
}

TEST_F(Store, RefusesADevice) {
  expect_refused("/dev/null", "(it is not a regular file) choose another place");
}

TEST_F(Store, RefusesAMissingFolder) {
  expect_refused(path("missing") / "result.h5",
                 "(its folder does not exist) create the folder or choose another");
}

TEST_F(Store, RefusesAReadOnlyFolder) {
  fs::permissions(path().parent_path(), fs::perms::owner_read | fs::perms::owner_exec |
                                            fs::perms::others_read | fs::perms::others_exec);
  const bool superuser = ::geteuid() == 0;
  ASSERT_EQ(superuser ? ::seteuid(65534) : 0, 0);  // may write everywhere otherwise
  expect_refused(path(), "(Permission denied) choose another place");
  ASSERT_EQ(superuser ? ::seteuid(0) : 0, 0);
  EXPECT_EQ(files(), 0U);
}

// A limit on the size of files stops the writing in the middle, as a full disk does.
TEST_F(Store, KeepsTheLastFileWhenTheDiskRefuses) {
  sim::write_dataset(path(), sim::link_dataset(grid()), program);
  const std::string before = bytes_in(path());
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit small{8192, limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = write_failure(path());
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  EXPECT_EQ(message, cannot_write(path(), "(File too large) choose another place"));
  EXPECT_EQ(bytes_in(path()), before);
  EXPECT_EQ(files(), 1U);
}

TEST_F(Store, RefusesToReplaceWhatIsNoResult) {
  std::ofstream(path()) << "title = \"a scenario, named as the output by mistake\"\n";
  const std::string before = bytes_in(path());
  EXPECT_THROW(sim::check_writable(path()), sim::Failure);
  EXPECT_EQ(bytes_in(path()), before);
  std::ofstream(path(), std::ios::trunc).close();  // an empty file holds nothing to lose
  EXPECT_NO_THROW(sim::check_writable(path()));
}

// A file of the same family, and one that looks like it.
TEST_F(Store, RefusesToReplaceOtherHdf5Files) {
  sim::NetcdfFile trace("cosys-sim trace", program);
  std::ofstream(path()) << trace.image();
  EXPECT_THROW(sim::check_writable(path()), sim::Failure);
  std::ofstream(path()) << "\x89HDF\r\n\x1a\n and no more";
  EXPECT_THROW(sim::check_writable(path()), sim::Failure);
}

/// A process that has ended.
pid_t former_process() {
  const pid_t pid = ::fork();
  if (pid == 0) ::_exit(0);
  ::waitpid(pid, nullptr, 0);
  return pid;
}

TEST_F(Store, RemovesWhatKilledWritersLeft) {
  const std::string ended = "." + std::to_string(former_process()) + ".tmp";
  const std::string running = "." + std::to_string(::getppid()) + ".tmp";
  for (const std::string& name : {"result.h5" + ended, "result.h5" + running, "other.h5" + ended,
                                  std::string("result.h5.mine.tmp")})
    std::ofstream(path(name)) << "half";
  sim::write_dataset(path(), sim::link_dataset(single()), program);
  EXPECT_FALSE(fs::exists(path("result.h5" + ended)));
  EXPECT_EQ(files(), 1U + 3U);
}

TEST_F(Store, ChecksAPlaceWithoutTouchingIt) {
  sim::check_writable(path());
  EXPECT_EQ(files(), 0U);
  sim::write_dataset(path(), sim::link_dataset(single()), program);
  const std::string before = bytes_in(path());
  sim::check_writable(path());
  EXPECT_EQ(bytes_in(path()), before);
  EXPECT_EQ(files(), 1U);
}

}  // namespace
