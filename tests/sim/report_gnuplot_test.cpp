// `cosys-sim report --png` and `--pdf` from outside: with gnuplot itself, with none, and with such
// as fail.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "report_case.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

/// Where programs are looked for meanwhile.
class SearchPath {
 public:
  explicit SearchPath(const std::string& folders) : before_(std::getenv("PATH")) {
    ::setenv("PATH", folders.c_str(), 1);
  }
  SearchPath(const SearchPath&) = delete;
  SearchPath& operator=(const SearchPath&) = delete;
  ~SearchPath() { ::setenv("PATH", before_.c_str(), 1); }

  const std::string& before() const { return before_; }

 private:
  std::string before_;
};

/// A sweep of which a report draws the fewest pictures: no bit is wrong. Steps have no waveform.
const std::string few = "receiver.range_m = [1, 2]";

class ReportGnuplot : public ReportCase {
 protected:
  bool is_there(const std::string& tool) const {
    return start_tool("sh", {"-c", "command -v " + tool}).finish().code == 0;
  }
  bool can_be_read() const { return is_there("gnuplot") && is_there("pdftotext"); }

  /// A gnuplot that has all terminals, and does this where it shall draw.
  SearchPath fake(const std::string& drawing) const {
    const fs::path program = folder().parent_path() / "bin" / "gnuplot";
    fs::create_directory(program.parent_path());
    std::ofstream(program) << "#!/bin/sh\nscript=$(cat)\ncase $script in *plot*)\n"
                           << drawing << "\n;; esac\n";
    fs::permissions(program, fs::perms::owner_all);
    return SearchPath(program.parent_path().string() + ":" + std::getenv("PATH"));
  }

  /// The numbers of an attribute such as width="720".
  static double attribute(const std::string& element, const std::string& name) {
    const std::size_t at = element.find(" " + name + "=\"");
    return at == std::string::npos ? -1 : std::stod(element.substr(at + name.size() + 3));
  }
  static std::string element(const std::string& svg, const std::string& begins) {
    const std::size_t at = svg.find(begins);
    return at == std::string::npos ? "" : svg.substr(at, svg.find('\n', at) - at);
  }

  std::string pixels(const std::string& png, const Words& places = {}) const {
    Words words{COSYS_SOURCE_DIR "/tests/sim/png_pixels.py", png};
    words.insert(words.end(), places.begin(), places.end());
    return tool("/usr/bin/python3", words);
  }

  /// p/NAME.png and d/NAME.pdf have the size and the heading of p/NAME.svg.
  void expect_same_picture(const std::string& name) const {
    const std::string svg = content(path("p/" + name + ".svg"));
    const double width = attribute(svg, "width"), height = attribute(svg, "height");
    EXPECT_EQ(pixels("p/" + name + ".png"), fmt::format("{} {}\n", 2 * width, 2 * height)) << name;
    const std::string pdf = "d/" + name + ".pdf";
    EXPECT_NE(tool("pdfinfo", {pdf})
                  .find(fmt::format("Page size:       {} x {} pts\n", std::ceil(0.75 * width),
                                    std::ceil(0.75 * height))),
              std::string::npos)
        << name;
    std::string heading = element(svg, " class=\"heading\"");
    heading = heading.substr(heading.find('>') + 1);
    heading.resize(heading.find('<'));
    EXPECT_NE(tool("pdftotext", {pdf, "-"}).find(heading), std::string::npos) << name;
  }
};

