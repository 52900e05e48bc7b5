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
  Positions(const ChartAxis& axis, double at_from, double at_to)
      : span_(axis), scale_{0, 1, at_from, at_to} {}

  bool shows(double value) const { return span_.shows(value); }
  void cover(double value) { span_.cover(value); }
  void cover(const ChartPoint& point) {
    span_.cover(point);
    if (point.is_limit && shows(point.high)) lowest_limit_ = std::min(lowest_limit_, point.high);
  }
  /// To be called once when all is covered.
  void settle() {
    if (!(span_.least() <= span_.greatest())) return;  // the scale's own 0 to 1
    double least = span_.on_axis(span_.least()), greatest = span_.on_axis(span_.greatest());
    if (span_.is_logarithmic()) {
      greatest = std::ceil(greatest);
      least = with_room_for_arrows(std::min(std::floor(least), greatest - 1), greatest);
    }
    const double size = std::max(std::abs(least), std::abs(greatest));
    const double half = std::max(0.5, 1e-6 * size);
    if (greatest - least <= 1e-9 * size) least -= half, greatest += half;  // else no room for marks
    scale_.from = least;
    scale_.to = greatest;
  }
  double operator()(double value) const { return scale_(span_.on_axis(value)); }

  /// Values worth a mark.
  std::vector<double> marks() const {
    std::vector<double> values = round_values(scale_.from, scale_.to, 9);
    if (span_.is_logarithmic() || span_.is_whole())
      std::erase_if(values, [](double value) { return value != std::round(value); });
    if (span_.is_logarithmic())
      for (double& value : values) value = std::pow(10, value);
    return values;
  }
  std::string label(double value) const {
    if (span_.is_logarithmic() && (value < 1e-2 || value > 1e4))
      return fmt::format("1e{:.0f}", std::log10(value));
    return fmt::format("{:g}", value);
  }

 private:
  /// The lower of two exponents, or so many decades below it that the arrow of the lowest limit
  /// ends above the axis.
  double with_room_for_arrows(double from, double to) const {
    const double room = arrow_length / std::abs(scale_.at_to - scale_.at_from);
    while (std::log10(lowest_limit_) - from < room * (to - from)) --from;
    return from;
  }

  AxisSpan span_;
  Scale scale_;
  double lowest_limit_ = std::numeric_limits<double>::infinity();
};

struct Paper {
  Positions x, y;
};

Paper paper_for(const Chart& chart) {
  Paper paper{{chart.x, left, right}, {chart.y, bottom, top}};
  for (const ChartCurve& curve : chart.curves)
    for (const ChartPoint& point : curve.points) {
      paper.x.cover(point.x);
      paper.y.cover(point);
    }
  paper.x.settle();
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
  drawing.text({(left + right) / 2, bottom + 42}, chart.x.label, "middle");
  drawing.text({left - 60, top - 12}, chart.y.label, "");
  drawing.text({left - 60, 20}, chart.title, "heading");
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
  const double low = paper.y.shows(point.low) ? std::min(paper.y(point.low), bottom) : bottom;
  drawing.path(fmt::format("M{0:.2f} {2:.2f}h{4}M{1:.2f} {2:.2f}V{3:.2f}m-{5} 0h{4}", x - whisker,
                           x, high, low, 2 * whisker, whisker),
               style);
}

void draw_curve(SvgDrawing& drawing, const Paper& paper, const ChartCurve& curve,
                const std::string& style) {
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
