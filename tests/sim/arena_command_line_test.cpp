// Arenas from outside: what run prints and leaves behind.
#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

const std::string scene =
    "title = \"two\"\nexperiment = \"arena\"\n[receiver]\nmodule = \"TSSP4056\"\n"
    "[arena]\nduration_s = 5\nruns = 2\n"
    "[devices.gate]\nx_m = 2\nyaw_deg = 180\nmessages = [\"A\", \"B\"]\nsource = \"list\"\n"
    "[devices.crowd]\nx_m = 3\nyaw_deg = 180\ncount = 3\nspread_y_m = 1\nmessages = \"NO {}\"\n";

class ArenaProgram : public CommandLine {
 protected:
  ArenaProgram() { write("a.toml", scene); }
};

TEST_F(ArenaProgram, PrintsARowDevicesLossesAndTheWay) {
  const Outcome o = program({"run", "a.toml"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  for (const char* part : {"crowd x3", "gate", "not sent (silent spell)", "delivered\n",
                           "0.0 .. 0.5", "a.h5: digest "})
    EXPECT_NE(o.out.find(part), std::string::npos) << part << "\n" << o.out;
  EXPECT_EQ(files(), (std::set<std::string>{"a.toml", "a.h5"}));
}

TEST_F(ArenaProgram, TableJsonAndFileTellTheSame) {
  const std::string digest = digest_of(program({"run", "a.toml", "-t", "1"}).out);
  const Outcome o = program({"run", "a.toml", "--json", "-t", "2"});
  ASSERT_EQ(o.code, 0) << o.err;
  const auto json = nlohmann::json::parse(o.out);
  EXPECT_EQ(json.at("result_digest"), digest);
  EXPECT_EQ(json.at("experiment"), "arena");
  EXPECT_EQ(json.at("dimensions").at("device"), (Words{"crowd-1", "crowd-2", "crowd-3", "gate"}));
  const auto counts = [&](const char* name) {
    return json.at("variables").at(name).at("values").get<std::vector<std::int64_t>>();
  };
  const auto heard = counts("heard_device");
  for (std::int64_t i = 0; i < 4; ++i)
    EXPECT_EQ(std::ranges::count(heard, i), counts("n_delivered")[static_cast<std::size_t>(i)]);
  std::ostringstream listed;
  for (const std::int64_t n : counts("n_delivered"))
    listed << (listed.tellp() > 0 ? ", " : "") << n;
  EXPECT_EQ(values("a.h5", "n_delivered"), listed.str());
}

TEST_F(ArenaProgram, XarrayOpensItsResult) {
  const Outcome o = program({"run", "a.toml", "--json", "--set", "devices.crowd.count=3,5"});
  ASSERT_EQ(o.code, 0) << o.err;
  write("a.json", o.out);
  EXPECT_EQ(tool("/usr/bin/python3",
                 {COSYS_SOURCE_DIR "/tests/sim/open_arena_with_xarray.py", "a.h5", "a.json"}),
            "all readers agree\n");
}

TEST_F(ArenaProgram, ASweepPrintsARowAPoint) {
  const Outcome o = program({"run", "a.toml", "--set", "devices.crowd.count=1:1:3"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(std::ranges::count(o.out, '\n'), 3 + 3 + 1) << o.out;
}

TEST_F(ArenaProgram, MeasuredTwoHundredDevicesRunInLittleMemory) {
  const Outcome o =
      program({"run", "a.toml", "-t", "2", "--set", "devices.crowd.count=199", "--set",
               "arena.duration_s=2", "--set", "arena.runs=16", "--set", "path.x_m=0,2"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("crowd x199"), std::string::npos);
  EXPECT_LT(o.peak_kb, 150 * 1024);
}

TEST_F(ArenaProgram, IsDrawnAsCharacters) {
  const Outcome swept = program({"run", "a.toml", "--plot", "--set", "devices.crowd.count=1:1:3"});
  ASSERT_EQ(swept.code, 0) << swept.err;
  EXPECT_NE(swept.out.find("\n            frame loss ratio (FLR)"), std::string::npos) << swept.out;
  EXPECT_NE(swept.out.find("throughput S (dashed: of pure ALOHA"), std::string::npos);
  EXPECT_NE(swept.out.find("devices.crowd.count"), std::string::npos);
  const Outcome single = program({"run", "a.toml", "--plot"});
  EXPECT_NE(single.out.find("nothing to plot: no number is swept"), std::string::npos);
}

TEST_F(ArenaProgram, OtherCommandsTakeLinks) {
  for (const char* command : {"find", "trace"}) {
    const Outcome o = program({command, "a.toml"});
    EXPECT_EQ(o.code, bad_input);
    EXPECT_EQ(std::ranges::count(o.err, '\n'), 1) << o.err;
  }
  expect_refused({"trace", "a.toml", "-o", "t.vcd"}, bad_input,
                 "a.toml (an experiment \"arena\" has no trials of a link) trace takes links; use "
                 "run");
}

TEST_F(ArenaProgram, KeepsTheResultWhereThereIsNoneOfIts) {
  write("a.h5", "my thesis");
  EXPECT_EQ(program({"run", "a.toml"}).code, bad_input);
  EXPECT_EQ(content(path("a.h5")), "my thesis");
}

// The first point takes a minute at least, so no run of it is finished.
TEST_F(ArenaProgram, AnInterruptBeforeAllLeavesTheResultThatIsThere) {
  ASSERT_EQ(program({"run", "a.toml", "--set", "arena.duration_s=5"}).code, 0);
  const std::string before = content(path("a.h5"));
  Running running =
      start_program({"run", "a.toml", "--set", "arena.duration_s=80000", "--set", "arena.runs=2"});
  for (int i = 0; i < 3; ++i) ASSERT_NE(running.line(), "");
  const Outcome o = running.finish(SIGINT);
  EXPECT_EQ(o.code, 130);
  EXPECT_EQ(o.err,
            "cosys-sim: stopping (signal) once more to stop at once\n"
            "a.h5: nothing was finished, the file is left as it was\n"
            "cosys-sim: interrupted (by a signal) nothing was counted\n");
  EXPECT_EQ(content(path("a.h5")), before);
}

TEST_F(ArenaProgram, AnInterruptKeepsFinishedPoints) {
  Running running = start_program(
      {"run", "a.toml", "--set", "arena.duration_s=5,80000", "--set", "arena.runs=2"});
  for (int i = 0; i < 4; ++i) ASSERT_NE(running.line(), "");
  EXPECT_EQ(running.finish(SIGINT).code, 130);
  EXPECT_EQ(values("a.h5", "n_runs"), "2, 0");
}

}  // namespace
