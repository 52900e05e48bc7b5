// `cosys-sim report` from outside: what it writes, and what it refuses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "occurrences.hpp"
#include "report_case.hpp"

namespace sim {
namespace {

class ReportCommand : public ReportCase {};

TEST_F(ReportCommand, SaysWhatWasCountedInOneFile) {
  run("near", "receiver.range_m = [1, 11]", {"--set", "device.message=\"IND <b> & OK\""});
  const std::string page = report({"near.h5"});
  EXPECT_EQ(page.find("<!DOCTYPE html>\n"), 0U);
  EXPECT_NE(page.find("32 frames were simulated at 2 points; "), std::string::npos);
  EXPECT_NE(page.find("The link reaches 1 to 11 m at 1 % frame loss"), std::string::npos);
  EXPECT_NE(page.find("<p>To repeat it: cosys-sim run near.toml"), std::string::npos);
  EXPECT_NE(page.find("IND &lt;b&gt; &amp; OK"), std::string::npos) << "the scenario";
  for (const char* what : {"<b>", " src=", "url(", "@import"})
    EXPECT_EQ(occurrences(page, what), 0U) << what;
  EXPECT_EQ(occurrences(page, " href="), occurrences(page, " href=\"#section-"));
  EXPECT_EQ(files(), (std::set<std::string>{"near.toml", "near.h5", "r.html"}));
  EXPECT_NE(report({"near.h5"}).find("near"), std::string::npos) << "its own reports it replaces";
}

TEST_F(ReportCommand, ShowsTheFirstTrialThatIsMisread) {
  run("edge", "receiver.range_m = [12.15]", {"--set", "receiver.module=TSSP4056"});
  const Outcome traced = program({"trace", "edge.toml", "--set", "receiver.module=TSSP4056",
                                  "--trial", "0", "-o", "first.vcd"});
  ASSERT_EQ(traced.code, 0) << traced.err;
  ASSERT_NE(program({"decode", "first.vcd"}).out.find("  ok  "), std::string::npos)
      << "the first of all is heard";
  const std::string page = report({"edge.h5"});
  EXPECT_NE(page.find("; 1 of them were lost: frame loss ratio "), std::string::npos);
  EXPECT_EQ(occurrences(page, "<h2>Trial 0 of point 0</h2>"), 0U);
  EXPECT_EQ(occurrences(page, "slow AGC"), 0U) << "it has none";
  EXPECT_EQ(occurrences(page, " of point 0</h2>"), 1U);
}

TEST_F(ReportCommand, DescribesOfIdealReceiversWhatTheyHave) {
  run("edge", "receiver.range_m = [1, 11]");
  const std::string module = report({"edge.h5"});
  EXPECT_EQ(occurrences(module, "before and behind the band-pass"), 3U) << "picture, caption";
  EXPECT_GT(occurrences(module, "by slow AGC"), 0U);
  run("ideal", "receiver.ebn0_db = [2, 4]",
      {"--set", "receiver.module=ideal-coherent", "--set", "simulation.warmup_messages=0"});
  const std::string ideal = report({"ideal.h5"});
  EXPECT_EQ(occurrences(ideal, "light and noise (Welch"), 3U);
  EXPECT_EQ(occurrences(ideal, "dB below the signal in the bandwidth of a bit.</p>"), 1U);
  EXPECT_EQ(occurrences(ideal.substr(0, ideal.find("<h2>The scenario")), "behind the band-pass"),
            0U);
}

TEST_F(ReportCommand, SaysWhyThereIsNoTrial) {
  const std::string none =
      " has no waveform to show; `cosys-sim trace` draws its pin (-o x.svg).</p>";
  run("wave", "receiver.range_m = [1, 11]");
  EXPECT_EQ(occurrences(report({"wave.h5"}), none), 0U);
  run("step", "receiver.range_m = [1, 11]",
      {"--set", "simulation.fidelity=envelope", "--set", "simulation.warmup_messages=1"});
  EXPECT_EQ(
      occurrences(report({"step.h5"}), "<p>A trial of fidelity = &quot;envelope&quot;" + none), 1U);
  const Outcome traced = program({"trace", "step.toml", "--set", "simulation.fidelity=envelope",
                                  "--set", "simulation.warmup_messages=1", "-o", "x.svg"});
  EXPECT_EQ(traced.code, 0) << traced.err;
}

TEST_F(ReportCommand, SaysWhyNoTrialIsShownOfImportanceSampling) {
  run("rare", "receiver.ebn0_db = [9]",
      {"--set", "receiver.module=ideal-coherent", "--set", "simulation.warmup_messages=0", "--set",
       "simulation.method=importance"});
  EXPECT_NE(report({"rare.h5"}).find("<p>No trial is shown: importance sampling does not draw"),
            std::string::npos);
}

TEST_F(ReportCommand, ComparesResultsInOnePicture) {
  run("one", "receiver.range_m = [1, 11]");
  run("two", "receiver.range_m = [1, 12]", {"--set", "led.current_ma=50"});
  const std::string page = report({"one.h5", "two.h5"});
  EXPECT_EQ(occurrences(page, "<h2>Frame loss</h2>"), 1U);
  EXPECT_NE(page.find("<h2>Differences</h2>\n<details open><summary>Table (2 rows)</summary>"),
            std::string::npos);
  EXPECT_NE(page.find("<td>receiver.range_m</td><td>1, 11 m</td><td>1, 12 m</td>"),
            std::string::npos);
  EXPECT_NE(page.find("<td>led.current_ma</td><td>100 mA</td><td>50 mA</td>"), std::string::npos);
  EXPECT_NE(page.find(">one, simulated</text>"), std::string::npos);
  EXPECT_NE(page.find(">two, simulated</text>"), std::string::npos);
  for (const char* heading : {"All numbers", "The scenario", "What became of the frames"})
    for (const char* name : {"one", "two"})
      EXPECT_EQ(occurrences(page, fmt::format("<h2>{}: {}</h2>", name, heading)), 1U);
}

TEST_F(ReportCommand, SaysWhoseAPictureIsThatOneResultAloneHas) {
  run("one", "receiver.range_m = [1, 11]");
  run("two", "led.current_ma = [50, 100]");
  const std::string page = report({"one.h5", "two.h5", "--svg", "p"});
  for (const char* name :
       {"one-frame-loss", "two-frame-loss", "one-fates", "two-fates", "one-trial"})
    EXPECT_TRUE(std::filesystem::exists(path(fmt::format("p/{}.svg", name)))) << name;
  for (const char* heading : {"one: Frame loss", "two: Frame loss", "two: Bit errors"})
    EXPECT_EQ(occurrences(page, fmt::format("<h2>{}</h2>", heading)), 1U) << heading;
}

TEST_F(ReportCommand, LooksCloserAtTheLinkThatComesFirst) {
  run("many", "receiver.module = [\"TSOP4856\", \"TSSP4056\"]\nreceiver.range_m = [1, 5, 40]");
  const std::string page = report({"many.h5"});
  EXPECT_NE(
      page.find("<div class=\"verdict\">\n<p>TSSP4056 reaches furthest: 5 to 40 m at 1 % frame "
                "loss (5 to 40 m for 8 of 10 units); last TSOP4856, 1 to 5 m.</p>\n"),
      std::string::npos);
  EXPECT_NE(page.find("<p>One point is looked at closer: at receiver.module = TSSP4056, "
                      "receiver.range_m = 40 m, "),
            std::string::npos);
  EXPECT_NE(page.find("<tr><td>1</td><td>TSSP4056</td><td>5 to 40 m, 21 % possible</td>"
                      "<td>5 to 40 m</td></tr>"),
            std::string::npos);
  EXPECT_NE(page.find("<tr><td>2</td><td>TSOP4856</td><td>1 to 5 m, 21 % possible</td>"
                      "<td>1 to 40 m</td></tr>"),
            std::string::npos);
  EXPECT_NE(page.find("<th scope=\"col\">receiver.range_m at which frame loss passes 1 %</th>"
                      "<th scope=\"col\">8 of 10 units</th>"),
            std::string::npos);
  EXPECT_NE(page.find("8 of 10 units, each with what nobody printed drawn within its bounds, end "),
            std::string::npos);
}

TEST_F(ReportCommand, SaysOfUnitsHowManyCarry) {
  run("units", "receiver.unit = \"0:1:4\"\nreceiver.range_m = [1, 40]");
  const std::string page = report({"units.h5"});
  EXPECT_EQ(occurrences(page, "<h2>How many units carry</h2>"), 1U);
  EXPECT_EQ(occurrences(page, "<h2>Share of units that carry</h2>"), 1U);
  EXPECT_EQ(occurrences(page, "<h2>Frame loss</h2>"), 0U) << "a curve for each unit";
  EXPECT_NE(page.find("<td>40</td><td>4</td><td>0 % ["), std::string::npos) << "unit 0 is none";
}

TEST_F(ReportCommand, TellsResultsOfOneNameApart) {
  run("one", "receiver.range_m = [1, 11]");
  std::filesystem::create_directory(path("old"));
  std::filesystem::copy_file(path("one.h5"), path("old/one.h5"));
  const std::string page = report({"one.h5", "old/one.h5"});
  EXPECT_NE(page.find("<h2>Differences</h2>\n<p>All keys of their scenarios are set alike."),
            std::string::npos);
  EXPECT_NE(page.find(">one.h5, simulated</text>"), std::string::npos);
  EXPECT_NE(page.find(">old/one.h5, simulated</text>"), std::string::npos);
}

TEST_F(ReportCommand, PutsPicturesIntoAFolder) {
  run("near", "receiver.range_m = [1, 11]");
  const Outcome o = program({"report", "near.h5", "--svg", "a/b"});
  std::string names = "report.html\n";
  for (const char* name : {"bit-errors", "bursts-of-wrong-bits", "delay-of-edges", "eye", "fates",
                           "frame-loss", "how-far-it-reaches", "scene", "spectrum", "trial",
                           "wrong-bits-since-the-message-began", "wrong-bits"}) {
    const std::string place = fmt::format("a/b/{}.svg", name);
    names += place + "\n";
    EXPECT_EQ(content(path(place)).find("<!-- by cosys-sim -->\n<svg "), 0U) << name;
    EXPECT_EQ(content(path(place)).find("color-scheme"), std::string::npos)
        << "light on any screen";
  }
  EXPECT_EQ(o.out, names) << o.err;
  write("a/b/fates.svg", "mine");
  expect_refused({"report", "near.h5", "--svg", "a/b"}, 2,
                 "cannot write a/b/fates.svg (it exists and is not a picture of cosys-sim) choose "
                 "another name");
  EXPECT_EQ(content(path("a/b/fates.svg")), "mine");
  expect_refused({"report", "near.h5", "--svg", "near.toml"}, 3,
                 "cannot create the folder near.toml (Not a directory) choose another place");
}

TEST_F(ReportCommand, RefusesWhatIsNoResult) {
  run("near", "receiver.range_m = [1, 2]");
  const std::string whole = content(path("near.h5"));
  write("cut.h5", whole.substr(0, whole.size() / 2));
  write("text.h5", "receiver.range_m = 1\n");
  for (const std::string name : {"cut.h5", "text.h5", "near.toml"})
    expect_refused({"report", name}, 2,
                   name + " (not a result of cosys-sim, or damaged) give a file that run wrote");
  expect_refused({"report", "none.h5"}, 2, "none.h5 (no such file) check the path");
  expect_refused({"report", "."}, 2, ". (a folder, not a result file) name a file in it");
  write("mine.html", "mine");
  expect_refused(
      {"report", "near.h5", "-o", "mine.html"}, 2,
      "cannot write mine.html (it exists and is not a report of cosys-sim) choose another "
      "name");
  EXPECT_EQ(content(path("mine.html")), "mine");
  expect_refused({"report", "near.h5", "-o", "-"}, 2,
                 "--output - (a report goes to a file, not to stdout) name a file, such as "
                 "report.html");
  EXPECT_FALSE(std::filesystem::exists(path("-")));
  expect_refused({"report", "near.h5", "-o", "/proc/r.html"}, 3,
                 "cannot write /proc/r.html (No such file or directory) choose another place");
  expect_refused({"report", "near.h5", "-o", "none/r.html"}, 3,
                 "cannot write none/r.html (its folder does not exist) create the folder or choose "
                 "another");
}

TEST_F(ReportCommand, RefusesAResultThatIsNamedTwice) {
  run("near", "receiver.range_m = [1, 2]");
  for (const std::string name : {"near.h5", "./near.h5"})
    expect_refused({"report", "near.h5", name}, 2,
                   name + " (it is named twice) name each result once");
}

TEST_F(ReportCommand, RefusesNewerFormats) {
  run("near", "receiver.range_m = [1, 2]");
  std::string file = content(path("near.h5"));
  const std::size_t at = file.find("1.3", file.find("format_version"));
  ASSERT_NE(at, std::string::npos);
  for (const std::string version : {"1.9", "2.0", "9.3"}) {
    write("near.h5", file.replace(at, 3, version));
    expect_refused({"report", "near.h5"}, 2,
                   "near.h5 (its format " + version +
                       " is newer than 1.3, the newest known here) read it with the cosys-sim that "
                       "wrote it, or a later one");
  }
  write("near.h5", file.replace(at, 3, "1.2"));
  EXPECT_EQ(program({"report", "near.h5"}).code, 0);
}

TEST_F(ReportCommand, RunDrawsItsCurvesAsText) {
  write_scenario("near.toml", "receiver.range_m = [1, 6, 11]");
  const Outcome o = program({"run", "near.toml", "-q", "--plot"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("bit error ratio (BER), logarithmic; o simulated"), std::string::npos)
      << o.out;
  EXPECT_NE(
      o.out.find(
          "frame loss ratio (FLR), logarithmic; o simulated,\n            v less than that\n"),
      std::string::npos);
  EXPECT_NE(o.out.find(" receiver.range_m [m] "), std::string::npos);
  write("still.toml", "[stop]\nmax_frames = 2\n");
  EXPECT_NE(program({"run", "still.toml", "-q", "--plot"})
                .out.find("nothing to plot: no number is swept"),
            std::string::npos);
}

}  // namespace
}  // namespace sim
