#pragma once
// How far each of several links reaches: a bar each, with its interval, and behind it where most
// units of its part end.
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sim {

struct ReachBar {
  std::string label, words;  // the link, and how far it reaches
  double at = 0;             // the end of its reach; infinite: beyond the axis
  double low = 0, high = 0;  // its interval, ends as `at`
  std::optional<std::pair<double, double>> units{};  // from where to where most units end
};

struct ReachBars {
  std::string title, description;
  std::string axis;            // what it reaches along, with its unit
  double from = 0, to = 1;     // the axis
  std::vector<ReachBar> bars;  // at least one
};

std::string reach_bars_as_svg(const ReachBars& bars);

}  // namespace sim
