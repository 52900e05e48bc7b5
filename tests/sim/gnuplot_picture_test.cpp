// What gnuplot makes of drawings, looked at by others: a PNG's pixels, a PDF's texts and pixels by
// poppler.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "program.hpp"
#include "sim/command/gnuplot.hpp"
#include "sim/picture/image_provenance.hpp"
#include "sim/picture/svg.hpp"

namespace sim {
namespace {

class GnuplotPicture : public CommandLine {
 protected:
  void SetUp() override {
    for (const auto& [name, option] : {std::pair{"gnuplot", "--version"}, {"pdftoppm", "-v"}})
      if (start_tool(name, {option}).finish().code != 0) GTEST_SKIP() << "needs " << name;
  }

  void draw(const SvgDrawing& drawing, PaperFormat format, const std::string& name) const {
    const auto bytes = drawn_by_gnuplot({drawing.finished()}, format);
    ASSERT_TRUE(bytes);
    write(name, *bytes);
  }

  /// A PNG of two pixels for each of the drawing's, be it of the PNG or of the PDF.
  void draw_pixels(const SvgDrawing& drawing, PaperFormat format) const {
    if (format == PaperFormat::png) return draw(drawing, format, "p.png");
    draw(drawing, format, "p.pdf");
    tool("pdftoppm", {"-r", "192", "-png", "-singlefile", "p.pdf", "p"});
  }

  /// The size, and what is at each place: a line each (png_pixels.py).
  Words looked_at(const Words& places) const {
    Words words{COSYS_SOURCE_DIR "/tests/sim/png_pixels.py", "p.png"};
    words.insert(words.end(), places.begin(), places.end());
    std::istringstream lines(tool("/usr/bin/python3", words));
    Words found;
    for (std::string line; std::getline(lines, line);) found.push_back(line);
    found.resize(places.size() + 1, "nothing said");
    return found;
  }

  struct Place {
    const char *at, *colour;
  };
  void expect_colours(const std::vector<Place>& places) const {
    Words words;
    for (const Place& place : places) words.emplace_back(place.at);
    const Words found = looked_at(words);
    for (std::size_t i = 0; i < places.size(); ++i)
      EXPECT_LT(distance(found[i + 1], places[i].colour), 12)
          << places[i].at << " is " << found[i + 1] << " and not " << places[i].colour;
  }

  /// The columns and rows that dark things take of a box.
  std::vector<int> dark_box(const std::string& box) const {
    std::istringstream numbers(looked_at({box})[1]);
    std::vector<int> found;
    for (int number = 0; numbers >> number;) found.push_back(number);
    found.resize(4, -999);
    return found;
  }

  std::string text_of(const std::string& pdf) const {
    return tool("pdftotext", {"-layout", pdf, "-"});
  }

