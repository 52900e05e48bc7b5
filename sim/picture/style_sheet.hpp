#pragma once
// How the things of an SvgDrawing look: its own style sheet (svg.cpp) as a browser understands it,
// on light paper. All of it throws std::logic_error at what is not known here.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sim {

struct SvgInk {
  std::uint32_t rgb = 0;  // 0xRRGGBB
  double opacity = 1;     // 0 to 1
};

/// Lengths are pixels.
struct SvgLook {
  std::optional<SvgInk> fill, stroke;  // nothing where it has none
  double stroke_width = 1;
  std::vector<double> dashes{};  // drawn and left out in turn; empty for a whole line
  std::string anchor{};          // of texts: start, middle or end
  std::string font_family{};
  double font_size = 0;
  bool is_bold = false;
};

/// "stroke-width" to "1.5".
using SvgProperties = std::map<std::string, std::string, std::less<>>;

class StyleSheet {
 public:
  /// What stands before the first @media, which is for paper that is not light. Selectors are
  /// elements and classes.
  explicit StyleSheet(std::string css);

  /// Of an element with these classes: "path", "curve1 theory".
  SvgLook look_of(std::string_view element, std::string_view classes) const;
  /// What all stands on.
  SvgInk paper() const;

 private:
  struct Rule {
    std::string selector;
    SvgProperties properties;
  };

  void overlay(SvgProperties& properties, const std::vector<std::string>& selectors) const;

  std::vector<Rule> rules_;
};

}  // namespace sim
