#include "sim/page/paper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "sim/picture/svg.hpp"
#include "sim/text/letters.hpp"

namespace sim {
namespace {

// Pixels.
constexpr double paper_width = 794, paper_height = 1123, paper_margin = 48;
constexpr double print_width = paper_width - 2 * paper_margin;
constexpr double line_step = 17, row_step = 16, listing_step = 12, gap = 14;
constexpr double letter = 6.3, listing_letter = 6.1;  // a little wider than most are
constexpr double tallest_picture = 310;
constexpr std::size_t most_pages = 4;

/// Lines of at most so many letters, but for a word that is longer.
std::vector<std::string> wrapped(const std::string& text, std::size_t letters) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;)
    if (!lines.empty() && letters_in(lines.back()) + 1 + letters_in(word) <= letters)
      lines.back() += ' ' + word;
    else
      lines.push_back(word);
  return lines;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

/// A table as far as it has room, and how much of it has none.
struct PaperTable {
  std::vector<double> widths;  // of the columns that are shown
  std::size_t rows = 0;        // that are shown
  double scale = 1;
};

/// The pages that are full, and the one that is written on.
class Paper {
 public:
  explicit Paper(std::string title) : title_(std::move(title)), page_(blank()) {}

  void text(const std::string& words, const char* style) {
    if (!has_room(line_step) && !turn()) return;
    y_ += line_step;
    page_.text({paper_margin, y_}, words, style);
  }
  void paragraphs(const std::string& all) {
    constexpr auto letters = static_cast<std::size_t>(print_width / letter);
    for (const std::string& paragraph : lines_of(all)) {
      for (const std::string& line : wrapped(paragraph, letters)) text(line, "");
      y_ += line_step / 4;
    }
  }
  void heading(const std::string& words) {
    y_ += gap;
    text(words, "heading");
    y_ += line_step / 4;
  }

  /// Whether it had room; the last page is left for others.
  bool picture(const std::string& drawing) {
    const SvgPoint size = size_of_drawing(drawing);
    const double scale = std::min({1.0, print_width / size.x, tallest_picture / size.y});
    const double height = scale * size.y + gap;
    if (!has_room(height) && (pages_.size() + 2 >= most_pages || !turn())) return false;
    page_.place(drawing, {paper_margin, y_ + gap}, scale);
    y_ += height;
    return true;
  }

  void table(const PageTable& table) {
    const PaperTable shown = table_in(table, paper_height - paper_margin - y_ - 2 * line_step);
    SvgDrawing drawing(print_width / shown.scale, 0, "", "");
    double y = row_step;
    draw_row(drawing, table.head, shown, y);
    drawing.line({0, y + 4}, {print_width / shown.scale, y + 4}, "axis");
    for (std::size_t i = 0; i < shown.rows; ++i)
      draw_row(drawing, table.rows[i], shown, y += row_step);
    page_.place(drawing.finished(), {paper_margin, y_}, shown.scale);
    y_ += shown.scale * y + gap;
    tell_rest(table, shown);
  }

  /// A scenario, without the parts that stand behind it.
  void listing(const std::string& scenario) {
    const std::vector<std::string> lines = lines_of(scenario.substr(0, scenario.find("[[part]]")));
    constexpr auto letters = static_cast<std::size_t>(print_width / listing_letter);
    const auto room = static_cast<std::size_t>(
        std::max(0.0, (paper_height - paper_margin - y_ - 2 * line_step) / listing_step));
    const std::size_t shown = std::min(lines.size(), room);
    for (std::size_t i = 0; i < shown; ++i)
      page_.text({paper_margin, y_ += listing_step}, shortened(lines[i], letters), "listing");
    y_ += gap;
    text(shown < lines.size() ? "More lines, and all parts, are in the report."
                              : "All numbers of the parts are in the report.",
         "small");
  }

