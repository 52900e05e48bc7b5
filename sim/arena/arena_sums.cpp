#include "sim/arena/arena_sums.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/sweep.hpp"
#include "sim/section/dataset_cells.hpp"

namespace sim {
namespace {

using Counts = std::vector<std::int64_t>;

/// A file may be damaged.
bool is_count_of_devices(const Dataset::Variable& variable) {
  return variable.on_axes && variable.dimensions == std::vector<std::string>{"device"} &&
         std::holds_alternative<Counts>(variable.values);
}

void add_sent(Dataset& data) {
  const Dataset::Variable* messages = find_variable(data, "n_messages");
  if (messages == nullptr || !is_count_of_devices(*messages)) return;
  const DatasetCells all(data, "n_messages"), silent(data, "n_silent");
  Counts sent;
  for (std::size_t i = 0; i < all.size(); ++i)
    sent.push_back(static_cast<std::int64_t>(all.count(i)) -
                   static_cast<std::int64_t>(silent.count(i)));
  data.variables.push_back({{"n_messages_sent", "1", "messages but for silent spells"},
                            true,
                            {"device"},
                            std::move(sent)});
}

Counts sums_of(const Dataset& data, const Dataset::Variable& variable) {
  const DatasetCells cells(data, variable.facts.name);
  const std::size_t each = cells_a_point(data, variable), points = count_points(data.axes);
  Counts sums(points);
  for (std::size_t p = 0; p < points; ++p) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < each; ++i) sum += cells.count(p * each + i);
    sums[p] = static_cast<std::int64_t>(sum);
  }
  return sums;
}

}  // namespace

void add_message_sums(Dataset& data) {
  add_sent(data);
  std::vector<Dataset::Variable> totals;
  for (const Dataset::Variable& variable : data.variables)
    if (is_count_of_devices(variable))
      totals.push_back({{"total_" + variable.facts.name, "1", "of all devices"},
                        true,
                        {},
                        sums_of(data, variable)});
  for (Dataset::Variable& total : totals) data.variables.push_back(std::move(total));
}

}  // namespace sim
