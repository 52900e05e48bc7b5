// Every command that writes a file, where the place it is given is not as its user thought: another
// file, a link to nothing, no space, a limit, a signal.
#include <csignal>

#include "program.hpp"
#include "small_experiments.hpp"

namespace {

namespace fs = std::filesystem;

const char* const tiny_link =
    "[receiver]\nmodule = 'TSSP4056'\nrange_m = 2\n"
    "[simulation]\nfidelity = 'envelope'\nwarmup_messages = 0\n[stop]\nmax_frames = 8\n";
const char* const sampled =
    "[simulation]\nwarmup_messages = 0\nsample_rate_hz = 250000\n[stop]\nmax_frames = 4\n";

struct Writer {
  Words command;
  std::string place;  // of its file, or one of its files
  std::string own;    // what it may replace there
  std::string folder{};
};

Writer trace(const std::string& ending) {
  return {{"trace", "sampled.toml", "-o", "out" + ending}, "out" + ending, "a trace of cosys-sim"};
}

/// All of them, with their files in the folder as SetUp() makes them.
std::vector<Writer> writers() {
  std::vector<Writer> all{
      {{"run", "link.toml", "-q", "-o", "out.h5"}, "out.h5", "a result of cosys-sim"},
      {{"find", "point.toml", "--over", "receiver.range_m=1:20", "-n", "8", "-o", "out.h5"},
       "out.h5",
       "a result of cosys-sim"},
      {{"merge", "result.h5", "-o", "out.h5"}, "out.h5", "a result of cosys-sim"},
      {{"baseline", "link.toml", "-q", "-o", "out.h5"}, "out.h5", "a baseline of cosys-sim"},
      {{"check", "link.toml", "-q", "--baseline", "base.h5", "--junit", "out.xml"},
       "out.xml",
       "a report of cosys-sim check"},
      {{"report", "result.h5", "-o", "out.html"}, "out.html", "a report of cosys-sim"},
      {{"report", "result.h5", "-o", "page.html", "--svg", "."},
       "frame-loss.svg",
       "a picture of cosys-sim",
       "./"}};
  for (const char* ending : {".vcd", ".sr", ".ook", ".svg", ".csv", ".h5", ".wav", ".sigmf-meta"})
    all.push_back(trace(ending));
  all.push_back(trace(".bin"));
  all.back().own = "known to be one of cosys-sim's";
  for (const sim::test::Experiment& experiment : sim::test::small_experiments)
    all.push_back({{"run", std::string(experiment.name) + ".toml", "-q", "-o", "out.h5"},
                   "out.h5",
                   "a result of cosys-sim"});
  return all;
}

class OutputPlaces : public CommandLine {
 protected:
  void SetUp() override {
    write("link.toml", tiny_link + std::string("[sweep]\nreceiver.range_m = [2, 3]\n"));
    write("point.toml", tiny_link);
    write("sampled.toml", sampled);
    for (const sim::test::Experiment& experiment : sim::test::small_experiments)
      write(std::string(experiment.name) + ".toml", scenario_of(experiment, true));
    static std::string result, base;
    if (base.empty()) {
      ASSERT_EQ(program({"run", "link.toml", "-q", "-o", "result.h5"}).code, 0);
      ASSERT_EQ(program({"baseline", "link.toml", "-q", "-o", "base.h5"}).code, 0);
      result = content(path("result.h5"));
      base = content(path("base.h5"));
    }
    write("result.h5", result);
    write("base.h5", base);
  }

