#include "sim/text/spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <string_view>
#include <vector>

#include "sim/text/list_text.hpp"

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

/// Its words in the order of the alphabet: "agc_duty_max" of "agc_max_duty".
std::string sorted_words(const std::string& name) {
  std::vector<std::string_view> words = split(name, '_');
  std::ranges::sort(words);
  return fmt::format("{}", fmt::join(words, "_"));
}

/// Edits; a name cut short, as by a forgotten unit, is only one slip, and words in another order.
std::size_t slips(const std::string& name, const std::string& candidate) {
  if (candidate.starts_with(name)) return 1;
  return std::min(edit_distance(name, candidate),
                  1 + edit_distance(sorted_words(name), sorted_words(candidate)));
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