 private:
  /// Of the channel that is most apart, of 255.
  static int distance(const std::string& one, const std::string& other) {
    int most = one.size() == other.size() ? 0 : 255;
    for (std::size_t i = 1; i + 1 < one.size() && most < 255; i += 2)
      most = std::max(most, std::abs(std::stoi(one.substr(i, 2), nullptr, 16) -
                                     std::stoi(other.substr(i, 2), nullptr, 16)));
    return most;
  }
};

constexpr auto formats = {PaperFormat::png, PaperFormat::pdf};

TEST_F(GnuplotPicture, HasTheColoursOfTheSheetAtTheirPlaces) {
  SvgDrawing drawing(100, 60, "t", "d");
  drawing.rectangle({10, 10}, 20, 10, "fill1");
  drawing.rectangle({25, 10}, 20, 10, "heat7");
  drawing.rectangle({60, 10}, 20, 10, "frame");
  drawing.path("M10 40H50V55", "curve2");
  drawing.line({60, 40}, {90, 40}, "grid");
  drawing.path("M70 50m-2.5 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0", "curve3 dot");
  for (const PaperFormat format : formats) {
    draw_pixels(drawing, format);
    EXPECT_EQ(looked_at({})[0], "200 120");
    expect_colours({{"0,0", "#ffffff"},
                    {"199,119", "#ffffff"},
                    {"24,30", "#0072b2"},
                    {"16,30", "#ffffff"},
                    {"56,30", "#46327e"},
                    {"86,30", "#46327e"},
                    {"93,30", "#ffffff"},
                    {"140,30", "#ffffff"},
                    {"60,77", "#ffffff"},
                    {"60,82", "#ffffff"},
                    {"96,100", "#ffffff"},
                    {"103,100", "#ffffff"},
                    {"140,100", "#ffffff"}});
    if (format == PaperFormat::pdf) continue;  // its places are whole twentieths of points
    expect_colours({{"20,30", "#0072b2"},
                    {"19,30", "#ffffff"},
                    {"60,79", "#d55e00"},
                    {"60,80", "#d55e00"},
                    {"60,78", "#ffffff"},
                    {"60,81", "#ffffff"},
                    {"99,100", "#d55e00"},
                    {"100,100", "#d55e00"},
                    {"140,19", "#bdbdbd"},
                    {"140,20", "#bdbdbd"},
                    {"140,79", "#dedede"},
                    {"140,80", "#dedede"},
                    {"135,100", "#009e73"},
                    {"145,100", "#009e73"},
                    {"140,95", "#009e73"}});
  }
}

TEST_F(GnuplotPicture, LetsWhatIsSeenThroughAddUp) {
  SvgDrawing drawing(100, 60, "t", "d");
  drawing.path("M10 10L90 10", "contour");
  for (int i = 0; i < 2; ++i) drawing.path("M10 30H90", "eye");
  drawing.rectangle({10, 40}, 20, 10, "fill0");
  for (int i = 0; i < 2; ++i) drawing.rectangle({40, 40}, 20, 10, "fill0");
  for (const PaperFormat format : formats) {
    draw_pixels(drawing, format);
    expect_colours({{"100,20", "#d55e00"}, {"40,90", "#dbdbdb"}, {"100,90", "#c4c4c4"}});
    if (format == PaperFormat::png) expect_colours({{"100,59", "#8fc1dd"}, {"100,60", "#8fc1dd"}});
  }
}

// Where a dash of the ninth period begins and ends says whether their lengths are right.
TEST_F(GnuplotPicture, HasDashesAsLongAsTheSheetSays) {
  SvgDrawing drawing(100, 40, "t", "d");
  drawing.path("M5 10L95 10", "contour theory");
  for (const PaperFormat format : formats) {
    draw_pixels(drawing, format);
    expect_colours({{"12,20", "#d55e00"},
                    {"20,20", "#d55e00"},
                    {"24,20", "#ffffff"},
                    {"28,20", "#ffffff"},
                    {"172,20", "#d55e00"},
                    {"180,20", "#d55e00"},
                    {"184,20", "#ffffff"},
                    {"188,20", "#ffffff"}});
  }
  SvgDrawing thin(100, 40, "t", "d");
  thin.path("M5 10L95 10", "theory");
  draw_pixels(thin, PaperFormat::png);
  expect_colours({{"172,20", "#222222"}, {"180,20", "#222222"}, {"185,20", "#ffffff"}});
}

TEST_F(GnuplotPicture, PutsTextsWhereTheirAnchorsAre) {
  SvgDrawing drawing(200, 120, "t", "d");
  drawing.text({20, 30}, "HH", "");
  drawing.text({100, 60}, "HH", "middle");
  drawing.text({180, 90}, "HH", "end");
  drawing.text({20, 110}, "HH", "heading");
  for (const PaperFormat format : formats) {
    draw_pixels(drawing, format);
    const auto start = dark_box("0:200,0:90"), middle = dark_box("0:400,90:140");
    const auto end = dark_box("200:400,140:200"), heading = dark_box("0:200,180:240");
    EXPECT_NEAR(start[0], 42, 2) << "behind the letter's own blank";
    EXPECT_NEAR((middle[0] + middle[1]) / 2.0, 200, 2);
    EXPECT_NEAR(end[1], 358, 2);
    EXPECT_NEAR(start[3], 59, 1) << "it stands on its line";
    EXPECT_NEAR(middle[3], 119, 1);
    EXPECT_NEAR(start[3] - start[2], 17, 2) << "12 pixels of the drawing, of which an H has 0.73";
    EXPECT_NEAR(heading[3], 219, 1);
    EXPECT_NEAR(heading[3] - heading[2], 21, 2) << "15 pixels";
  }
}

TEST_F(GnuplotPicture, HasTextsAsTextInTheFontsOfTheSheet) {
  SvgDrawing drawing(200, 120, "t", "d");
  drawing.text({10, 30}, "A heading", "heading");
  drawing.text({100, 60}, "letters", "character");
  drawing.text({10, 90}, "plain", "");
  draw(drawing, PaperFormat::pdf, "p.pdf");
  const std::string fonts = tool("pdffonts", {"p.pdf"});
  EXPECT_NE(fonts.find("Bold"), std::string::npos) << fonts;
  EXPECT_NE(fonts.find("Mono"), std::string::npos) << fonts;
  const std::string text = text_of("p.pdf");
  for (const char* words : {"A heading", "letters", "plain"})
    EXPECT_NE(text.find(words), std::string::npos) << text;
}

TEST_F(GnuplotPicture, ShowsHostileTextsAsTheyAre) {
  const Words texts{"\"; system(\"touch stolen\"); \"",
                    "`touch stolen`",
                    "'; !touch stolen",
                    "@stolen {/Bold x} a_b^2 &{x} ~a{b}",
                    "\\n \\101 \\",
                    "#1, 0.1 m\u00b2 1e-3 %s $d0",
                    "<b>&amp;</b>",
                    "end"};
  SvgDrawing drawing(400, 300, "t", "d");
  for (std::size_t i = 0; i < texts.size(); ++i)
    drawing.text({10, 20 + 30 * static_cast<double>(i)}, texts[i], i % 2 == 0 ? "" : "heading");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder());
  draw(drawing, PaperFormat::pdf, "p.pdf");
  draw(drawing, PaperFormat::png, "p.png");
  std::filesystem::current_path(before);
  const std::string text = text_of("p.pdf");
  for (const std::string& words : texts)
    EXPECT_NE(text.find(words), std::string::npos) << words << " in\n" << text;
  EXPECT_EQ(files(), (std::set<std::string>{"p.pdf", "p.png"}));
}

TEST_F(GnuplotPicture, StandsWhateverItIsGiven) {
  SvgDrawing drawing(400, 300, "t", "d");
  drawing.path("M1 1", "curve1");  // of one point
  drawing.text({10, 20}, "", "");
  drawing.text({10, 40}, "the first\n\tline", "");
  drawing.text({10, 60}, "\xff\xfe no UTF-8", "");
  drawing.text({10, 80}, std::string(20000, 'x') + "\u20ac", "");
  draw(drawing, PaperFormat::pdf, "p.pdf");
  EXPECT_NE(text_of("p.pdf").find("the first line\n"), std::string::npos);
  draw(SvgDrawing(10, 10, "t", "d"), PaperFormat::png, "p.png");
  expect_colours({{"10,10", "#ffffff"}});
}

TEST_F(GnuplotPicture, SaysThatItIsOursAndIsWhole) {
  SvgDrawing drawing(50, 30, "t", "d");
  drawing.text({10, 20}, "text", "");
  draw(drawing, PaperFormat::png, "p.png");
  draw(drawing, PaperFormat::pdf, "p.pdf");
  EXPECT_TRUE(is_own_png(path("p.png")));
  EXPECT_TRUE(is_own_pdf(path("p.pdf")));
  EXPECT_FALSE(is_own_png(path("p.pdf")));
  EXPECT_FALSE(is_own_pdf(path("p.png")));
  EXPECT_EQ(looked_at({})[0], "100 60") << "with all checksums right";
  const Outcome read = start_tool("pdfinfo", {"p.pdf"}).finish();
  EXPECT_NE(read.out.find("Page size:       38 x 23 pts"), std::string::npos) << read.out;
  EXPECT_EQ(read.err, "");
}

TEST(ImageProvenance, IsNotWhatAnotherProgramMade) {
  EXPECT_FALSE(marked_as_own("", PaperFormat::png));
  EXPECT_FALSE(marked_as_own("\x89PNG\r\n\x1a\n cut", PaperFormat::png));
  EXPECT_FALSE(marked_as_own("%PDF-1.5\n cut", PaperFormat::pdf));
  EXPECT_FALSE(marked_as_own("%PDF-1.5\nx\nstartxref\n1\n%%EOF\n", PaperFormat::png));
}

}  // namespace
}  // namespace sim