TEST_F(ReportGnuplot, DrawsEveryPicture) {
  if (!can_be_read()) GTEST_SKIP() << "needs gnuplot and pdftotext";
  run("near", "receiver.range_m = [1, 11]\nled.current_ma = [50, 100]");
  const Outcome o = program({"report", "near.h5", "--svg", "p", "--png", "p", "--pdf", "d"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  const Words names{"bit-errors",
                    "bursts-of-wrong-bits",
                    "delay-of-edges",
                    "eye",
                    "fates",
                    "frame-loss",
                    "frame-loss-map",
                    "how-far-each-reaches",
                    "scene",
                    "spectrum",
                    "trial",
                    "wrong-bits",
                    "wrong-bits-since-the-message-began"};
  std::set<std::string> printed{"report.html"},
      there{"near.toml", "near.h5", "report.html", "p", "d"};
  for (const std::string& name : names) {
    for (const char* place : {"p/{}.svg", "p/{}.png", "d/{}.pdf"}) {
      printed.insert(fmt::format(fmt::runtime(place), name));
      there.insert(fmt::format(fmt::runtime(place), name));
    }
    expect_same_picture(name);
  }
  const std::string curve =
      element(content(path("p/frame-loss.svg")), "<line class=\"curve1\"");  // in the legend
  EXPECT_EQ(pixels("p/frame-loss.png", {fmt::format("{:.0f},{:.0f}", 2 * attribute(curve, "x1") + 9,
                                                    2 * attribute(curve, "y1"))}),
            "1440 956\n#0072b2\n");
  std::istringstream lines(o.out);
  std::set<std::string> said;
  for (std::string line; std::getline(lines, line);) said.insert(line);
  EXPECT_EQ(said, printed);
  EXPECT_EQ(files(), there);
}

TEST_F(ReportGnuplot, PrintsTheReportOnAtMostFourPages) {
  if (!can_be_read()) GTEST_SKIP() << "needs gnuplot and pdftotext";
  run("near", "receiver.range_m = [1, 2, 3, 4, 11]\nled.current_ma = [20, 50, 70, 100]");
  const Outcome o = program({"report", "near.h5", "--pdf", "paper.pdf"});
  EXPECT_EQ(o.out, "report.html\npaper.pdf\n") << o.err;
  const std::string facts = tool("pdfinfo", {"paper.pdf"});
  EXPECT_NE(facts.find("(A4)"), std::string::npos) << facts;
  const std::size_t pages = facts.find("\nPages:");
  ASSERT_NE(pages, std::string::npos) << facts;
  EXPECT_LE(std::stoi(facts.substr(pages + 7)), 4);
  const std::string words = tool("pdftotext", {"-layout", "paper.pdf", "-"});
  EXPECT_LT(words.find(" reaches furthest: "), words.find("hears \"IND 011111 OK\""));
  for (const char* there : {"How far each reaches", "Frame loss", "All numbers",
                            "To repeat it: ", "receiver.range_m = [1, 2, 3, 4, 11]", "page 1"})
    EXPECT_NE(words.find(there), std::string::npos) << there;
  write("paper.pdf", "mine");
  expect_refused(
      {"report", "near.h5", "--pdf", "paper.pdf"}, 2,
      "cannot write paper.pdf (it exists and is not a PDF of cosys-sim) choose another name");
  EXPECT_EQ(content(path("paper.pdf")), "mine");
}

TEST_F(ReportGnuplot, ShowsTextsOfUsersAsTheyAre) {
  if (!can_be_read()) GTEST_SKIP() << "needs gnuplot and pdftotext";
  run("near", few,
      {"--set", "device.message=IND \"; system('touch stolen') {/Bold `touch stolen` OK"});
  run("step", few,
      {"--set", "simulation.fidelity=envelope", "--set", "simulation.warmup_messages=1"});
  const std::string strange = "\"'`touch stolen` {:Bold @a}.h5";
  fs::rename(path("step.h5"), path(strange));
  const Words command{"report", "near.h5", strange, "--pdf", "."};
  const Outcome o = program(command);
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_FALSE(files().contains("stolen"));
  const std::string trial = tool("pdftotext", {"-layout", "near-trial.pdf", "-"});
  EXPECT_NE(trial.find("IND\u2423\";\u2423system('touch\u2423stolen')\u2423{/Bold"),
            std::string::npos)
      << trial;
  const std::string loss = tool("pdftotext", {"-layout", "frame-loss.pdf", "-"});
  EXPECT_NE(loss.find("\"'`touch stolen` {:Bold @a}, simulated"), std::string::npos) << loss;
}

// Before any work: a result that is not there is not missed.
TEST_F(ReportGnuplot, IsRefusedWhereThereIsNone) {
  for (const std::string option : {"--png", "--pdf"}) {
    const SearchPath nowhere(path("nowhere").string());
    expect_refused(
        {"report", "none.h5", option, "p"}, 3,
        option + " needs gnuplot (it is not installed) install gnuplot-nox, or use --svg");
  }
  const SearchPath nowhere(path("nowhere").string());
  expect_refused({"report", "none.h5", "--svg", "p"}, 2, "none.h5 (no such file) check the path");
}

TEST_F(ReportGnuplot, IsRefusedWhereItCannotDrawThese) {
  const SearchPath lesser = fake(
      "exit 0\n;; *pdfcairo*) echo 'gnuplot> set terminal pdfcairo\n     ^\n"
      "  line 0: unknown or ambiguous terminal type; type just set terminal for a list\n' >&2; "
      "exit 1");
  expect_refused(
      {"report", "none.h5", "--pdf", "p"}, 3,
      "--pdf needs gnuplot (it has no terminal pdfcairo) install gnuplot-nox, or use --svg");
  expect_refused({"report", "none.h5", "--png", "p"}, 2, "none.h5 (no such file) check the path");
  const SearchPath broken = fake(";; *) echo 'cannot open libcairo.so' >&2; exit 127");
  expect_refused({"report", "none.h5", "--png", "p"}, 3,
                 "--png needs gnuplot (cannot open libcairo.so) install gnuplot-nox, or use --svg");
}

TEST_F(ReportGnuplot, SaysWhyThereIsNoPicture) {
  run("near", few);
  const Words command{"report", "near.h5", "--svg", "p", "--png", "p"};
  {
    const SearchPath failing = fake("echo first >&2; echo ' out of ink' >&2; exit 2");
    expect_refused(command, 3, "gnuplot drew no picture (out of ink) use --svg");
  }
  {
    const SearchPath mute = fake("kill -9 $$");
    expect_refused(command, 3, "gnuplot drew no picture (it said nothing) use --svg");
  }
  const SearchPath other = fake("echo hello");
  expect_refused(command, 3, "gnuplot drew no picture (it wrote another thing) use --svg");
}

TEST_F(ReportGnuplot, EndsWhenItIsInterrupted) {
  run("near", few);
  auto expected = files();
  expected.insert("drawing");
  const std::string sleep = "sleep 61." + std::to_string(::getpid());
  const SearchPath slow = fake("touch drawing; exec " + sleep);
  Running report = start_program({"report", "near.h5", "--png", "p"});
  for (int tenths = 0; tenths < 600 && !fs::exists(path("drawing")); ++tenths)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const Outcome o = report.finish(SIGINT);
  EXPECT_EQ(o.code, 130);
  EXPECT_EQ(o.out, "");
  EXPECT_NE(o.err.find("interrupted (by a signal) nothing was written"), std::string::npos)
      << o.err;
  EXPECT_EQ(files(), expected);
  EXPECT_NE(start_tool("pgrep", {"-f", "^" + sleep + "$"}).finish().code, 0) << "it sleeps on";
}

TEST_F(ReportGnuplot, KeepsWhatIsNotOurs) {
  if (!is_there("gnuplot")) GTEST_SKIP() << "needs gnuplot";
  run("near", few);
  fs::create_directory(path("p"));
  for (const std::string kind : {"png", "pdf"}) {
    const std::string place = "p/fates." + kind;
    const std::string refusal =
        "cannot write " + place +
        " (it exists and is not a picture of cosys-sim) choose another name";
    write("script", "set terminal " + kind + "cairo\nset output '" + place + "'\nplot x\n");
    for (const bool is_drawn : {false, true}) {
      write(place, "mine");
      if (is_drawn) tool("gnuplot", {"script"});
      const std::string mine = content(path(place));
      expect_refused({"report", "near.h5", "--" + kind, "p"}, 2, refusal);
      EXPECT_EQ(content(path(place)), mine);
    }
  }
  expect_refused({"report", "near.h5", "--png", "near.toml"}, 3,
                 "cannot create the folder near.toml (Not a directory) choose another place");
}

}  // namespace
}  // namespace sim
