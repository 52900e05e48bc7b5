#include "sim/picture/svg.hpp"

#include <fmt/format.h>

#include <sstream>

#include "sim/text/existing_file.hpp"

namespace sim {
namespace {

constexpr std::string_view head = "<!-- by cosys-sim -->\n";

constexpr const char* style_sheet = R"(<style>
svg { background: #fff; color: #222; font: 12px sans-serif; }
text { fill: currentColor; }
line, path { stroke: currentColor; fill: none; stroke-width: 1; }
.grid { stroke-opacity: .15; }
.axis { stroke-opacity: .5; }
.light { stroke: #d55e00; }
.wire { stroke: #0072b2; stroke-width: 1.5; }
.curve1 { stroke: #0072b2; }
.curve2 { stroke: #d55e00; }
.curve3 { stroke: #009e73; }
.curve4 { stroke: #cc79a7; }
.curve5 { stroke: #e69f00; }
.curve6 { stroke: #56b4e9; }
.curve7 { stroke: #003f66; }
.curve8 { stroke: #7a3600; }
.curve9 { stroke: #00553e; }
.curve10 { stroke: #7d3c5f; }
.curve11 { stroke: #806000; }
.curve12 { stroke: #2a5f80; }
.grey { stroke: #999; stroke-opacity: .6; }
.frame { fill: none; stroke: currentColor; stroke-opacity: .3; }
.fill0 { fill: #999; fill-opacity: .35; }
.fill1 { fill: #0072b2; }
.fill2 { fill: #e69f00; }
.fill3 { fill: #cc79a7; }
.fill4 { fill: #009e73; }
.fill5 { fill: #d55e00; }
.fill6 { fill: #56b4e9; }
.fill7 { fill: #f0e442; }
.fill8 { fill: #222; }
.heat0 { fill: #999; fill-opacity: .15; }
.heat1 { fill: #fde725; }
.heat2 { fill: #a0da39; }
.heat3 { fill: #4ac16d; }
.heat4 { fill: #1fa187; }
.heat5 { fill: #277f8e; }
.heat6 { fill: #365c8d; }
.heat7 { fill: #46327e; }
.contour { stroke-width: 3; stroke: #d55e00; }
.threshold { stroke: #e69f00; stroke-width: 2; }
.eye { stroke: #0072b2; stroke-opacity: .25; }
.misread { stroke: #cc3311; stroke-width: 2; }
.theory { stroke-dasharray: 6 4; }
.level { stroke-dasharray: 1 3; }
.dot { stroke-width: 2; }
.disc { stroke-width: 6; }
.floor { fill: #999; fill-opacity: .12; }
.way { stroke-width: 2; stroke-opacity: .35; }
.heading { font-size: 15px; font-weight: bold; }
.small { fill-opacity: .75; }
.middle, .wrong { text-anchor: middle; }
.end { text-anchor: end; }
.listing { font: 10px monospace; }
.character { text-anchor: middle; font: 13px monospace; }
.wrong { font: bold 13px monospace; fill: #cc3311; }
)";

constexpr std::string_view in_the_dark = R"(@media (prefers-color-scheme: dark) {
  svg { background: #181818; color: #ddd; }
  .light { stroke: #e69f00; }
  .wire { stroke: #56b4e9; }
  .curve1 { stroke: #4aa3df; }
  .curve7 { stroke: #a8d4f2; }
  .curve8 { stroke: #ffb48a; }
  .curve9 { stroke: #8fe0c6; }
  .curve10 { stroke: #f2c8de; }
  .curve11 { stroke: #ffdf94; }
  .curve12 { stroke: #d0ecfb; }
  .fill8 { fill: #ddd; }
  .misread { stroke: #ff7766; }
  .wrong { fill: #ff7766; }
}
)";

constexpr std::string_view drawing_end = "</svg>\n";

constexpr const char* on_paper = R"(@media print { svg { background: #fff; color: #000; } }
</style>
)";

}  // namespace

std::string curve_style(std::size_t colour) {
  return fmt::format("curve{}", colour % curve_colours + 1);
}

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

SvgDrawing::SvgDrawing(double width, double height, std::string_view title,
                       std::string_view description) {
  text_ = fmt::format(
      "{0}<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {1:g} {2:g}\" width=\"{1:g}\" "
      "height=\"{2:g}\" role=\"img\">\n<title>{3}</title>\n<desc>{4}</desc>\n{5}{6}{7}",
      head, width, height, xml_escaped(title), xml_escaped(description), style_sheet, in_the_dark,
      on_paper);
}

void SvgDrawing::line(SvgPoint from, SvgPoint to, std::string_view style) {
  text_ +=
      fmt::format("<line class=\"{}\" x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\"/>\n",
                  style, from.x, from.y, to.x, to.y);
}

void SvgDrawing::path(std::string_view data, std::string_view style) {
  if (!data.empty()) text_ += fmt::format("<path class=\"{}\" d=\"{}\"/>\n", style, data);
}

void SvgDrawing::rectangle(SvgPoint corner, double width, double height, std::string_view style) {
  text_ += fmt::format(
      "<rect class=\"{}\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/>\n", style,
      corner.x, corner.y, width, height);
}

void SvgDrawing::text(SvgPoint at, std::string_view words, std::string_view style) {
  text_ += fmt::format("<text class=\"{}\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n", style, at.x,
                       at.y, xml_escaped(words));
}

void SvgDrawing::place(std::string_view drawing, SvgPoint corner, double scale) {
  const std::size_t from = drawing.find(on_paper) + std::string_view(on_paper).size();
  text_ +=
      fmt::format("<g transform=\"translate({:.2f} {:.2f}) scale({:.4f})\">\n{}</g>\n", corner.x,
                  corner.y, scale, drawing.substr(from, drawing.rfind(drawing_end) - from));
}

SvgPoint size_of_drawing(std::string_view drawing) {
  constexpr std::string_view before = "viewBox=\"0 0 ";
  std::istringstream sizes(std::string(drawing.substr(drawing.find(before) + before.size(), 40)));
  SvgPoint size;
  sizes >> size.x >> size.y;
  return size;
}

std::string always_light(std::string drawing) {
  const std::size_t at = drawing.find(in_the_dark);
  if (at != std::string::npos) drawing.erase(at, in_the_dark.size());
  return drawing;
}

bool is_drawing(const std::filesystem::path& path) {
  return beginning_of(path, head.size()) == head;
}

}  // namespace sim
