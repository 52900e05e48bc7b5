// The program as users and their scripts run it: exit codes, what is said where, and which files
// are left. Tracing and signals have files of their own.
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "text_lines.hpp"

namespace {

using sim::lines_of;

std::string digest_in(const std::string& out) {
  const std::string key = ": digest ";
  const std::size_t at = out.find(key);
  return at == std::string::npos ? "no digest in " + out : out.substr(at + key.size(), 32);
}

TEST_F(CommandLine, RefusesWhatItCannotRead) {
  write_scenario("s.toml", "receiver.range_m = [1, 2]");
  expect_refused({}, bad_input, "A subcommand is required (wrong usage) see cosys-sim --help");
  write("r.h5", "\x89HDF\r\n\x1a\n...");
  expect_refused(
      {"run", "r.h5"}, bad_input,
      "r.h5 (it is an HDF5 file, not a scenario) give the .toml; with --resume it goes on "
      "with its result");
  expect_refused({"help", "rnu"}, bad_input, "rnu (no such command) did you mean run?");
  expect_refused({"rnu"}, bad_input, "rnu (no such command) did you mean run?");
  expect_refused({"rnu", "--help"}, bad_input, "rnu (no such command) did you mean run?");
  expect_refused({"run"}, bad_input, "SCENARIO is required (wrong usage) see cosys-sim run --help");
  expect_refused({"run", "s.toml", "--thread", "2"}, bad_input,
                 "--thread (run has no such option) did you mean --threads?");
  expect_refused({"run", "s.toml", "--threads", "0"}, bad_input,
                 "--threads: Value 0 not in range 1 to 1024 (wrong usage) see cosys-sim run "
                 "--help");
  expect_refused({"run", "s.toml", "--json", "--plot"}, bad_input,
                 "--plot excludes --json (wrong usage) see cosys-sim run --help");
  expect_refused({"run", "s.toml", "-n", "nan"}, bad_input,
                 "stop.max_frames = nan in --max-frames (not a finite number) write a finite one");
  expect_refused({"encode", "IND", "011111", "OK"}, bad_input,
                 "011111 (encode does not take another argument) leave it out or quote what "
                 "belongs together");
}

TEST_F(CommandLine, RefusesScenariosThatDoNotHold) {
  write("wrong.toml", "title = 'x'\n[receiver]\nrange = 3\n");
  write("no.toml", "title = \n");
  expect_refused({"run", "missing.toml"}, bad_input, "missing.toml (no such file) check the path");
  expect_refused({"run", "wrong.toml"}, bad_input,
                 "receiver.range in wrong.toml:3 (no such key) did you mean receiver.range_m?");
  const Outcome o = program({"run", "no.toml"});
  EXPECT_EQ(o.code, bad_input);
  EXPECT_EQ(lines_of(o.err).size(), 1u) << o.err;
  EXPECT_NE(o.err.find("no.toml:1"), std::string::npos) << o.err;
}

TEST_F(CommandLine, RefusesSettingsThatDoNotHold) {
  write_scenario("s.toml", "receiver.range_m = [1, 2]");
  const auto set = [](const std::string& value) { return Words{"run", "s.toml", "--set", value}; };
  expect_refused(set("receiver.range=1"), bad_input,
                 "receiver.range in --set (no such key) did you mean receiver.range_m?");
  expect_refused(set("receiver.range_m"), bad_input,
                 "\"receiver.range_m\" in --set (no = in it) write key=value, such as "
                 "receiver.range_m=3");
  expect_refused(
      set("receiver.range_m=-1"), bad_input,
      "receiver.range_m = -1 in --set (distance along the floor must be at least 0.01 m) "
      "use a value 0.01 to 1000");
  expect_refused({"run", "s.toml", "-S", "abc"}, bad_input,
                 "simulation.seed = abc in --seed (not a number) use a whole number 0 to "
                 "9007199254740991");
  expect_refused({"run", "s.toml", "-n", "0"}, bad_input,
                 "stop.max_frames = 0 in --max-frames (messages after which a point ends must be "
                 "at least 1) use a whole number 1 to 4000000000");
}

TEST_F(CommandLine, RefusesPlacesBeforeItRuns) {
  write_scenario("s.toml", "receiver.range_m = [1, 2]");
  write("file", "");
  std::filesystem::create_directory(path("folder.h5"));
  const auto to = [](const std::string& place) { return Words{"run", "s.toml", "-o", place}; };
  expect_refused(to("missing/x.h5"), environment,
                 "cannot write missing/x.h5 (its folder does not exist) create the folder or "
                 "choose another");
  expect_refused(to("file/x.h5"), environment,
                 "cannot write file/x.h5 (Not a directory) choose another place");
  expect_refused(to("/dev/null"), environment,
                 "cannot write /dev/null (it is not a regular file) choose another place");
  expect_refused(to("file/"), environment,
                 "cannot create the folder file/ (File exists) choose another place");
  expect_refused(to(""), bad_input, "--output: is empty (wrong usage) see cosys-sim run --help");
  expect_refused({"trace", "s.toml", "-o", "folder.h5"}, environment,
                 "cannot write " + canonical(path("folder.h5")).string() +
                     " (it is a folder) add a file name");
  EXPECT_EQ(program(to("/proc/x.h5")).code, environment);
}

TEST_F(CommandLine, RefusesTwoScenariosOfOneName) {
  write_scenario("s.toml", "receiver.range_m = [1, 2]");
  expect_refused({"run", "s.toml", "./s.toml", "-o", "results"}, bad_input,
                 "s.toml and ./s.toml would both be written to results/s.h5 (they have the same "
                 "name) rename one or run them one by one");
}

TEST_F(CommandLine, AFailingRunLeavesTheLastResult) {
  write_scenario("s.toml", "receiver.range_m = [1, 2]");
  ASSERT_EQ(program({"run", "s.toml", "-q"}).code, 0);
  const std::string before = content(path("s.h5"));
  const std::string full =
      "cannot write to standard output (it is closed or full) redirect it elsewhere";
  expect_refused({"run", "s.toml"}, environment, full, "/dev/full");
  expect_refused({"encode", "IND"}, environment, full, "/dev/full");
  EXPECT_EQ(program({"run", "s.toml", "--set", "stop.max_frames=0"}).code, bad_input);
  EXPECT_TRUE(content(path("s.h5")) == before);
}

// Hours of work are not thrown away because the report of them has no place.
TEST_F(CommandLine, AResultIsKeptThoughItsReportCannotBePrinted) {
  write_scenario("s.toml", "receiver.range_m = [1, 2]");
  const Outcome o = program({"run", "s.toml", "--json", "-q"}, "/dev/full");
  EXPECT_EQ(o.code, environment);
  EXPECT_EQ(std::ranges::count(o.err, '\n'), 1) << o.err;
  EXPECT_EQ(values("s.h5", "n_frames"), "16, 16");
  EXPECT_EQ(files(), (std::set<std::string>{"s.toml", "s.h5"}));
}

TEST_F(CommandLine, PrintsARowAPointAndKeepsThem) {
  write_scenario("s.toml", "receiver.range_m = [1, 1.5, 50]");
  const Outcome o = program({"run", "s.toml", "-q"});
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "");
  const auto is_row = [](const std::string& line) {
    return line.find(" max_frames") != std::string::npos;
  };
  const std::vector<std::string> lines = lines_of(o.out);
  EXPECT_EQ(std::ranges::count_if(lines, is_row), 3);
  EXPECT_EQ(values("s.h5", "receiver_range_m"), "1, 1.5, 50");
  EXPECT_EQ(values("s.h5", "n_frames"), "16, 16, 16");
  EXPECT_EQ(values("s.h5", "n_frames_lost"), "0, 0, 16");
  EXPECT_EQ(files(), (std::set<std::string>{"s.toml", "s.h5"}));
}

