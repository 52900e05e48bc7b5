#include "sim/picture/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/picture/axis_span.hpp"
#include "sim/picture/curve_labels.hpp"
#include "sim/picture/scale.hpp"
#include "sim/picture/svg.hpp"

namespace sim {
namespace {

// Pixels.
constexpr double chart_width = 720;
constexpr double chart_left = 80, chart_right = 700, chart_top = 50, chart_bottom = 380;
constexpr double arrow_length = 24, whisker = 4;
constexpr double chart_legend_top = chart_bottom + 66, chart_legend_step = 16;

/// Places of values along an axis.
class Positions {
 public:
  /// `in_decades`: a logarithmic axis covers the decades of its values, and their intervals.
  Positions(const ChartAxis& axis, double at_from, double at_to, bool in_decades)
      : span_(axis), ends_(axis), scale_{0, 1, at_from, at_to}, in_decades_(in_decades) {}

  bool shows(double value) const { return span_.shows(value); }
  void cover(double value) { span_.cover(value); }
  void cover_level(const ChartAxis& axis) { span_.cover_level(axis); }
  /// Of an interval that goes far down, as where next to nothing was found, not the lower end.
  void cover(const ChartPoint& point) {
    constexpr double most_below = 10;
    span_.cover(point.is_limit ? point.high : point.y);
    ends_.cover(point.high);
    if (!span_.is_logarithmic() || point.low >= point.y / most_below) ends_.cover(point.low);
    if (point.is_limit && shows(point.high)) lowest_limit_ = std::min(lowest_limit_, point.high);
  }
  /// To be called once when all is covered.
  void settle() {
    if (!span_.is_logarithmic() || !in_decades_) cover_ends();
    if (!(span_.least() <= span_.greatest())) return;  // the scale's own 0 to 1
    double least = span_.on_axis(span_.least()), greatest = span_.on_axis(span_.greatest());
    if (span_.is_logarithmic() && in_decades_) {
      greatest = span_.upper_exponent();
      least = span_.lower_exponent();
      cover_ends();
      greatest = std::max(greatest, round_above(span_.on_axis(span_.greatest())));
      least = with_room_for_arrows(std::min(least, round_below(span_.on_axis(span_.least()))),
                                   greatest);
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
  void cover_ends() {
    span_.cover(ends_.least());
    span_.cover(ends_.greatest());
  }
  /// The nearest exponents of 1, 2 or 5 times a power of ten.
  static double round_above(double exponent) {
    const double decade = std::floor(exponent + AxisSpan::slack);
    for (const double digit : {1.0, 2.0, 5.0})
      if (decade + std::log10(digit) >= exponent - AxisSpan::slack)
        return decade + std::log10(digit);
    return decade + 1;
  }
  static double round_below(double exponent) { return -round_above(-exponent); }
  /// 1, 2 and 5 of each decade.
  std::vector<double> digits() const {
    std::vector<double> values;
    for (double exponent = std::floor(scale_.from); exponent <= scale_.to; ++exponent)
      for (const double digit : {1, 2, 5}) {
        const double at = exponent + std::log10(digit);
        if (at >= scale_.from - AxisSpan::slack && at <= scale_.to + AxisSpan::slack)
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

  AxisSpan span_, ends_;  // of values, and of their intervals
  Scale scale_;
  bool in_decades_;
  double lowest_limit_ = std::numeric_limits<double>::infinity();
};

/// How far apart bars stand: as far as the nearest two.
double bar_step(const ChartCurve& curve) {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    step = std::min(step, curve.points[i].x - curve.points[i - 1].x);
  return std::isfinite(step) && step > 0 ? step : 1;
}

struct Paper {
  Positions x, y;
};

Paper paper_for(const Chart& chart) {
  Paper paper{{chart.x, chart_left, chart_right, false}, {chart.y, chart_bottom, chart_top, true}};
  for (const ChartCurve& curve : chart.curves)
    for (const ChartPoint& point : curve.points) {
      const double beside = curve.kind == CurveKind::bars ? bar_step(curve) / 2 : 0;
      for (const double x : {point.x - beside, point.x + beside}) paper.x.cover(x);
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
    drawing.line({paper.x(value), chart_top}, {paper.x(value), chart_bottom}, "grid");
    drawing.text({paper.x(value), chart_bottom + 18}, paper.x.label(value), "middle small");
  }
  for (const double value : paper.y.marks()) {
    drawing.line({chart_left, paper.y(value)}, {chart_right, paper.y(value)}, "grid");
    drawing.text({chart_left - 8, paper.y(value) + 4}, paper.y.label(value), "end small");
  }
  drawing.line({chart_left, chart_bottom}, {chart_right, chart_bottom}, "axis");
  drawing.line({chart_left, chart_top}, {chart_left, chart_bottom}, "axis");
  drawing.text({(chart_left + chart_right) / 2, chart_bottom + 42}, title_of(chart.x), "middle");
  drawing.text({chart_left - 60, chart_top - 12}, chart.y.label, "");
  drawing.text({chart_left - 60, 20}, chart.title, "heading");
}

void draw_level(SvgDrawing& drawing, const Chart& chart, const Paper& paper) {
  if (!chart.y.level) return;
  const double y = paper.y(*chart.y.level);
  drawing.line({chart_left, y}, {chart_right, y}, "level");
  drawing.text({chart_right - 4, y - 4}, level_text(*chart.y.level), "end small");
}

/// Nothing where nothing is known.
std::optional<SvgPoint> place_of(const ChartPoint& point, const Paper& paper) {
  if (point.is_limit || !paper.x.shows(point.x) || !paper.y.shows(point.y)) return std::nullopt;
  return SvgPoint{paper.x(point.x), paper.y(point.y)};
}

/// From point to point; broken where nothing is known.
std::string line_through(const ChartCurve& curve, const Paper& paper) {
  std::string path;
  bool down = false;
  for (const ChartPoint& point : curve.points) {
    const auto place = place_of(point, paper);
    if (place) path += fmt::format("{}{:.2f} {:.2f}", down ? 'L' : 'M', place->x, place->y);
    down = place.has_value();
  }
  return path;
}

/// An arrow downward from the upper end.
void draw_limit(SvgDrawing& drawing, const PaperLine& limit, const std::string& style) {
  const auto [x, y] = limit.from;
  drawing.path(fmt::format("M{:.2f} {:.2f}h{}M{:.2f} {:.2f}v{}m-{} -{}l{} {}l{} -{}", x - whisker,
                           y, 2 * whisker, x, y, limit.to.y - y, whisker, whisker, whisker, whisker,
                           whisker, whisker),
               style);
}

/// From its upper end to its lower one, or to the foot of the paper; nothing where there is none.
std::optional<PaperLine> interval_of(const ChartPoint& point, const Paper& paper) {
  if (!paper.x.shows(point.x) || !paper.y.shows(point.high)) return std::nullopt;
  if (point.low == point.high && !point.is_limit) return std::nullopt;
  const double x = paper.x(point.x), high = paper.y(point.high);
  const bool has_end = paper.y.shows(point.low) && paper.y(point.low) <= chart_bottom;
  if (point.is_limit) return PaperLine{{x, high}, {x, std::min(high + arrow_length, chart_bottom)}};
  return PaperLine{{x, high}, {x, has_end ? paper.y(point.low) : chart_bottom}};
}

void draw_interval(SvgDrawing& drawing, const Paper& paper, const ChartPoint& point,
                   const std::string& style) {
  const auto interval = interval_of(point, paper);
  if (!interval) return;
  const auto [x, high] = interval->from;
  if (point.is_limit) return draw_limit(drawing, *interval, style);
  const double low = interval->to.y;
  const bool has_end = low < chart_bottom;
  drawing.path(fmt::format("M{:.2f} {:.2f}h{}M{:.2f} {:.2f}V{:.2f}", x - whisker, high, 2 * whisker,
                           x, high, low) +
                   (has_end ? fmt::format("m-{} 0h{}", whisker, 2 * whisker) : ""),
               style);
}

/// As wide as most of the way from one to the next, but no beams.
void draw_bars(SvgDrawing& drawing, const Paper& paper, const ChartCurve& curve) {
  constexpr double share = 0.6, widest = 60;
  const double wide = std::min(widest, share * (paper.x(bar_step(curve)) - paper.x(0)));
  for (const ChartPoint& point : curve.points) {
    if (!paper.x.shows(point.x) || !paper.y.shows(point.y)) continue;
    const double y = paper.y(point.y);
    drawing.rectangle({paper.x(point.x) - wide / 2, y}, wide, chart_bottom - y, "fill1");
    draw_interval(drawing, paper, point, "");
  }
}

std::string disc_at(double x, double y) {
  return fmt::format("M{:.2f} {:.2f}m-2.5 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0", x, y);
}

/// Then its marks stand alone, so that the theory's line is seen.
bool has_theory(const Chart& chart, std::size_t curve) {
  const auto next = curve + 1;
  return next < chart.curves.size() && chart.curves[next].kind == CurveKind::theory &&
         chart.curves[curve].kind == CurveKind::measured;
}

std::string line_style(std::optional<std::size_t> colour) {
  return colour ? curve_style(*colour) : "grey";
}

void draw_curve(SvgDrawing& drawing, const Paper& paper, const Chart& chart, std::size_t i) {
  const ChartCurve& curve = chart.curves[i];
  const auto colour = colour_of(chart, i);
  const std::string style = line_style(colour) + (curve.kind == CurveKind::theory ? " theory" : "");
  if (curve.kind == CurveKind::bars) return draw_bars(drawing, paper, curve);
  if (!has_theory(chart, i) || !colour) drawing.path(line_through(curve, paper), style);
  if (curve.kind != CurveKind::measured || !colour) return;
  for (const ChartPoint& point : curve.points) {
    draw_interval(drawing, paper, point, style);
    if (const auto place = place_of(point, paper))
      drawing.path(disc_at(place->x, place->y), style + " dot");
  }
}

/// One of several curves that has a colour, and is no theory of another.
bool is_named(const Chart& chart, std::size_t i) {
  const auto is_own = [](const ChartCurve& curve) {
    return curve.kind == CurveKind::measured || curve.kind == CurveKind::continuous;
  };
  return std::ranges::count_if(chart.curves, is_own) > 1 && is_own(chart.curves[i]) &&
         colour_of(chart, i);
}

/// What all names of several curves begin with: "receiver.range_m = ".
std::size_t alike_until(const std::vector<ChartCurve>& curves) {
  constexpr std::string_view before_value = " = ";
  const std::string& first = curves.front().name;
  const std::size_t found = first.find(before_value);
  if (found == std::string::npos) return 0;
  const std::string_view head(first.data(), found + before_value.size());
  const auto is_alike = [&](const ChartCurve& curve) { return curve.name.starts_with(head); };
  return std::ranges::all_of(curves, is_alike) ? head.size() : 0;
}

std::vector<LaidCurve> laid_curves(const Chart& chart, const Paper& paper) {
  std::vector<LaidCurve> laid;
  const std::size_t alike = chart.curves.empty() ? 0 : alike_until(chart.curves);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const ChartCurve& curve = chart.curves[i];
    laid.push_back({is_named(chart, i) ? curve.name.substr(alike) : "",
                    {},
                    {},
                    curve.kind == CurveKind::theory});
    for (const ChartPoint& point : curve.points) {
      laid.back().points.push_back(place_of(point, paper));
      if (curve.kind != CurveKind::measured || !colour_of(chart, i)) continue;
      if (const auto interval = interval_of(point, paper))
        laid.back().intervals.push_back(*interval);
    }
  }
  return laid;
}

std::vector<CurveLabel> labels_on(const std::vector<LaidCurve>& curves) {
  return curve_labels(curves, {chart_left, chart_top, chart_right, chart_bottom});
}

void draw_names(SvgDrawing& drawing, const std::vector<LaidCurve>& curves) {
  for (const CurveLabel& label : labels_on(curves))
    drawing.text(anchor_of(label, curves[label.curve]), curves[label.curve].name,
                 label.is_left ? "end" : "");
}

/// One line of the legend is for several, as each has the colour of what it is the theory of.
bool has_several_theories(const Chart& chart) {
  return std::ranges::count(chart.curves, CurveKind::theory, &ChartCurve::kind) > 1;
}

struct LegendLine {
  std::string words, style;
  bool is_marked = false, has_line = true;
};

std::vector<LegendLine> legend_of(const Chart& chart) {
  std::vector<LegendLine> lines;
  std::size_t grey = 0;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const ChartCurve& curve = chart.curves[i];
    const auto colour = colour_of(chart, i);
    if (!colour) {
      grey += curve.kind != CurveKind::theory;
    } else if (curve.kind != CurveKind::theory) {
      lines.push_back({curve.name, curve_style(*colour), curve.kind == CurveKind::measured,
                       !has_theory(chart, i)});
    } else if (!has_several_theories(chart)) {
      lines.push_back({curve.name, curve_style(*colour) + " theory"});
    }
  }
  if (has_several_theories(chart)) lines.push_back({"dashed: theory", "theory"});
  if (grey > 0) lines.push_back({fmt::format("{} more, between these", grey), "grey"});
  return lines;
}

void draw_legend(SvgDrawing& drawing, const std::vector<LegendLine>& lines) {
  double y = chart_legend_top;
  for (const LegendLine& line : lines) {
    if (line.has_line) drawing.line({chart_left, y - 4}, {chart_left + 25, y - 4}, line.style);
    if (line.is_marked) drawing.path(disc_at(chart_left + 12.5, y - 4), line.style + " dot");
    drawing.text({chart_left + 32, y}, line.words, "");
    y += chart_legend_step;
  }
}

}  // namespace

std::string title_of(const ChartAxis& axis) {
  return axis.words.empty() ? axis.label : axis.words + ", " + axis.label;
}

std::string level_text(double ratio) { return fmt::format("{:g} %", 100 * ratio); }

std::optional<std::size_t> colour_of(const Chart& chart, std::size_t curve) {
  const auto begin = chart.curves.begin();
  const auto count = [](auto from, auto to) {
    return std::count_if(from, to, [](const ChartCurve& c) { return c.kind != CurveKind::theory; });
  };
  const auto all = static_cast<std::size_t>(count(begin, chart.curves.end()));
  const auto until = count(begin, begin + static_cast<std::ptrdiff_t>(curve) + 1);
  const auto place = static_cast<std::size_t>(std::max<std::ptrdiff_t>(until, 1)) - 1;
  if (all <= most_coloured) return place;
  for (std::size_t colour = 0; colour < most_coloured; ++colour)
    if (place == colour * (all - 1) / (most_coloured - 1)) return colour;
  return std::nullopt;
}

std::vector<NamedPlace> named_places(const Chart& chart) {
  const std::vector<LaidCurve> curves = laid_curves(chart, paper_for(chart));
  std::vector<NamedPlace> places;
  for (const CurveLabel& label : labels_on(curves))
    places.push_back({curves[label.curve].name, label});
  return places;
}

std::string chart_as_svg(const Chart& chart) {
  const std::vector<LegendLine> legend = legend_of(chart);
  const double height = chart_legend_top + chart_legend_step * static_cast<double>(legend.size());
  SvgDrawing drawing(chart_width, height, chart.title, chart.description);
  const Paper paper = paper_for(chart);
  draw_axes(drawing, chart, paper);
  draw_level(drawing, chart, paper);
  for (const bool is_grey : {true, false})
    for (std::size_t i = 0; i < chart.curves.size(); ++i)
      if (colour_of(chart, i).has_value() != is_grey) draw_curve(drawing, paper, chart, i);
  draw_names(drawing, laid_curves(chart, paper));
  draw_legend(drawing, legend);
  return drawing.finished();
}

}  // namespace sim
