#include "sim/text/spelling.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

namespace sim {
namespace {

/// Levenshtein distance, case aside.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (const char ca : a) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const bool same = std::tolower(static_cast<unsigned char>(ca)) ==
                        std::tolower(static_cast<unsigned char>(b[j]));
      const std::size_t change = diagonal + (same ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({change, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// Edits; a name cut short, as by a forgotten unit, is only one slip.
std::size_t slips(const std::string& name, const std::string& candidate) {
  return candidate.starts_with(name) ? 1 : edit_distance(name, candidate);
}

/// The end of a candidate behind its dot, or all of it.
std::string own_name(const std::string& candidate) {
  return candidate.substr(candidate.find('.') + 1);
}

}  // namespace

std::string nearest(const std::string& name, const std::vector<std::string>& candidates) {
  const auto unlikeness = [&](const std::string& candidate) {
    return std::min(slips(name, candidate), 1 + slips(name, own_name(candidate)));
  };
  const auto best = std::ranges::min_element(candidates, {}, unlikeness);
  return best == candidates.end() ? "" : *best;
}

bool is_near(const std::string& name, const std::string& candidate) {
  const std::size_t fewest = std::min(slips(name, candidate), slips(name, own_name(candidate)));
  return 3 * fewest <= name.size();
}

}  // namespace sim
