#pragma once
// A drawing as SVG 1.1 (W3C Recommendation of 2011), for browsers and for paper. Lengths are pixels
// from the upper left corner. How things look is said by the style sheet alone (svg.cpp), in
// colours that the colour-blind tell apart (Okabe and Ito 2008), in light and in dark; where six
// are not enough there are darker tones of them, lighter ones in the dark.
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace sim {

struct SvgPoint {
  double x = 0, y = 0;
};

/// Six, and another tone of each; more come again.
inline constexpr std::size_t curve_colours = 12;

/// The style of a curve.
std::string curve_style(std::size_t colour);

/// Text for XML: the characters that mean something there are named.
std::string xml_escaped(std::string_view text);

class SvgDrawing {
 public:
  /// Title and description are for who cannot see it. All texts are UTF-8 without control
  /// characters; a style is the name of a class of the style sheet.
  SvgDrawing(double width, double height, std::string_view title, std::string_view description);

  void line(SvgPoint from, SvgPoint to, std::string_view style);
  /// `data` is the path's "d"; none is drawn of an empty one.
  void path(std::string_view data, std::string_view style);
  void rectangle(SvgPoint corner, double width, double height, std::string_view style);
  void text(SvgPoint at, std::string_view words, std::string_view style);
  /// Another finished drawing, so many times as large, from this corner on.
  void place(std::string_view drawing, SvgPoint corner, double scale);

  std::string finished() const { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

/// Width and height of a finished drawing.
SvgPoint size_of_drawing(std::string_view drawing);

/// The same for paper, which is light wherever it is looked at.
std::string always_light(std::string drawing);

/// Whether a file is such a drawing.
bool is_drawing(const std::filesystem::path& path);

}  // namespace sim
