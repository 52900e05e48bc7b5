// Decoders that a check must survive: what they leave in its folder and among the processes, and
// what is left of both when the check itself is killed.
#include <sys/file.h>

#include "edge_decoder.hpp"
#include "program.hpp"
#include "sanitized.hpp"

namespace {

namespace fs = std::filesystem;

class HostileDecoder : public CommandLine {
 protected:
  void SetUp() override {
    write("s.toml",
          "[receiver]\nmodule = 'TSSP4056'\nrange_m = 2\n"
          "[simulation]\nfidelity = 'envelope'\nwarmup_messages = 0\n[stop]\nmax_frames = 300\n");
    ASSERT_EQ(program({"baseline", "s.toml", "-q", "-o", "b.h5"}).code, 0);
    fs::create_directory(path("tmp"));
    ::setenv("TMPDIR", path("tmp").c_str(), 1);
    ::setenv("COSYS_SIM_DECODER", "of another check, whose decoder this check is", 1);
  }
  void TearDown() override {
    ::unsetenv("TMPDIR");
    ::unsetenv("COSYS_SIM_DECODER");
  }

  static Words check(const std::string& decoder) {
    return {"check", "s.toml", "--baseline", "b.h5", "-q", "-t", "1", "--decoder", decoder};
  }

  /// A time to sleep that no other process has, be it a test beside this one.
  static std::string seconds() { return "62." + std::to_string(::getpid()); }
  bool anybody_sleeps() const {
    return start_tool("pgrep", {"-f", "^sleep " + seconds() + "$"}).finish().code == 0;
  }
  /// Waits for it, or for its end.
  void await_sleep(bool begun) const {
    for (int tries = 0; tries < 600 && anybody_sleeps() != begun; ++tries) ::usleep(50'000);
    EXPECT_EQ(anybody_sleeps(), begun);
  }
  void await_empty(const fs::path& folder) const {
    for (int tries = 0; tries < 600 && !fs::is_empty(folder); ++tries) ::usleep(50'000);
    EXPECT_TRUE(fs::is_empty(folder));
  }
};

// It would wait for ever in a pipe's open, or have captures written wherever a link leads.
TEST_F(HostileDecoder, MayLeavePipesAndLinksWhereCapturesGo) {
  write("mine", "a thesis");
  write("edges.py", edge_decoder);
  for (const std::string& trap : Words{"mkfifo", "ln -s " + path("mine").string()}) {
    const std::string each = "for i in 1 2 3 4 5 6 7 8 9; do " + trap + " $d/$i.$e; done; ";
    Words command = check("f={edges}; d=$(dirname $f); e=${f##*.}; (" + each +
                          ") 2>&-; python3 edges.py 0.5 <$f");
    command.emplace_back("--golden");
    const Outcome o = program(command);
    EXPECT_EQ(o.code, 0) << o.err << o.out;
    EXPECT_EQ(content(path("mine")), "a thesis");
    EXPECT_TRUE(fs::is_empty(path("tmp")));
  }
}

TEST_F(HostileDecoder, IsGoneWithItsFolderWhenTheCheckIsKilled) {
  for (const std::string how : {"exec sleep ", "setsid --wait sleep "}) {
    Running run = start_program(check("cat {edges} >/dev/null; " + how + seconds()));
    await_sleep(true);
    EXPECT_FALSE(fs::is_empty(path("tmp")));
    EXPECT_EQ(run.finish(SIGKILL).code, -SIGKILL);
    await_sleep(false);
    await_empty(path("tmp"));
  }
}

TEST_F(HostileDecoder, ThatLeavesItsGroupIsEndedAfterItsTime) {
  Words command = check("setsid sleep " + seconds() + " & sleep " + seconds());
  command.insert(command.end(), {"--decoder-timeout", "0.3s"});
  const Outcome o = program(command);
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_NE(o.out.find("no answer within 0.3 s"), std::string::npos) << o.out;
  EXPECT_FALSE(anybody_sleeps());
}

// The warden may be killed too: by who kills all of a container, for want of memory.
TEST_F(HostileDecoder, LeavesNothingThatTheNextCheckDoesNotRemove) {
  fs::create_directory(path("tmp/cosys-sim-captures.dead00"));
  fs::permissions(path("tmp/cosys-sim-captures.dead00"), fs::perms::owner_all);
  write("tmp/cosys-sim-captures.dead00/1.edges", "0 1\n");
  fs::create_directory(path("tmp/cosys-sim-captures.notes"));  // somebody's own
  fs::create_directory(path("tmp/cosys-sim-captures.alive0"));
  fs::permissions(path("tmp/cosys-sim-captures.alive0"), fs::perms::owner_all);
  const int alive = ::open(path("tmp/cosys-sim-captures.alive0").c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(alive, LOCK_EX), 0);
  program(check("cat {edges} >/dev/null; exit 3"));
  EXPECT_FALSE(fs::exists(path("tmp/cosys-sim-captures.dead00")));
  EXPECT_TRUE(fs::exists(path("tmp/cosys-sim-captures.alive0")));
  EXPECT_TRUE(fs::exists(path("tmp/cosys-sim-captures.notes")));
  ::close(alive);
}

TEST_F(HostileDecoder, NeedsATemporaryFolder) {
  ::setenv("TMPDIR", path("no-folder").c_str(), 1);
  expect_refused(check("cat {edges}"), environment,
                 "cannot make a temporary folder (" + path("no-folder").string() +
                     " is no folder) set TMPDIR to one that can be written");
}

// Its verdict is the work of hours, whatever became of the report's place.
TEST_F(HostileDecoder, IsJudgedThoughTheReportFindsNoPlace) {
  const std::string said =
      tool("bash", {"-c", "ulimit -f 0; " COSYS_PROGRAM
                          " check s.toml -q --baseline b.h5 --junit o.xml 2>&1 | cat; "
                          "echo ${PIPESTATUS[0]}"});
  EXPECT_NE(said.find("frames"), std::string::npos) << said;
  EXPECT_TRUE(said.ends_with("; what was counted is on standard output\n3\n")) << said;
}

TEST_F(HostileDecoder, MayReadStdinWithoutATemporaryFolder) {
  ::setenv("TMPDIR", path("no-folder").c_str(), 1);
  const Outcome o = program(check("cat >/dev/null; exit 3"));
  EXPECT_EQ(o.code, 1) << o.err;
}

// Five million lines, in an eighth of the memory that they took.
TEST_F(HostileDecoder, TakesLittleMemoryWithWhatItPrints) {
  Words command = check("yes 'IND 011111 OK' | head -c 60000000");
  command.insert(command.end(), {"--decoder-output", "frames"});
  const Outcome o = program(command);
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_NE(o.out.find("more than 4 MiB of output"), std::string::npos) << o.out;
  if (!sim::test::is_sanitized) {
    EXPECT_LT(o.peak_kb, 100'000);
  }
}

TEST_F(HostileDecoder, HasATableWithoutWhatATerminalObeys) {
  const std::string name = "s\x1b[31m\xc2\x9b.toml";
  fs::copy(path("s.toml"), path(name));
  ASSERT_EQ(program({"baseline", name, "-q", "-o", "named.h5"}).code, 0);
  const Outcome o = program({"check", name, "--baseline", "named.h5"});
  EXPECT_EQ(o.code, 4) << o.err;  // nothing is lost to compare
  EXPECT_NE(o.out.find("s?[31m?"), std::string::npos) << o.out;
  for (const std::string& text : {o.out, o.err}) {
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
    EXPECT_EQ(text.find("\xc2\x9b"), std::string::npos) << text;
  }
}

}  // namespace
