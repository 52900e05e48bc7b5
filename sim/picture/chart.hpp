#pragma once
// A chart of curves with their intervals, of what was measured and of what theory says: one for
// paper, for a terminal and for a report.
#include <string>
#include <vector>

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
};

struct ChartCurve {
  std::string name;
  std::vector<ChartPoint> points;
  CurveKind kind = CurveKind::measured;
};

struct ChartAxis {
  std::string label;  // with its unit
  bool logarithmic = false;
};

struct Chart {
  std::string title, description;
  ChartAxis x, y;
  std::vector<ChartCurve> curves;
};

/// Which of the colours a curve has: a theory that of the curve before it.
std::size_t colour_of(const Chart& chart, std::size_t curve);

/// Lines of characters, each ended by a newline: what the marks are, 15 lines of paper, the lower
/// axis.
/// Intervals are not shown. A logarithmic axis leaves out what is not positive.
std::string chart_as_text(const Chart& chart);

/// As SVG. On a logarithmic axis what is not positive has no place, but limits, which are drawn as
/// arrows from their upper end.
std::string chart_as_svg(const Chart& chart);

}  // namespace sim
