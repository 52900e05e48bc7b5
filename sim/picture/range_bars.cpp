#include "sim/picture/range_bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "sim/picture/scale.hpp"
#include "sim/picture/svg.hpp"
#include "sim/text/letters.hpp"

namespace sim {
namespace {

// Pixels.
constexpr double tornado_top = 60, tornado_length = 480, tornado_margin = 20;
constexpr double tornado_step = 26, tornado_bar = 16, tornado_letter = 6.5, tornado_beside = 8;
constexpr double tornado_legend = 16, tornado_patch = 10;

constexpr const char *low_style = "fill0", *high_style = "fill1";

double left_of_bars(const RangeBars& bars) {
  std::size_t letters = 0;
  for (const RangeBar& bar : bars.bars) letters = std::max(letters, letters_in(bar.label));
  return tornado_margin + tornado_beside + tornado_letter * static_cast<double>(letters);
}

/// From 0 or below on: lengths of bars are then comparable with the answer.
Scale scale_of(const RangeBars& bars, double left) {
  double least = std::min(0.0, bars.middle), most = bars.middle;
  for (const RangeBar& bar : bars.bars) {
    least = std::min({least, bar.at_low, bar.at_high});
    most = std::max({most, bar.at_low, bar.at_high});
  }
  if (most == least) most = least + 1;
  return {least, most, left, left + tornado_length};
}

void draw_piece(SvgDrawing& drawing, const Scale& across, double from, double to, double y,
                std::string_view style) {
  const double a = across(std::min(from, to)), b = across(std::max(from, to));
  if (b > a) drawing.rectangle({a, y}, b - a, tornado_bar, style);
}

void draw_bar(SvgDrawing& drawing, const Scale& across, double middle, const RangeBar& bar,
              double y) {
  drawing.text({across.at_from - tornado_beside, y + tornado_bar - 4}, bar.label, "end");
  draw_piece(drawing, across, middle, bar.at_low, y, low_style);
  draw_piece(drawing, across, middle, bar.at_high, y, high_style);
  drawing.text({across.at_to + tornado_beside, y + tornado_bar - 4},
               bar.low_text + " / " + bar.high_text, "small");
}

void draw_tornado_axis(SvgDrawing& drawing, const Scale& across, const RangeBars& bars,
                       double bottom) {
  for (const double value : round_values(across.from, across.to, 8)) {
    const double x = across(value);
    drawing.line({x, tornado_top - 4}, {x, bottom}, "grid");
    drawing.text({x, bottom + 14}, fmt::format("{:g}", value), "middle small");
  }
  drawing.text({(across.at_from + across.at_to) / 2, bottom + 32}, bars.axis, "middle");
  drawing.line({across(bars.middle), tornado_top - 6}, {across(bars.middle), bottom}, "frame");
}

void draw_tornado_legend(SvgDrawing& drawing, double left, double y) {
  for (const auto& [style, words] :
       {std::pair{low_style, "where it is low"}, std::pair{high_style, "where it is high"}}) {
    drawing.rectangle({left, y - tornado_patch}, tornado_patch, tornado_patch, style);
    drawing.text({left + tornado_patch + 6, y}, words, "");
    y += tornado_legend;
  }
}

}  // namespace

std::string range_bars_as_svg(const RangeBars& bars) {
  const double left = left_of_bars(bars), texts = 150;
  const double bottom = tornado_top + tornado_step * static_cast<double>(bars.bars.size());
  const Scale across = scale_of(bars, left);
  SvgDrawing drawing(across.at_to + texts + tornado_margin, bottom + 50 + 2 * tornado_legend,
                     bars.title, bars.description);
  drawing.text({tornado_margin, 20}, bars.title, "heading");
  drawing.text({across.at_to + tornado_beside, tornado_top - 10}, "low / high", "small");
  draw_tornado_axis(drawing, across, bars, bottom);
  double y = tornado_top;
  for (const RangeBar& bar : bars.bars) {
    draw_bar(drawing, across, bars.middle, bar, y);
    y += tornado_step;
  }
  draw_tornado_legend(drawing, left, bottom + 54);
  return drawing.finished();
}

}  // namespace sim
