#pragma once
// Tornado: how far an answer moves with each of several causes, the strongest on top. A bar in two
// pieces goes from the answer to where a low and to where a high value of the cause brings it.
#include <string>
#include <vector>

namespace sim {

struct RangeBar {
  std::string label;                // the cause
  double at_low = 0, at_high = 0;   // the answer where the cause is low, and where it is high
  std::string low_text, high_text;  // what is low and high of it
};

struct RangeBars {
  std::string title, description;
  std::string axis;            // the answer, with its unit
  double middle = 0;           // the answer as it is
  std::vector<RangeBar> bars;  // at least one
};

std::string range_bars_as_svg(const RangeBars& bars);

}  // namespace sim
