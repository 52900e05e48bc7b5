#include "sim/picture/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/picture/axis_span.hpp"
#include "sim/picture/scale.hpp"
#include "sim/picture/svg.hpp"

namespace sim {
namespace {

// Pixels.
constexpr double width = 720;
constexpr double left = 80, right = 700, top = 50, bottom = 380;
constexpr double arrow_length = 24, whisker = 4;
constexpr double legend_top = bottom + 66, legend_step = 16;

constexpr std::array styles{"curve1", "curve2", "curve3", "curve4", "curve5", "curve6"};

/// Places of values along an axis.
class Positions {
 public:
  /// `in_decades`: a logarithmic axis begins and ends at powers of ten.
  Positions(const ChartAxis& axis, double at_from, double at_to, bool in_decades)
      : span_(axis), scale_{0, 1, at_from, at_to}, in_decades_(in_decades) {}

  bool shows(double value) const { return span_.shows(value); }
  void cover(double value) { span_.cover(value); }
  void cover_level(const ChartAxis& axis) { span_.cover_level(axis); }
  void cover(const ChartPoint& point) {
    span_.cover(point);
    if (point.is_limit && shows(point.high)) lowest_limit_ = std::min(lowest_limit_, point.high);
  }
  /// To be called once when all is covered.
  void settle() {
    if (!(span_.least() <= span_.greatest())) return;  // the scale's own 0 to 1
    double least = span_.on_axis(span_.least()), greatest = span_.on_axis(span_.greatest());
    if (span_.is_logarithmic() && in_decades_) {
      greatest = span_.upper_exponent();
      least = with_room_for_arrows(span_.lower_exponent(), greatest);
    }
    const double size = std::max(std::abs(least), std::abs(greatest));
    const double half = std::max(0.5, 1e-6 * size);
    if (greatest - least <= 1e-9 * size) least -= half, greatest += half;  // else no room for marks
    scale_.from = least;
    scale_.to = greatest;
  }
  /// A little beyond the first and the last, so that they are seen whole.
  void pad() {
    constexpr double share = 0.02;
    const double margin = share * (scale_.to - scale_.from);
    scale_.from -= margin;
    scale_.to += margin;
  }
  double operator()(double value) const { return scale_(span_.on_axis(value)); }

  /// Values worth a mark.
  std::vector<double> marks() const {
    constexpr double most_decades = 3;  // for marks between powers of ten
    if (span_.is_logarithmic() && !in_decades_ && scale_.to - scale_.from <= most_decades)
      return digits();
    std::vector<double> values = round_values(scale_.from, scale_.to, 9);
    if (span_.is_logarithmic() || span_.is_count())
      std::erase_if(values, [](double value) { return value != std::round(value); });
    if (span_.is_logarithmic())
      for (double& value : values) value = std::pow(10, value);
    return values;
  }
  std::string label(double value) const { return span_.label(value); }

 private:
  /// 1, 2 and 5 of each decade.
  std::vector<double> digits() const {
    std::vector<double> values;
    for (double exponent = std::floor(scale_.from); exponent <= scale_.to; ++exponent)
      for (const double digit : {1, 2, 5}) {
        const double at = exponent + std::log10(digit);
        if (at >= scale_.from - 1e-9 && at <= scale_.to + 1e-9)
          values.push_back(digit * std::pow(10, exponent));
      }
    return values;
  }
  /// The lower of two exponents, or so many decades below it that the arrow of the lowest limit
  /// ends above the axis.
  double with_room_for_arrows(double from, double to) const {
    const double room = arrow_length / std::abs(scale_.at_to - scale_.at_from);
    while (std::log10(lowest_limit_) - from < room * (to - from)) --from;
    return from;
  }

