#pragma once
// A chart of one curve, to be drawn in tests.
#include <utility>
#include <vector>

#include "sim/picture/chart.hpp"

namespace sim {

inline Chart chart_of(std::vector<ChartPoint> points, bool logarithmic) {
  return {.title = "t",
          .description = "d",
          .x = {"x", false},
          .y = {"y", logarithmic},
          .curves = {{"c", std::move(points)}}};
}

}  // namespace sim
