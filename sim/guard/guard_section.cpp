#include "sim/guard/guard_section.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "sim/arena/arena_section.hpp"
#include "sim/arena/sender.hpp"
#include "sim/guard/guard_check.hpp"
#include "sim/guard/guard_report.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/section/dataset_cells.hpp"
#include "sim/section/dataset_words.hpp"
#include "sim/section/experiment_section.hpp"

namespace sim {
namespace {

/// Those of an arena; what was delivered goes on to the base station.
std::vector<CountedKind> guard_losses() {
  std::vector<CountedKind> losses = arena_losses();
  losses.front() = {"n_known", "known to the base station"};
  losses.push_back({"n_replaced", "replaced by a newer one"});
  losses.push_back({"n_sharedlink_lost", "lost by SharedLink"});
  return losses;
}

/// Of all devices and points: of those that were sent, as in what is said before.
std::string known_of(const Dataset& data) {
  const double sent = DatasetCells(data, "n_messages").sum() - DatasetCells(data, "n_silent").sum();
  return sent == 0 ? ""
                   : fmt::format("The base station got to know {:.0f} of the {:.0f} messages.\n",
                                 DatasetCells(data, "n_known").sum(), sent);
}

/// A file may be damaged.
bool is_of_devices(const Dataset::Variable* variable) {
  return variable != nullptr && variable->dimensions == std::vector<std::string>{"device"};
}

/// A device at a point, by its cell of a variable: "lamp at guard.query_age_s = 5 s".
std::string device_text(const Dataset& data, const Dataset::Variable& variable, std::size_t cell) {
  const std::size_t each = cells_a_point(data, variable);
  const std::string place = place_text(data, cell / each);
  return value_text(dimension_named(data, "device"), cell % each) +
         (place.empty() ? "" : " at " + place);
}

/// The cell with the greatest number of several, of a variable of devices; nothing where no cell is
/// known, or none stands out.
std::optional<std::size_t> greatest(const Dataset& data, const std::string& name) {
  const DatasetCells cells(data, name);
  if (!is_of_devices(find_variable(data, name))) return std::nullopt;
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!std::isnan(cells[i])) known.push_back(i);
  if (known.size() < 2) return std::nullopt;
  const auto value = [&](std::size_t i) { return cells[i]; };
  const std::size_t found = *std::ranges::max_element(known, {}, value);
  if (std::ranges::count(known, cells[found], value) > 1) return std::nullopt;
  return found;
}

/// "8.7 s on average, 24 s or less for 95 % of the time".
std::string age_text(const std::string& old, double mean_s, double p95_s) {
  return fmt::format(
      "{:.3g} s{} on average{}", mean_s, old,
      std::isnan(p95_s) ? "" : fmt::format(", {:.3g} s or less for 95 % of the time", p95_s));
}

std::string oldest_of(const Dataset& data) {
  const std::optional<std::size_t> oldest = greatest(data, "age_mean_s");
  if (!oldest) return "";
  return fmt::format("What it knows is oldest of {}: {}.\n",
                     device_text(data, *find_variable(data, "age_mean_s"), *oldest),
                     age_text("", DatasetCells(data, "age_mean_s")[*oldest],
                              DatasetCells(data, "age_p95_s")[*oldest]));
}

std::string least_known_of(const Dataset& data) {
  const std::optional<std::size_t> least = greatest(data, "unknown_share");
  const double share = least ? DatasetCells(data, "unknown_share")[*least] : 0;
  constexpr double told = 0.0005;  // less would be 0.0 %
  if (!(share >= told)) return "";
  return fmt::format("Nothing is known most often of {}: {} of the time.\n",
                     device_text(data, *find_variable(data, "unknown_share"), *least),
                     percent_text(share));
}

/// Of all devices together. Files of earlier versions lack it.
std::string ages_of(const Dataset& data) {
  if (!data.axes.empty())
    return extremes(data, "total_age_mean_s", "The mean age of what it knows", " s") +
           extremes(data, "total_unknown_share",
                    "The share of time in which it knows nothing of a device, as a mean of all "
                    "devices,");
  const double mean_s = DatasetCells(data, "total_age_mean_s")[0];
  const double unknown = DatasetCells(data, "total_unknown_share")[0];
  std::string text;
  if (!std::isnan(mean_s))
    text = fmt::format("What it knows is {}.\n",
                       age_text(" old", mean_s, DatasetCells(data, "total_age_p95_s")[0]));
  if (!std::isnan(unknown))
    text +=
        fmt::format("For {} of the time, as a mean of all devices, it knows nothing of a device.\n",
                    percent_text(unknown));
  return text;
}

/// Names of columns of ages. `of`: "" of each device, "total_" of all.
void add_age_columns(std::vector<std::string>& names, const std::string& of) {
  for (const char* name : {"age_mean_s", "age_p95_s", "unknown_share"}) names.push_back(of + name);
}

/// The variable of each device at each point, by the device's name.
std::vector<std::map<std::string, std::string>> variables_of(const StoredDataset& stored) {
  std::vector<std::map<std::string, std::string>> variables(count_points(stored.data.axes));
  for (std::size_t p = 0; p < variables.size(); ++p) {
    const std::vector<Sender> senders =
        make_senders(point_scenario(stored.scenario, point_coordinates(stored.data.axes, p)));
    const std::vector<std::string> names = shared_variables(senders);
    for (std::size_t i = 0; i < senders.size(); ++i) variables[p][senders[i].name] = names[i];
  }
  return variables;
}

DatasetColumn variable_column(const StoredDataset& stored) {
  const Dataset::Dimension& devices = dimension_named(stored.data, "device");
  return {"n_messages", "variable",
          [devices, variables = variables_of(stored)](std::size_t cell) -> std::string {
            const std::size_t point = cell / devices.size();
            if (point >= variables.size()) return "-";  // a file may be damaged
            const auto found = variables[point].find(value_text(devices, cell % devices.size()));
            return found == variables[point].end() ? "-" : found->second;
          }};
}

std::vector<DatasetColumn> device_table_columns(const StoredDataset& stored) {
  std::vector<std::string> names{"n_messages", "n_known"};
  add_age_columns(names, "");
  add_message_columns(names, "");
  names.insert(names.end(), {"n_replaced", "n_sharedlink_lost", "n_runs_heard", "latency_mean_s",
                             "irradiance_mw_per_m2"});
  std::vector<DatasetColumn> columns = headed_columns(stored.data, guard_columns().facts(), names);
  columns.insert(columns.begin(), variable_column(stored));
  return columns;
}

std::vector<DatasetColumn> point_table_columns(const Dataset& data) {
  std::vector<std::string> names{"n_runs", "n_devices", "total_n_messages", "total_n_known"};
  add_age_columns(names, "total_");
  names.insert(names.end(), {"n_queries", "n_queries_answered", "n_queries_timed_out",
                             "n_shared_messages_sent", "n_shared_messages_accepted"});
  add_message_columns(names, "total_");
  add_load_columns(names);
  return headed_columns(data, guard_columns().facts(), names);
}

}  // namespace

ReportSection guard_section(const std::string& name, const StoredDataset& stored) {
  const Dataset& data = stored.data;
  ReportSection report = section_of_messages(
      name, stored, {guard_losses(), device_table_columns(stored), point_table_columns(data)});
  report.summary += known_of(data) + ages_of(data) + oldest_of(data) + least_known_of(data);
  add_chart(report, swept_chart(data, drawn_column(guard_columns(), "age_mean_s")));
  return report;
}

}  // namespace sim
