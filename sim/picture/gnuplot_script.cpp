#include "sim/picture/gnuplot_script.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "sim/picture/path_data.hpp"
#include "sim/picture/style_sheet.hpp"

namespace sim {
namespace {

/// What cairo's terminals of gnuplot make of what they are told. Their units are pixels of a PNG,
/// points of a PDF.
struct Terminal {
  double scale;      // units to a pixel of the drawing
  double linewidth;  // gnuplot's, that makes a line as wide as a pixel of the drawing
  double dash;       // units that a dash of 1 is long, for each unit of line width above 1
  bool snaps;        // lines along an axis are moved to the middle of a unit
};

constexpr double rim = 0.5;         // units of the paper on each side that are not plotted on
constexpr double unsnapped = 0.03;  // pixels; a line that far from an axis stays where it is
constexpr double raised = 0.375;    // of a font's size: a label's place above its line of writing

Terminal terminal_of(PaperFormat format) {
  if (format == PaperFormat::png) return {.scale = 2, .linewidth = 2, .dash = 0.25, .snaps = true};
  return {.scale = 0.75, .linewidth = 1.5, .dash = 0.275, .snaps = false};
}

/// White space is one blank, as in SVG.
std::string on_one_line(std::string_view text) {
  std::string line;
  for (const char c : text)
    if (std::iscntrl(static_cast<unsigned char>(c)) == 0 && c != ' ')
      line += c;
    else if (!line.ends_with(' '))
      line += ' ';
  return line;
}

/// In quotes, between which there is nothing that gnuplot could understand: letters, and octal
/// numbers for all other bytes. A digit behind such a number would be part of it.
std::string in_quotes(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    quoted += std::isalpha(byte) != 0 ? std::string(1, c) : fmt::format("\\{:03o}", byte);
  }
  return quoted + "\"";
}

/// Its first two digits say how much is seen through it.
std::string colour(const SvgInk& ink) {
  return fmt::format("rgb '#{:02x}{:06x}'", std::lround(255 * (1 - ink.opacity)), ink.rgb);
}

/// Where a drawing stands in another.
struct Placement {
  SvgPoint corner{};
  double scale = 1;

  SvgPoint operator()(const SvgPoint& point) const {
    return {corner.x + scale * point.x, corner.y + scale * point.y};
  }
};

class Script {
 public:
  Script(PaperFormat format, double width, double height, const SvgInk& paper)
      : terminal_(terminal_of(format)), width_(width), height_(height) {
    set_terminal(format, std::ceil(width * terminal_.scale), std::ceil(height * terminal_.scale),
                 paper);
    begin_page(paper);
  }

  void begin_page(const SvgInk& paper) {  // there must be some plot
    fill({{0, 0}, {width_, 0}, {width_, height_}, {0, height_}}, paper);
  }

  void end_page() {
    finished_ += settings_ + fmt::format("plot {}\n", fmt::join(plots_, ", ")) + data_;
    settings_ = "unset label\n";
    plots_.clear();
    data_.clear();
  }

  void draw(std::vector<Polyline> lines, const Placement& place, SvgLook look) {
    for (Polyline& line : lines)
      for (SvgPoint& point : line) point = place(point);
    look.stroke_width *= place.scale;
    for (double& dash : look.dashes) dash *= place.scale;
    if (look.fill)
      for (const Polyline& line : lines) fill(line, *look.fill);
    if (look.stroke && !lines.empty()) stroke(lines, look);
  }

  void write(SvgPoint in_drawing, std::string_view words, const Placement& place,
             const SvgLook& look) {
    const SvgPoint at = place(in_drawing);
    const double font_size = place.scale * look.font_size;
    if (words.empty() || !look.fill) return;
    const char* side = look.anchor == "middle" ? "center" : look.anchor == "end" ? "right" : "left";
    settings_ += fmt::format(
        "set label {} noenhanced at {},{} {} front font '{}{},{}' textcolor {}\n",
        in_quotes(on_one_line(words)), at.x, at.y - raised * font_size, side, look.font_family,
        look.is_bold ? ":Bold" : "", font_size * 72 / 96, colour(*look.fill));
  }

  const std::string& finished() const { return finished_; }

 private:
  /// Whole units across and down, as gnuplot has no others.
  void set_terminal(PaperFormat format, double across, double down, const SvgInk& paper) {
    const double before = rim / terminal_.scale;
    settings_ = fmt::format(
        "set encoding utf8\n"
        "set terminal {} size {} background {} fontscale {} linewidth {}\n"
        "unset border\nunset tics\nunset key\nset style fill solid noborder\n"
        "set lmargin at screen 0\nset rmargin at screen 1\n"
        "set tmargin at screen 1\nset bmargin at screen 0\n"
        "set xrange [{}:{}]\nset yrange [{}:{}]\n",
        terminal_name(format),
        format == PaperFormat::png ? fmt::format("{},{}", across, down)
                                   : fmt::format("{}in,{}in", across / 72, down / 72),
        colour(paper), terminal_.scale, terminal_.linewidth, before,
        across / terminal_.scale - before, down / terminal_.scale - before, before);
  }

