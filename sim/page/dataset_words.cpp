#include "sim/page/dataset_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/page/dataset_cells.hpp"
#include "sim/report/swept_curves.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {

std::vector<std::size_t> measured_points(const Dataset& data) {
  DatasetCells runs(data, "n_runs");
  if (runs.empty()) runs = DatasetCells(data, "n_trials");
  std::vector<std::size_t> measured;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i] > 0) measured.push_back(i);
  return measured;
}

std::string place_text(const Dataset& data, std::size_t point) {
  return other_values(data.axes, {}, point_coordinates(data.axes, point));
}

std::string extremes(const Dataset& data, const std::string& name, const std::string& what,
                     const std::string& unit) {
  const DatasetCells cells(data, name);
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!std::isnan(cells[i])) known.push_back(i);
  if (known.empty()) return "";
  const auto [least, greatest] =
      std::ranges::minmax_element(known, {}, [&](std::size_t i) { return cells[i]; });
  if (cells[*least] == cells[*greatest])
    return fmt::format("{} is {}{}{}.\n", what, cells.text(*least), unit,
                       known.size() > 1 ? " at all points" : "");
  return fmt::format("{} is least at {}: {}{}, and greatest at {}: {}{}.\n", what,
                     place_text(data, *least), cells.text(*least), unit,
                     place_text(data, *greatest), cells.text(*greatest), unit);
}

std::string missing_points(const Dataset& data) {
  const std::size_t all = count_points(data.axes), measured = measured_points(data).size();
  if (measured == all) return "";
  return fmt::format("The run was interrupted: {} of {} points were not finished.\n",
                     all - measured, all);
}

}  // namespace sim