  AxisSpan span_;
  Scale scale_;
  bool in_decades_;
  double lowest_limit_ = std::numeric_limits<double>::infinity();
};

struct Paper {
  Positions x, y;
};

Paper paper_for(const Chart& chart) {
  Paper paper{{chart.x, left, right, false}, {chart.y, bottom, top, true}};
  for (const ChartCurve& curve : chart.curves)
    for (const ChartPoint& point : curve.points) {
      paper.x.cover(point.x);
      paper.y.cover(point);
    }
  if (chart.y.from_zero) paper.y.cover(0);
  paper.y.cover_level(chart.y);
  paper.x.settle();
  paper.x.pad();
  paper.y.settle();
  return paper;
}

void draw_axes(SvgDrawing& drawing, const Chart& chart, const Paper& paper) {
  for (const double value : paper.x.marks()) {
    drawing.line({paper.x(value), top}, {paper.x(value), bottom}, "grid");
    drawing.text({paper.x(value), bottom + 18}, paper.x.label(value), "middle small");
  }
  for (const double value : paper.y.marks()) {
    drawing.line({left, paper.y(value)}, {right, paper.y(value)}, "grid");
    drawing.text({left - 8, paper.y(value) + 4}, paper.y.label(value), "end small");
  }
  drawing.line({left, bottom}, {right, bottom}, "axis");
  drawing.line({left, top}, {left, bottom}, "axis");
  drawing.text({(left + right) / 2, bottom + 42}, title_of(chart.x), "middle");
  drawing.text({left - 60, top - 12}, chart.y.label, "");
  drawing.text({left - 60, 20}, chart.title, "heading");
}

void draw_level(SvgDrawing& drawing, const Chart& chart, const Paper& paper) {
  if (!chart.y.level) return;
  const double y = paper.y(*chart.y.level);
  drawing.line({left, y}, {right, y}, "level");
  drawing.text({right - 4, y - 4}, level_text(*chart.y.level), "end small");
}

/// From point to point; broken where nothing is known.
std::string line_through(const ChartCurve& curve, const Paper& paper) {
  std::string path;
  bool down = false;
  for (const ChartPoint& point : curve.points) {
    const bool shown = !point.is_limit && paper.x.shows(point.x) && paper.y.shows(point.y);
    if (shown)
      path += fmt::format("{}{:.2f} {:.2f}", down ? 'L' : 'M', paper.x(point.x), paper.y(point.y));
    down = shown;
  }
  return path;
}

/// An arrow downward from the upper end, shorter where the axis is near.
void draw_limit(SvgDrawing& drawing, double x, double y, const std::string& style) {
  const double length = std::min(arrow_length, bottom - y);
  drawing.path(
      fmt::format("M{:.2f} {:.2f}h{}M{:.2f} {:.2f}v{}m-{} -{}l{} {}l{} -{}", x - whisker, y,
                  2 * whisker, x, y, length, whisker, whisker, whisker, whisker, whisker, whisker),
      style);
}

void draw_interval(SvgDrawing& drawing, const Paper& paper, const ChartPoint& point,
                   const std::string& style) {
  if (!paper.x.shows(point.x) || !paper.y.shows(point.high)) return;
  if (point.low == point.high && !point.is_limit) return;
  const double x = paper.x(point.x), high = paper.y(point.high);
  if (point.is_limit) return draw_limit(drawing, x, high, style);
  const bool has_end = paper.y.shows(point.low) && paper.y(point.low) <= bottom;
  const double low = has_end ? paper.y(point.low) : bottom;
  drawing.path(fmt::format("M{:.2f} {:.2f}h{}M{:.2f} {:.2f}V{:.2f}", x - whisker, high, 2 * whisker,
                           x, high, low) +
                   (has_end ? fmt::format("m-{} 0h{}", whisker, 2 * whisker) : ""),
               style);
}

/// As wide as most of the way from one whole number to the next.
void draw_bars(SvgDrawing& drawing, const Paper& paper, const ChartCurve& curve) {
  constexpr double share = 0.6;
  const double wide = share * (paper.x(1) - paper.x(0));
  for (const ChartPoint& point : curve.points) {
    if (!paper.x.shows(point.x) || !paper.y.shows(point.y)) continue;
    const double y = paper.y(point.y);
    drawing.rectangle({paper.x(point.x) - wide / 2, y}, wide, bottom - y, "fill1");
  }
}

void draw_curve(SvgDrawing& drawing, const Paper& paper, const ChartCurve& curve,
                const std::string& style) {
  if (curve.kind == CurveKind::bars) return draw_bars(drawing, paper, curve);
  drawing.path(line_through(curve, paper), style);
  if (curve.kind != CurveKind::measured) return;
  for (const ChartPoint& point : curve.points) {
    draw_interval(drawing, paper, point, style);
    if (!point.is_limit && paper.x.shows(point.x) && paper.y.shows(point.y))
      drawing.path(fmt::format("M{:.2f} {:.2f}m-2.5 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0",
                               paper.x(point.x), paper.y(point.y)),
                   style + " dot");
  }
}

/// Where there are more curves than colours they are dotted, then dashed.
std::string style_of(const Chart& chart, std::size_t curve) {
  constexpr std::array again{"", " dotted", " dashed"};
  constexpr std::array theory{" theory", " theory2", " theory3"};
  const std::size_t colour = colour_of(chart, curve), round = colour / styles.size() % again.size();
  return std::string(styles[colour % styles.size()]) +
         (chart.curves[curve].kind == CurveKind::theory ? theory[round] : again[round]);
}

}  // namespace

std::string title_of(const ChartAxis& axis) {
  return axis.words.empty() ? axis.label : axis.words + ", " + axis.label;
}

std::string level_text(double ratio) { return fmt::format("{:g} %", 100 * ratio); }

std::size_t colour_of(const Chart& chart, std::size_t curve) {
  const auto others = std::ranges::count_if(
      chart.curves.begin(), chart.curves.begin() + static_cast<std::ptrdiff_t>(curve) + 1,
      [](const ChartCurve& c) { return c.kind != CurveKind::theory; });
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(others, 1)) - 1;
}

std::string chart_as_svg(const Chart& chart) {
  const double height = legend_top + legend_step * static_cast<double>(chart.curves.size());
  SvgDrawing drawing(width, height, chart.title, chart.description);
  const Paper paper = paper_for(chart);
  draw_axes(drawing, chart, paper);
  draw_level(drawing, chart, paper);
  double legend = legend_top;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const ChartCurve& curve = chart.curves[i];
    const std::string style = style_of(chart, i);
    draw_curve(drawing, paper, curve, style);
    drawing.line({left, legend - 4}, {left + 25, legend - 4}, style);
    drawing.text({left + 32, legend}, curve.name, "");
    legend += legend_step;
  }
  return drawing.finished();
}

}  // namespace sim
