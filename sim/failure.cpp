#include "sim/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace sim {
namespace {

bool is_control(char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }

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

/// Edit distance, except that a name cut short, as by a forgotten unit, is only one slip.
std::size_t slips(const std::string& name, const std::string& candidate) {
  return candidate.starts_with(name) ? 1 : edit_distance(name, candidate);
}

std::size_t unlikeness(const std::string& name, const std::string& candidate) {
  const std::size_t dot = candidate.find('.');
  if (dot == std::string::npos) return slips(name, candidate);
  return std::min(slips(name, candidate), 1 + slips(name, candidate.substr(dot + 1)));
}

}  // namespace

Failure bad_input(const std::string& problem, const std::string& why,
                  const std::string& suggestion) {
  std::string line = fmt::format("{} ({}) {}", problem, why, suggestion);
  std::ranges::replace_if(line, is_control, '?');
  return {ExitCode::bad_input, line};
}

std::string nearest(const std::string& name, const std::vector<std::string>& candidates) {
  const auto likeness = [&](const std::string& c) { return unlikeness(name, c); };
  const auto best = std::ranges::min_element(candidates, {}, likeness);
  return best == candidates.end() ? "" : *best;
}

}  // namespace sim
