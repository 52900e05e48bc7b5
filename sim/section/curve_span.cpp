#include "sim/section/curve_span.hpp"

#include <fmt/format.h>

#include "sim/result/place_text.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {

std::optional<CurveSpan> longest_span(const ChartCurve& curve, double least) {
  std::optional<CurveSpan> longest, now;
  for (const ChartPoint& point : curve.points) {
    if (!(point.y >= least)) {
      now.reset();
      continue;
    }
    if (!now) now = {curve.name, point.x, point.x};
    now->to = point.x;
    now->is_at_first = now->from == curve.points.front().x;
    now->is_at_last = now->to == curve.points.back().x;
    if (!longest || now->length() >= longest->length()) longest = now;
  }
  return longest;
}

std::string in_words(const CurveSpan& span, const Axis& x) {
  const std::string of = span.curve.empty() ? "" : " (" + span.curve + ")";
  const char* const begins = span.is_at_first ? ", where the sweep begins" : "";
  const char* const ends = span.is_at_last ? ", where the sweep ends" : "";
  if (span.from == span.to) return quantity(x, fmt::format("{:g}", span.from)) + begins + ends + of;
  return fmt::format("{} from {:g}{}{} to {}{}{}", x.key, span.from, begins,
                     span.is_at_first ? "," : "", with_unit(fmt::format("{:g}", span.to), x.unit),
                     ends, of);
}

}  // namespace sim
