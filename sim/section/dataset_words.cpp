#include "sim/section/dataset_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/section/dataset_cells.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

/// Of each point.
DatasetCells runs_of(const Dataset& data) {
  const DatasetCells runs(data, "n_runs");
  return runs.empty() ? DatasetCells(data, "n_trials") : runs;
}

/// Runs or trials that a point is to have, of the shards that the result has.
double wanted_runs(const Scenario& scenario, const Dataset& data) {
  const std::uint32_t all = runs_asked_for(scenario);
  double sum = 0;
  for (const Shard& shard : data.shards) {
    const TrialRange range = sim::runs_of(shard, all);
    sum += static_cast<double>(range.last - range.first);
  }
  return sum;
}

/// Cells of a variable as they are compared: where nothing was found by the interval's upper end.
class Compared {
 public:
  Compared(const Dataset& data, const std::string& name)
      : cells_(data, name),
        lows_(data, name + "_ci_low"),
        highs_(data, name + "_ci_high"),
        points_(count_points(data.axes)) {}

  std::vector<std::size_t> known() const {
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < points_; ++i)
      if (!std::isnan(cells_[i])) known.push_back(i);
    return known;
  }
  std::pair<double, double> operator()(std::size_t i) const {
    return {cells_[i], std::isnan(highs_[i]) ? 0 : highs_[i]};
  }
  std::string text(std::size_t i) const { return cells_.text(i); }
  /// Whether their intervals are apart, or one has none.
  bool are_apart(std::size_t less, std::size_t more) const {
    return !(highs_[less] >= lows_[more]);
  }

 private:
  DatasetCells cells_, lows_, highs_;
  std::size_t points_;
};

/// Where several points are as little, or as great.
std::string at_all(const Dataset& data, std::size_t known) {
  const std::size_t points = count_points(data.axes);
  if (points == 1) return "";
  return known == points ? " at all points"
                         : fmt::format(" at the {} of {} points where it is known", known, points);
}

/// The point, or how many there are that are no different.
std::string places_of(const Dataset& data, const std::vector<std::size_t>& known,
                      const Compared& cells, std::size_t point) {
  const auto same =
      std::ranges::count_if(known, [&](std::size_t other) { return cells(other) == cells(point); });
  return same == 1 ? place_text(data, point) : fmt::format("{} of {} points", same, known.size());
}

}  // namespace

std::vector<std::size_t> measured_points(const Dataset& data) {
  const DatasetCells runs = runs_of(data);
  std::vector<std::size_t> measured;
  for (std::size_t i = 0; i < std::min(runs.size(), count_points(data.axes)); ++i)
    if (runs[i] > 0) measured.push_back(i);
  return measured;
}

std::string plain_words(const std::string& name) {
  if (name == "not_converged") return "did not converge";
  std::string words = name;
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string runs_text(const Dataset& data) {
  const std::size_t points = measured_points(data).size();
  return fmt::format("{} run{}{}", data.n_runs, data.n_runs == 1 ? "" : "s",
                     points > 1 ? fmt::format(" at {} points", points) : "");
}

std::string extremes(const Dataset& data, const std::string& name, const std::string& what,
                     const std::string& unit) {
  const Compared cells(data, name);
  const std::vector<std::size_t> known = cells.known();
  if (known.empty()) return "";
  const auto [least, greatest] = std::ranges::minmax_element(known, {}, cells);
  if (cells(*least) == cells(*greatest))
    return fmt::format("{} is {}{}{}.\n", what, cells.text(*least), unit,
                       at_all(data, known.size()));
  return fmt::format("{} is least at {}: {}{}, and greatest at {}: {}{}{}.\n", what,
                     places_of(data, known, cells, *least), cells.text(*least), unit,
                     places_of(data, known, cells, *greatest), cells.text(*greatest), unit,
                     cells.are_apart(*least, *greatest) ? "" : ", which is no clear difference");
}

std::string extremes_of(const Dataset& data, const std::vector<ColumnFacts>& columns) {
  std::string lines;
  for (const ColumnFacts& column : columns) {
    if (!column.is_stored() || !column.drawing || !column.over.empty()) continue;
    const std::string unit = unit_text(column.facts.unit);
    lines +=
        extremes(data, column.facts.name, column.drawing->title, unit.empty() ? "" : " " + unit);
  }
  return lines;
}

std::string missing_points(const StoredDataset& stored) {
  const Dataset& data = stored.data;
  const DatasetCells runs = runs_of(data);
  const std::size_t points = count_points(data.axes);
  std::size_t unfinished = 0, untouched = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const double wanted =
        wanted_runs(point_scenario(stored.scenario, point_coordinates(data.axes, i)), data);
    if (!(runs[i] >= wanted)) ++unfinished;
    if (!(runs[i] > 0)) ++untouched;
  }
  if (unfinished == 0) return "";
  return fmt::format("The run was interrupted: {} of {} points were not finished{}.\n", unfinished,
                     points, untouched > 0 ? fmt::format(", {} of them not begun", untouched) : "");
}

}  // namespace sim
