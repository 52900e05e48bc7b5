#include "sim/picture/reach_bars.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/picture/scale.hpp"
#include "sim/picture/svg.hpp"
#include "sim/text/letters.hpp"

namespace sim {
namespace {

// Pixels.
constexpr double reach_top = 40, reach_length = 400, reach_margin = 20, reach_step = 24;
constexpr double units_height = 16, reach_height = 8, reach_cap = 5;
constexpr double reach_letter = 6.5, reach_beside = 8, reach_legend = 18;

constexpr const char *units_style = "fill0", *reach_style = "fill1";

double width_of(const std::vector<ReachBar>& bars, std::string ReachBar::*text) {
  std::size_t letters = 0;
  for (const ReachBar& bar : bars) letters = std::max(letters, letters_in(bar.*text));
  return reach_letter * static_cast<double>(letters);
}

/// A part of a row, cut at the ends of the axis.
void draw_span(SvgDrawing& drawing, const Scale& across, std::pair<double, double> span,
               double middle, double height, const char* style) {
  const double from = across(std::clamp(span.first, across.from, across.to));
  const double to = across(std::clamp(span.second, across.from, across.to));
  if (to > from) drawing.rectangle({from, middle - height / 2}, to - from, height, style);
}

void draw_whisker(SvgDrawing& drawing, const Scale& across, const ReachBar& bar, double middle) {
  const double low = across(std::clamp(bar.low, across.from, across.to));
  const double high = across(std::clamp(bar.high, across.from, across.to));
  if (high <= low) return;
  drawing.line({low, middle}, {high, middle}, "");
  for (const double end : {low, high})
    drawing.line({end, middle - reach_cap}, {end, middle + reach_cap}, "");
}

void draw_reach(SvgDrawing& drawing, const Scale& across, const ReachBar& bar, double middle) {
  drawing.text({across.at_from - reach_beside, middle + 4}, bar.label, "end");
  if (bar.units) draw_span(drawing, across, *bar.units, middle, units_height, units_style);
  draw_span(drawing, across, {across.from, bar.at}, middle, reach_height, reach_style);
  draw_whisker(drawing, across, bar, middle);
  drawing.text({across.at_to + reach_beside, middle + 4}, bar.words, "");
}

void draw_reach_axis(SvgDrawing& drawing, const Scale& across, const std::string& axis,
                     double bottom) {
  for (const double value : round_values(across.from, across.to, 8)) {
    const double x = across(value);
    drawing.line({x, reach_top}, {x, bottom}, "grid");
    drawing.text({x, bottom + 14}, fmt::format("{:g}", value), "middle small");
  }
  drawing.text({(across.at_from + across.at_to) / 2, bottom + 32}, axis, "middle");
}

void draw_reach_legend(SvgDrawing& drawing, double left, double y) {
  drawing.rectangle({left, y - units_height + 3}, 2 * units_height, units_height, units_style);
  drawing.text({left + 2 * units_height + reach_beside, y},
               "where 8 of 10 units end, as not all of the part is known", "");
}

}  // namespace

std::string reach_bars_as_svg(const ReachBars& bars) {
  const bool have_units =
      std::ranges::any_of(bars.bars, [](const ReachBar& bar) { return bar.units.has_value(); });
  const double left = reach_margin + reach_beside + width_of(bars.bars, &ReachBar::label);
  const double bottom = reach_top + reach_step * static_cast<double>(bars.bars.size());
  const Scale across{bars.from, bars.to, left, left + reach_length};
  const double width = across.at_to + reach_beside + width_of(bars.bars, &ReachBar::words);
  SvgDrawing drawing(width + reach_margin, bottom + 44 + (have_units ? reach_legend : 0),
                     bars.title, bars.description);
  drawing.text({reach_margin, 20}, bars.title, "heading");
  draw_reach_axis(drawing, across, bars.axis, bottom);
  double middle = reach_top + reach_step / 2;
  for (const ReachBar& bar : bars.bars) {
    draw_reach(drawing, across, bar, middle);
    middle += reach_step;
  }
  if (have_units) draw_reach_legend(drawing, left, bottom + 52);
  return drawing.finished();
}

}  // namespace sim