  /// Whether there was a page left.
  bool turn() {
    if (pages_.size() + 1 >= most_pages) return false;
    pages_.push_back(page_.finished());
    page_ = blank();
    return true;
  }
  bool has_room(double height) const { return y_ + height <= paper_height - paper_margin; }

  std::vector<std::string> finished() && {
    pages_.push_back(page_.finished());
    return std::move(pages_);
  }

 private:
  SvgDrawing blank() {
    SvgDrawing page(paper_width, paper_height, title_, "A page of the report");
    page.text({paper_margin, paper_height - paper_margin / 2},
              fmt::format("{} \u2014 page {} \u2014 by cosys-sim", title_, pages_.size() + 1),
              "small");
    y_ = paper_margin;
    return page;
  }

  static PaperTable table_in(const PageTable& table, double height) {
    constexpr double smallest = 0.6;
    PaperTable shown;
    double width = 0;
    for (std::size_t column = 0; column < table.head.size(); ++column) {
      std::size_t letters = letters_in(table.head[column]);
      for (const auto& row : table.rows) letters = std::max(letters, letters_in(row[column]));
      const double wide = letter * static_cast<double>(letters + 2);
      if (width + wide > print_width / smallest) break;
      width += wide;
      shown.widths.push_back(wide);
    }
    shown.scale = std::clamp(print_width / width, smallest, 1.0);
    const double rows = std::max(0.0, height / (row_step * shown.scale) - 1);
    shown.rows = std::min(table.rows.size(), static_cast<std::size_t>(rows));
    return shown;
  }

  static void draw_row(SvgDrawing& drawing, const std::vector<std::string>& cells,
                       const PaperTable& shown, double y) {
    double x = 0;
    for (std::size_t column = 0; column < shown.widths.size(); ++column) {
      drawing.text({x, y}, cells[column], "");
      x += shown.widths[column];
    }
  }

  void tell_rest(const PageTable& table, const PaperTable& shown) {
    const std::size_t rows = table.rows.size() - shown.rows;
    const std::size_t columns = table.head.size() - shown.widths.size();
    if (rows + columns > 0)
      text(fmt::format("{} more rows and {} more columns are in the report.", rows, columns),
           "small");
  }

  std::string title_;
  std::vector<std::string> pages_;
  double y_ = 0;
  SvgDrawing page_;
};

/// Those without room are named.
void add_pictures(Paper& paper, const Page& page) {
  std::string left_out;
  for (const PageSection& section : page.sections) {
    const PagePicture* picture = section.trial     ? &section.trial->still
                                 : section.picture ? &*section.picture
                                                   : nullptr;
    if (picture == nullptr || paper.picture(picture->svg)) continue;
    left_out += (left_out.empty() ? "" : ", ") + section.heading;
  }
  if (!left_out.empty()) paper.paragraphs("More pictures are in the report: " + left_out + ".");
}

/// The widest of the last ones: all numbers.
void add_numbers(Paper& paper, const Page& page) {
  const auto numbers =
      std::find_if(page.sections.rbegin(), page.sections.rend(),
                   [](const PageSection& section) { return section.table.has_value(); });
  if (numbers == page.sections.rend()) return;
  paper.heading(numbers->heading);
  paper.table(*numbers->table);
}

void add_scenarios(Paper& paper, const Page& page) {
  for (const PageSection& section : page.sections) {
    if (section.preformatted.empty()) continue;
    constexpr double least_room = 200;
    if (!paper.has_room(least_room)) paper.turn();
    paper.heading(section.heading);
    paper.paragraphs(section.text);
    paper.listing(section.preformatted);
  }
}

}  // namespace

std::vector<std::string> paper_pages(const Page& page) {
  Paper paper(page.title);
  paper.text(page.title, "heading");
  paper.paragraphs(page.summary);
  add_pictures(paper, page);
  add_numbers(paper, page);
  add_scenarios(paper, page);
  return std::move(paper).finished();
}

}  // namespace sim
