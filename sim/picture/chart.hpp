#pragma once
// A chart of curves with their intervals, of what was measured and of what theory says: one for
// paper, for a terminal and for a report.
#include <optional>
#include <string>
#include <vector>

#include "sim/picture/curve_labels.hpp"

namespace sim {

struct ChartPoint {
  double x = 0;
  double y = 0;              // NaN where nothing is known
  double low = 0, high = 0;  // the interval; both y where there is none
  bool is_limit = false;     // nothing was found: the value lies somewhere below `high`
};

enum class CurveKind {
  measured,    // points with their intervals
  theory,      // dashed, without marks
  continuous,  // a line through many points, without marks
  bars,        // one a point, up from 0, with its interval
};

struct ChartCurve {
  std::string name;
  std::vector<ChartPoint> points;
  CurveKind kind = CurveKind::measured;
};

struct ChartAxis {
  std::string label;  // with its unit
  bool logarithmic = false;
  std::string words{};            // what the label is: "distance along the floor"; may be empty
  bool is_count{};                // whole numbers, between which nothing is
  bool from_zero{};               // of the upright axis: 0 is seen, whatever the least value
  std::optional<double> level{};  // of the upright axis: a ratio above 0, seen as a line across
};

struct Chart {
  std::string title, description;
  ChartAxis x, y;
  std::vector<ChartCurve> curves;
};

/// The words and the label: "distance along the floor, receiver.range_m [m]".
std::string title_of(const ChartAxis& axis);

/// What stands at the line across: "1 %".
std::string level_text(double ratio);

/// Of more curves so many have a colour, spread evenly among them; the others are grey.
inline constexpr std::size_t most_coloured = 6;
/// Which of the colours a curve has, a theory that of the curve before it; nothing: it is grey.
std::optional<std::size_t> colour_of(const Chart& chart, std::size_t curve);

struct NamedPlace {
  std::string name;  // without what all names begin with: "5" of "receiver.range_m = 5"
  CurveLabel place;
};
/// Of several curves those that have a colour are named beside them; also on larger paper.
std::vector<NamedPlace> named_places(const Chart& chart);

/// Lines of characters, each ended by a newline: what the marks are, 15 lines of paper, the lower
/// axis. Intervals are not shown. A logarithmic axis leaves out what is not positive; it is marked
/// at powers of ten, upright.
std::string chart_as_text(const Chart& chart);
/// Several, or that there is nothing to plot.
std::string charts_as_text(const std::vector<Chart>& charts);

/// As SVG. On a logarithmic axis what is not positive has no place, but limits, which are drawn as
/// arrows from their upper end.
std::string chart_as_svg(const Chart& chart);

}  // namespace sim
