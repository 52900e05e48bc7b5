#include "sim/section/dataset_shares.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "sim/scenario/sweep.hpp"
#include "sim/section/dataset_cells.hpp"
#include "sim/section/dataset_words.hpp"
#include "sim/section/swept_rows.hpp"

namespace sim {
namespace {

constexpr std::size_t most_kinds = 9;  // of share_bars.hpp

/// All that would be too many become the last.
void join_rest(std::vector<std::string>& kinds) {
  if (kinds.size() <= most_kinds) return;
  kinds.resize(most_kinds);
  kinds.back() = "all others";
}

void join_rest(std::vector<std::uint64_t>& counts) {
  for (; counts.size() > most_kinds; counts.pop_back()) counts[most_kinds - 1] += counts.back();
}

std::vector<std::string> words_of(const std::vector<CountedKind>& kinds) {
  std::vector<std::string> words;
  for (const CountedKind& kind : kinds) words.push_back(kind.words);
  return words;
}

std::vector<DatasetCells> share_cells(const Dataset& data, const std::vector<CountedKind>& kinds) {
  std::vector<DatasetCells> cells;
  for (const CountedKind& kind : kinds) cells.emplace_back(data, kind.name);
  return cells;
}

std::uint64_t sum_at(const DatasetCells& cells, std::size_t point, std::size_t points) {
  const std::size_t each = cells.size() / points;
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < each; ++i) sum += cells.count(point * each + i);
  return sum;
}

}  // namespace

ShareBars point_shares(const Dataset& data, const std::string& title, const std::string& of,
                       std::vector<std::string> kinds,
                       const std::function<std::vector<std::uint64_t>(std::size_t point)>& counts) {
  const SweptRows rows(data.axes);
  join_rest(kinds);
  ShareBars bars{.title = title,
                 .description = fmt::format(
                     "Share of {}{}", of,
                     rows.joins_points()
                         ? ", of all other values of the sweep together: each point weighs the same"
                         : ""),
                 .rows_label = rows.head(),
                 .are_shares = rows.joins_points(),
                 .kinds = std::move(kinds),
                 .rows = {}};
  for (const std::size_t point : measured_points(data)) {
    std::vector<std::uint64_t> all = counts(point);
    join_rest(all);
    add_counts(bars, rows.label(point_coordinates(data.axes, point)), rows.weighed(all));
  }
  return bars;
}

ShareBars point_shares(const Dataset& data, const std::string& title, const std::string& of,
                       const std::vector<CountedKind>& kinds) {
  const std::vector<DatasetCells> cells = share_cells(data, kinds);
  const std::size_t points = count_points(data.axes);
  return point_shares(data, title, of, words_of(kinds), [&](std::size_t point) {
    std::vector<std::uint64_t> counts;
    for (const DatasetCells& each : cells) counts.push_back(sum_at(each, point, points));
    return counts;
  });
}

ShareBars element_shares(const Dataset& data, const std::string& title, const std::string& of,
                         const std::vector<CountedKind>& kinds) {
  ShareBars bars{.title = title,
                 .description = "Share of " + of,
                 .rows_label = {},
                 .kinds = words_of(kinds),
                 .rows = {}};
  const Dataset::Variable* first = find_variable(data, kinds.front().name);
  if (first == nullptr || first->dimensions.size() != 1) return bars;
  const Dataset::Dimension& dimension = dimension_named(data, first->dimensions.front());
  const std::vector<DatasetCells> cells = share_cells(data, kinds);
  bars.rows_label = dimension.facts.name;
  for (std::size_t i = 0; i < dimension.size(); ++i) {
    std::vector<std::uint64_t> counts;
    for (const DatasetCells& each : cells) counts.push_back(each.count(i));
    add_counts(bars, value_text(dimension, i), counts);
  }
  return bars;
}

}  // namespace sim
