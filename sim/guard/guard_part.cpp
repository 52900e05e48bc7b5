#include "sim/guard/guard_part.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/arena/arena_part.hpp"
#include "sim/page/dataset_cells.hpp"
#include "sim/page/dataset_words.hpp"
#include "sim/page/experiment_part.hpp"

namespace sim {
namespace {

/// Those of an arena; what was delivered goes on to the base station.
std::vector<CountedKind> guard_fates() {
  std::vector<CountedKind> fates = arena_fates();
  fates.front() = {"n_known", "known to the base station"};
  fates.push_back({"n_replaced", "replaced by a newer one"});
  fates.push_back({"n_sharedlink_lost", "lost by SharedLink"});
  return fates;
}

/// Of all devices and points.
std::string known_of(const Dataset& data) {
  const double known = DatasetCells(data, "n_known").sum();
  const double messages = DatasetCells(data, "n_messages").sum();
  return messages == 0 ? ""
                       : fmt::format(
                             "The base station got to know {:.0f} of {:.0f} messages that "
                             "the devices had to send.\n",
                             known, messages);
}

/// A file may be damaged.
bool is_of_devices(const Dataset::Variable* variable) {
  return variable != nullptr && variable->dimensions == std::vector<std::string>{"device"};
}

std::string oldest_of(const Dataset& data) {
  const Dataset::Variable* variable = find_variable(data, "age_mean_s");
  const DatasetCells ages(data, "age_mean_s"), p95(data, "age_p95_s");
  std::size_t oldest = 0;
  for (std::size_t i = 1; i < ages.size(); ++i)
    if (!(ages[i] <= ages[oldest])) oldest = std::isnan(ages[i]) ? oldest : i;
  if (!is_of_devices(variable) || std::isnan(ages[oldest])) return "";
  const std::size_t each = cells_a_point(data, *variable);
  const std::string place = place_text(data, oldest / each);
  return fmt::format("What it knows is oldest of {}{}: {:.3g} s on average{}.\n",
                     value_text(dimension_named(data, "device"), oldest % each),
                     place.empty() ? "" : " at " + place, ages[oldest],
                     std::isnan(p95[oldest])
                         ? ""
                         : fmt::format(", {:.3g} s or less for 95 % of the time", p95[oldest]));
}

}  // namespace

ReportPart guard_part(const std::string& name, const StoredDataset& stored) {
  ReportPart part = part_of_messages(name, stored, guard_fates());
  part.verdict += known_of(stored.data) + oldest_of(stored.data);
  add_chart(part, swept_chart(stored.data, {.name = "age_mean_s",
                                            .title = "Age of what the base station knows",
                                            .label = "mean age [s]"}));
  return part;
}

}  // namespace sim
