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
  bool are_shares{};               // the counts tell shares alone, not how many there were
  std::vector<std::string> kinds;  // at most nine
  std::vector<ShareRow> rows;      // at least one
};

/// Adds to the row of that label, which is added where there is none.
void add_counts(ShareBars& bars, const std::string& label,
                const std::vector<std::uint64_t>& counts);

/// As SVG; a row that counts nothing is an empty bar.
std::string share_bars_as_svg(const ShareBars& bars);

}  // namespace sim
