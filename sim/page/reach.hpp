#pragma once
// How far links reach, be they of one result or of several: in a line and as a table.
#include <string>
#include <vector>

#include "sim/page/page.hpp"

namespace sim {

struct Reach {
  std::string along;    // the key
  std::string link;     // "receiver.module = TSOP4856"; empty of the only one
  std::string words;    // "7.88 [7.60, 8.20] m"
  double merit = 0;     // of its ranking
  bool is_told = true;  // counted far enough to have a place there
};

/// "How far each reaches"; along a key that is no distance more is not farther.
std::string reach_heading(const std::string& along);

/// A line: of a few links how far each reaches, of more which come first, or if that is not known
/// the two ends of their order. At least one, all along one key.
std::string reach_line(const std::vector<Reach>& reaches, const std::vector<std::string>& first);

/// The same as a table, best first.
PageSection reach_section(std::vector<Reach> reaches);

}  // namespace sim
