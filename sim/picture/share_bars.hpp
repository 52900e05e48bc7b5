#pragma once
// Rows of what a whole is made of: bars of one length, in pieces as wide as their shares.
#include <cstdint>
#include <string>
#include <vector>

namespace sim {

struct ShareRow {
  std::string label;
  std::vector<std::uint64_t> counts;  // one a kind; their sum is the whole
};

struct ShareBars {
  std::string title, description;
  std::string rows_label;          // what the rows' labels are
  std::vector<std::string> kinds;  // at most seven
  std::vector<ShareRow> rows;      // at least one
};

/// As SVG; a row that counts nothing is an empty bar.
std::string share_bars_as_svg(const ShareBars& bars);

}  // namespace sim