  /// What the program says and ends with under a limit of the shell, behind other settings.
  std::string limited(const std::string& limit, const Words& command) const {
    std::string line = "(" + limit + "; exec " COSYS_PROGRAM;
    for (const std::string& word : command) line += " '" + word + "'";
    return tool("bash", {"-c", line + ") 2>&1 >/dev/null | cat; echo ${PIPESTATUS[0]}"});
  }
};

/// In JSON.
std::string digest_in(const std::string& text) {
  const std::string key = "\"result_digest\": \"";
  const std::size_t at = text.find(key);
  return at == std::string::npos ? "none in " + text : text.substr(at + key.size(), 32);
}

std::string text_of_command(const Writer& writer) {
  std::string text;
  for (const std::string& word : writer.command) text += word + " ";
  return text;
}

TEST_F(OutputPlaces, KeepWhatIsNotOurs) {
  for (const Writer& writer : writers()) {
    SCOPED_TRACE(text_of_command(writer));
    write(writer.place, "a thesis");
    expect_refused(writer.command, bad_input,
                   "cannot write " + writer.folder + writer.place + " (it exists and is not " +
                       writer.own + ") choose another name");
    EXPECT_EQ(content(path(writer.place)), "a thesis");
    fs::remove(path(writer.place));
  }
}

TEST_F(OutputPlaces, MayBeNoLinkThatLeadsNowhere) {
  for (const Writer& writer : writers())
    for (const std::string& target : Words{"nothing", writer.place}) {
      SCOPED_TRACE(text_of_command(writer) + target);
      fs::create_symlink(target, path(writer.place));
      const Outcome o = program(writer.command);
      EXPECT_EQ(o.code, bad_input) << o.err;
      EXPECT_NE(
          o.err.find(target == "nothing" ? "it is a link to nothing" : "it is a link to itself"),
          std::string::npos)
          << o.err;
      EXPECT_TRUE(fs::is_symlink(path(writer.place)));
      EXPECT_FALSE(fs::exists(path("nothing")));
      fs::remove(path(writer.place));
    }
}

// As a full disk, or a limit of SIGXFSZ, which is no end without a word.
TEST_F(OutputPlaces, ThatTakeNothingAreNamedAndNothingIsLeft) {
  for (const Writer& writer : writers()) {
    SCOPED_TRACE(text_of_command(writer));
    const std::set<std::string> before = files();
    const std::string said = limited("ulimit -f 0", writer.command);
    EXPECT_TRUE(said.starts_with("cosys-sim: cannot write ")) << said;
    EXPECT_TRUE(said.ends_with("\n3\n")) << said;
    EXPECT_EQ(files(), before);
  }
}

// Hours of work end on a full disk: they are not lost.
TEST_F(OutputPlaces, ThatAreFullInTheEndLoseNothing) {
  std::vector<std::string> names{"link"};
  for (const sim::test::Experiment& experiment : sim::test::small_experiments)
    names.emplace_back(experiment.name);
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const Outcome good = program({"run", name + ".toml", "-q", "-o", "good.h5", "--json"});
    const std::string said = tool("bash", {"-c", "ulimit -f 0; " COSYS_PROGRAM " run " + name +
                                                     ".toml -q -o out.h5 --json 2>&1 | cat; "
                                                     "echo ${PIPESTATUS[0]}"});
    EXPECT_EQ(digest_in(said), digest_in(good.out));
    EXPECT_TRUE(said.ends_with("; what was counted is on standard output\n3\n")) << said;
  }
}

TEST_F(OutputPlaces, ThatAreGoneInTheEndAreReplacedByTheTemporaryFolder) {
  fs::create_directory(path("there"));
  fs::create_directory(path("temporary"));
  ::setenv("TMPDIR", path("temporary").c_str(), 1);
  Running run =
      start_program({"run", "arena.toml", "-q", "-o", "there/out.h5", "--set", "arena.runs=100"});
  run.line();  // of its head, behind all that is refused before the first trial
  fs::remove_all(path("there"));
  const Outcome o = run.finish();
  ::unsetenv("TMPDIR");
  EXPECT_EQ(o.code, environment);
  ASSERT_EQ(std::distance(fs::directory_iterator(path("temporary")), {}), 1);
  const fs::path kept = fs::directory_iterator(path("temporary"))->path() / "out.h5";
  EXPECT_TRUE(o.err.ends_with("; what was counted is in " + kept.string() + "\n")) << o.err;
  EXPECT_EQ(program({"report", kept.string(), "-o", "kept.html"}).code, 0);
}

TEST_F(OutputPlaces, OfATraceAreLeftAloneByASignal) {
  write("long.toml", "[device]\nbaud = 20\nmessage = '" + std::string(100, 'x') + "'\n");
  const std::set<std::string> before = files();
  Running run = start_program({"trace", "long.toml", "-o", "out.csv"});
  run.await_handler(SIGTERM);
  const Outcome o = run.finish(SIGTERM);
  EXPECT_EQ(o.code, 130);
  EXPECT_EQ(o.err, "cosys-sim: interrupted (by a signal)\n");
  EXPECT_EQ(files(), before);
}

// Part of a report's pictures is no report: here the last one finds no place.
TEST_F(OutputPlaces, OfAReportAreFilledAllOrNone) {
  const Words report{"report", "result.h5", "-o", "out.html", "--svg", "pictures"};
  ASSERT_EQ(program(report).code, 0);
  std::set<fs::path> pictures;
  for (const auto& picture : fs::directory_iterator(path("pictures")))
    pictures.insert(picture.path());
  ASSERT_GT(pictures.size(), 1U);
  fs::remove(path("out.html"));
  for (const fs::path& picture : pictures) fs::remove(picture);
  fs::create_directory(*pictures.rbegin());
  const std::set<std::string> before = files();
  const Outcome o = program(report);
  EXPECT_EQ(o.code, environment);
  EXPECT_EQ(o.out, "");
  EXPECT_EQ(files(), before);
}

}  // namespace