TEST_F(CommandLine, JsonIsOneObject) {
  write_scenario("s.toml", "receiver.range_m = [1, 900]");
  const Outcome o = program({"run", "s.toml", "--json", "-q"});
  ASSERT_EQ(o.code, 0) << o.err;
  const auto json = nlohmann::json::parse(o.out);  // throws if there is anything behind it
  ASSERT_EQ(json.at("points").size(), 2u);
  EXPECT_EQ(json["points"][1].at("n_frames_lost"), 16);
  EXPECT_EQ(json.at("result_digest"), digest_in(program({"run", "s.toml"}).out));
}

TEST_F(CommandLine, SeveralScenariosFillAFolder) {
  write_scenario("a.toml", "receiver.range_m = [1, 2]");
  write_scenario("b.toml", "receiver.range_m = 900");
  const Outcome o = program({"run", "a.toml", "b.toml", "-o", "new/results", "-n", "8"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(values("new/results/a.h5", "n_frames"), "8, 8");
  EXPECT_EQ(values("new/results/b.h5", "n_frames_lost"), "8");
  EXPECT_EQ(files().size(), 2u + 4u);
}

TEST_F(CommandLine, DigestDependsOnTheSeedAndNotOnThreads) {
  write_scenario("s.toml", "receiver.range_m = [1, 15]");
  const auto digest = [&](const Words& more) {
    Words words = {"run", "s.toml", "--set", "stop.max_frames=64"};
    words.insert(words.end(), more.begin(), more.end());
    return digest_in(program(words).out);
  };
  const std::string alone = digest({"--threads", "1"});
  EXPECT_EQ(digest({"--threads", "2"}), alone);
  EXPECT_EQ(digest({"--threads", "8"}), alone);
  EXPECT_NE(values("s.h5", "n_frames_lost"), "0, 0") << "the test needs a link that fails";
  EXPECT_NE(digest({"--seed", "7"}), alone);
}

TEST_F(CommandLine, RecordsTheSeedAndTheCommand) {
  write_scenario("s.toml", "receiver.range_m = 1");
  ASSERT_EQ(program({"run", "s.toml", "--seed", "4711", "-o", "a b.h5"}).code, 0);
  const std::string header = tool("ncdump", {"-h", "a b.h5"});
  EXPECT_NE(header.find(":seed = 4711ULL ;"), std::string::npos) << header;
  EXPECT_NE(header.find(":command = \"cosys-sim run s.toml --seed 4711 -o \\'a b.h5\\'\" ;"),
            std::string::npos)
      << header;
}

TEST_F(CommandLine, HelpAndVersionAreResults) {
  for (const Words& words : {Words{"--help"}, Words{"run", "--help"}, Words{"trace", "--help"},
                             Words{"encode", "--help"}, Words{"decode", "--help"}}) {
    const Outcome o = program(words);
    EXPECT_EQ(o.code, 0);
    EXPECT_EQ(o.err, "");
    EXPECT_NE(o.out.find("Usage: cosys-sim "), std::string::npos) << o.out;
  }
  EXPECT_EQ(program({"help"}).out, program({"--help"}).out);
  EXPECT_EQ(program({"help", "trace"}).out, program({"trace", "--help"}).out);
  EXPECT_TRUE(program({"--version"}).out.starts_with("cosys-sim "));
}

TEST_F(CommandLine, AResultRepeatsItselfWithoutTheFoldersOfItsParts) {
  write_scenario("s.toml", "receiver.range_m = [1, 20]");
  std::filesystem::create_directories(path("mine/modules"));
  std::string part =
      content(std::filesystem::path(COSYS_SOURCE_DIR) / "scenarios/modules/tsop4856.toml");
  part.replace(part.find("\"TSOP4856\""), 10, "\"MYPART\"");
  part.replace(part.find("56000"), 5, "59000");
  write("mine/modules/mypart.toml", part);
  const Outcome first = program({"run", "s.toml", "--parts", "mine", "--set",
                                 "receiver.module=MyPart", "-o", "first.h5", "-q"});
  ASSERT_EQ(first.code, 0) << first.err;
  std::filesystem::remove_all(path("mine"));
  const std::string read =
      "import netCDF4, sys; sys.stdout.write(netCDF4.Dataset('first.h5').scenario_toml)";
  write("again.toml", tool("/usr/bin/python3", {"-c", read}));
  const Outcome again = program({"run", "again.toml", "-q"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(digest_in(again.out), digest_in(first.out));
}

}  // namespace
