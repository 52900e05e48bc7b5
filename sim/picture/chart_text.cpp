#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "sim/picture/axis_span.hpp"
#include "sim/picture/chart.hpp"

namespace sim {
namespace {

constexpr int cell_columns = 64, cell_rows = 15;
constexpr int label_width = 10;

/// Of the curves that were measured, in turn.
constexpr std::string_view curve_marks = "ox+#@%ABCDEFGHIJKLMNPQRSTUVWYZ";
constexpr char theory_mark = '.', limit_mark = 'v', several_mark = '*', level_mark = '-';

/// Values along one axis, as the paper has them.
class CellScale : public AxisSpan {
 public:
  CellScale(const ChartAxis& axis, int cells) : AxisSpan(axis), cells_(cells) {}

  /// To whole decades of a logarithmic axis.
  void widen() {
    if (!is_logarithmic() || !(least() <= greatest())) return;
    const double from = lower_exponent(), to = upper_exponent();
    cover(std::pow(10, from));
    cover(std::pow(10, to));
  }
  int cell(double value) const {
    const double from = on_axis(least()), span = on_axis(greatest()) - from;
    const double share = span > 0 ? (on_axis(value) - from) / span : 0.5;
    return static_cast<int>(std::lround(share * (cells_ - 1)));
  }
  /// What stands beside the cells that have a mark: powers of ten, or the least and the greatest.
  std::map<int, std::string> labels() const {
    if (!is_logarithmic() || !(least() <= greatest()))
      return {{0, fmt::format("{:.4g}", least())}, {cells_ - 1, fmt::format("{:.4g}", greatest())}};
    std::map<int, std::string> labels;
    const double step = std::ceil((upper_exponent() - lower_exponent()) / (cells_ - 1));
    for (double exponent = upper_exponent(); exponent >= lower_exponent(); exponent -= step)
      labels[cell(std::pow(10, exponent))] = label(std::pow(10, exponent));
    return labels;
  }

 private:
  int cells_;
};

class CellPaper {
 public:
  CellPaper(const CellScale& x, const CellScale& y)
      : x_(x), y_(y), lines_(cell_rows, std::string(static_cast<std::size_t>(cell_columns), ' ')) {}

  void mark(double x, double y, char with) {
    if (!x_.shows(x) || !y_.shows(y)) return;
    char& at = lines_[static_cast<std::size_t>(cell_rows - 1 - y_.cell(y))]
                     [static_cast<std::size_t>(x_.cell(x))];
    if (at == ' ' || at == level_mark || at == with || at == theory_mark)
      at = with;
    else if (with != theory_mark)
      at = several_mark;
  }
  /// A line across, which all else covers, and what stands at its end.
  void draw_level(double level) {
    std::string& line = lines_[static_cast<std::size_t>(cell_rows - 1 - y_.cell(level))];
    for (std::size_t at = 0; at < line.size(); at += 2) line[at] = level_mark;
    line += " " + level_text(level);
  }
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  const CellScale& x_;
  const CellScale& y_;
  std::vector<std::string> lines_;
};

std::string label(const ChartAxis& axis) {
  return axis.label + (axis.logarithmic ? ", logarithmic" : "");
}

std::vector<char> marks_of(const std::vector<ChartCurve>& curves) {
  std::vector<char> found;
  std::size_t measured = 0;
  for (const ChartCurve& curve : curves)
    found.push_back(curve.kind == CurveKind::theory ? theory_mark
                                                    : curve_marks[measured++ % curve_marks.size()]);
  return found;
}

bool has_limits(const Chart& chart) {
  return std::ranges::any_of(chart.curves, [](const ChartCurve& curve) {
    return std::ranges::any_of(curve.points, &ChartPoint::is_limit);
  });
}

/// A head and names behind it, in lines no wider than the paper.
std::string wrapped(const std::string& head, const std::vector<std::string>& names) {
  std::string text, line = head;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string next = names[i] + (i + 1 < names.size() ? "," : "");
    if (line.size() + 1 + next.size() > cell_columns) {
      text += fmt::format("{:>{}}  {}\n", "", label_width, line);
      line = next;
    } else {
      line += " " + next;
    }
  }
  return text + fmt::format("{:>{}}  {}\n", "", label_width, line);
}

std::string legend(const Chart& chart) {
  std::vector<std::string> names;
  const std::vector<char> found = marks_of(chart.curves);
  for (std::size_t i = 0; i < found.size(); ++i)
    names.push_back(fmt::format("{} {}", found[i], chart.curves[i].name));
  if (has_limits(chart)) names.push_back(fmt::format("{} less than that", limit_mark));
  const auto measured = std::ranges::count_if(
      chart.curves, [](const ChartCurve& curve) { return curve.kind != CurveKind::theory; });
  if (measured > 1)
    names.push_back(fmt::format("{} {}", several_mark, measured == 2 ? "both" : "several"));
  return wrapped(label(chart.y) + ";", names);
}

/// Where a point is marked: a limit at its upper end.
double height_of(const ChartPoint& point) { return point.is_limit ? point.high : point.y; }

std::string framed(const CellPaper& paper, const CellScale& x, const CellScale& y,
                   const ChartAxis& axis) {
  std::string text;
  std::map<int, std::string> labels = y.labels();
  for (int row = 0; row < cell_rows; ++row) {
    std::string line = fmt::format("{:>{}} |{}", labels[cell_rows - 1 - row], label_width,
                                   paper.lines()[static_cast<std::size_t>(row)]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  text += fmt::format("{:>{}} +{:-<{}}\n", "", label_width, "", cell_columns);
  text += fmt::format("{:>{}}  {:<{}.4g}{:^{}}{:>{}.4g}\n", "", label_width, x.least(), 10,
                      label(axis), cell_columns - 20, x.greatest(), 10);
  return text;
}

}  // namespace

std::string chart_as_text(const Chart& chart) {
  CellScale across(chart.x, cell_columns), up(chart.y, cell_rows);
  for (const ChartCurve& curve : chart.curves)
    for (const ChartPoint& point : curve.points) {
      across.cover(point.x);
      up.cover(height_of(point));
    }
  up.cover_level(chart.y);
  up.widen();
  CellPaper paper(across, up);
  if (chart.y.level) paper.draw_level(*chart.y.level);
  const std::vector<char> found = marks_of(chart.curves);
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const ChartPoint& point : chart.curves[i].points)
      paper.mark(point.x, height_of(point), point.is_limit ? limit_mark : found[i]);
  return legend(chart) + framed(paper, across, up, chart.x);
}

std::string charts_as_text(const std::vector<Chart>& charts) {
  if (charts.empty())
    return "nothing to plot: no number is swept, or nothing is known at its points\n";
  std::string text;
  for (const Chart& chart : charts) text += "\n" + chart_as_text(chart);
  return text + "\n";
}

}  // namespace sim