  void fill(const Polyline& line, const SvgInk& ink) {
    for (const SvgPoint& point : line) add(point);
    plot("filledcurves closed fillcolor " + colour(ink));
  }

  void stroke(const std::vector<Polyline>& lines, const SvgLook& look) {
    for (const Polyline& line : lines) {
      SvgPoint last{-1, -1};
      for (SvgPoint point : line) {
        if (terminal_.snaps && point.x == last.x) point.x += unsnapped;
        if (terminal_.snaps && point.y == last.y) point.y += unsnapped;
        add(point);
        last = point;
      }
      data_ += "\n";
    }
    plot(fmt::format("lines linewidth {} linecolor {}{}", look.stroke_width, colour(*look.stroke),
                     dash_type(look)));
  }

  std::string dash_type(const SvgLook& look) const {
    if (look.dashes.empty()) return "";
    const double one = terminal_.dash * std::max(1.0, terminal_.scale * look.stroke_width);
    std::vector<double> dashes;
    for (const double pixels : look.dashes) dashes.push_back(pixels * terminal_.scale / one);
    return fmt::format(" dashtype ({})", fmt::join(dashes, ","));
  }

  void add(const SvgPoint& point) { data_ += fmt::format("{:.3f} {:.3f}\n", point.x, point.y); }
  /// What was added since the one before.
  void plot(const std::string& how) {
    data_ += "e\n";
    plots_.push_back("'-' with " + how);
  }

  const Terminal terminal_;
  const double width_, height_;
  std::string finished_;
  std::string settings_;
  std::vector<std::string> plots_;
  std::string data_;  // of the plots in turn
};

SvgPoint point_of(pugi::xml_node node, const char* x, const char* y) {
  return {node.attribute(x).as_double(), node.attribute(y).as_double()};
}

Polyline outline_of(pugi::xml_node rectangle) {
  const SvgPoint from = point_of(rectangle, "x", "y");
  const SvgPoint size = point_of(rectangle, "width", "height");
  return {from,
          {from.x + size.x, from.y},
          {from.x + size.x, from.y + size.y},
          {from.x, from.y + size.y},
          from};
}

void add_element(Script& script, pugi::xml_node node, const Placement& place, const SvgLook& look) {
  const std::string_view name = node.name();
  if (name == "line")
    script.draw({{point_of(node, "x1", "y1"), point_of(node, "x2", "y2")}}, place, look);
  else if (name == "rect")
    script.draw({outline_of(node)}, place, look);
  else if (name == "path")
    script.draw(polylines_of(node.attribute("d").value()), place, look);
  else if (name == "text")
    script.write(point_of(node, "x", "y"), node.text().get(), place, look);
  else
    throw std::logic_error(fmt::format("a drawing has <{}>", name));
}

bool is_drawn(std::string_view name) {
  return name != "title" && name != "desc" && name != "style";
}

/// "translate(48.00 90.00) scale(0.8000)", as SvgDrawing::place() writes it.
Placement placement_of(pugi::xml_node group) {
  std::string numbers = group.attribute("transform").value();
  std::ranges::replace_if(
      numbers, [](char c) { return std::isdigit(static_cast<unsigned char>(c)) == 0 && c != '.'; },
      ' ');
  Placement place;
  std::istringstream in(numbers);
  in >> place.corner.x >> place.corner.y >> place.scale;
  return place;
}

void add_elements(Script& script, pugi::xml_node drawing, const Placement& place,
                  const StyleSheet& sheet) {
  for (const pugi::xml_node node : drawing.children())
    if (std::string_view(node.name()) == "g")
      add_elements(script, node, placement_of(node), sheet);
    else if (is_drawn(node.name()))
      add_element(script, node, place, sheet.look_of(node.name(), node.attribute("class").value()));
}

}  // namespace

const char* terminal_name(PaperFormat format) {
  return format == PaperFormat::png ? "pngcairo" : "pdfcairo";
}

std::string gnuplot_script(const std::vector<std::string>& drawings, PaperFormat format) {
  std::optional<Script> script;
  for (const std::string& svg : drawings) {
    pugi::xml_document document;
    if (!document.load_buffer(svg.data(), svg.size()))
      throw std::logic_error("a drawing is not whole");
    const pugi::xml_node drawing = document.child("svg");
    const StyleSheet sheet(drawing.child_value("style"));
    if (script)
      script->begin_page(sheet.paper());
    else
      script.emplace(format, drawing.attribute("width").as_double(),
                     drawing.attribute("height").as_double(), sheet.paper());
    add_elements(*script, drawing, {}, sheet);
    script->end_page();
  }
  return script.value().finished();
}

}  // namespace sim
