#include "sim/listening/listening_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/report/estimate_text.hpp"
#include "sim/report/outside_report.hpp"
#include "sim/report/point_report.hpp"
#include "sim/report/text_table.hpp"

namespace sim {
namespace {

bool may_send(const LoadedScenario& scenario) {
  return scenario.base.listening.device_sends != 0 ||
         std::ranges::find(scenario.sweep, "listening.device_sends", &Axis::key) !=
             scenario.sweep.end();
}

std::vector<TextColumn> columns_of(const LoadedScenario& scenario) {
  std::vector<TextColumn> columns = axis_columns(scenario.sweep);
  columns.push_back({{"hours", "of line", "[h]"}, 8});
  columns.push_back({{"", "characters", "read"}, number_width});
  columns.push_back({{"", "lines", "refused"}, 8});
  if (may_send(scenario)) {
    columns.push_back({{"messages", "", "sent"}, 8});
    columns.push_back({{"", "", "delivered"}, 9});
    columns.push_back({{"undetected", "", "errors"}, number_width});
    columns.push_back({{"undetected errors", "[1/h]", "[interval]"}, -estimate_width});
  }
  columns.push_back({{"", "false", "accepts"}, 8});
  columns.push_back({{"false accepts", "[1/h]", "[interval]"}, -estimate_width});
  columns.push_back(outside_column());
  return columns;
}

}  // namespace

std::string listening_header(const LoadedScenario& scenario) {
  return table_head(columns_of(scenario));
}

std::string listening_row(const LoadedScenario& scenario, const ListeningPoint& point) {
  const ListeningTally& tally = point.tally;
  std::vector<std::string> texts = coordinate_texts(scenario.sweep, point.coordinates);
  texts.push_back(fmt::format("{:.4g}", point.hours));
  texts.push_back(fmt::format("{}", tally.n_characters));
  texts.push_back(fmt::format("{}", tally.n_rejected));
  if (may_send(scenario)) {
    texts.push_back(fmt::format("{}", tally.n_frames));
    texts.push_back(fmt::format("{}", tally.n_frames_ok));
    texts.push_back(fmt::format("{}", tally.n_frames_undetected));
    texts.push_back(estimate_text(point.undetected_per_hour()));
  }
  texts.push_back(fmt::format("{}", tally.n_frames_false));
  texts.push_back(estimate_text(point.false_per_hour()));
  texts.push_back(outside_mark(point.outside));
  return table_line(columns_of(scenario), texts);
}

namespace {

constexpr PointReport<ListeningPoint> listening_report{listening_header, listening_row, nullptr,
                                                       listening_dataset};

}  // namespace

constinit const ExperimentEngine listening_engine =
    experiment_engine<listening_measurement, listening_report>;

}  // namespace sim
