#include "sim/false_accepts/false_accept_section.hpp"

#include <fmt/format.h>

#include <utility>

#include "sim/false_accepts/false_accept_report.hpp"
#include "sim/section/dataset_cells.hpp"
#include "sim/section/dataset_shares.hpp"
#include "sim/section/dataset_words.hpp"
#include "sim/section/experiment_section.hpp"
#include "sim/section/picture_sections.hpp"

namespace sim {
namespace {

/// Without a device that does nothing is undetected, nor accepted as sent.
bool has_sender(const Dataset& data) { return DatasetCells(data, "n_frames").sum() > 0; }

std::string size_of(const Dataset& data) {
  const std::string hours = fmt::format("{:.3g}", DatasetCells(data, "line_h").sum());
  const double accepted = DatasetCells(data, "n_frames_false").sum();
  return fmt::format(
      "{} listened to{}; {:.0f} message{} accepted though the device itself "
      "sent none{}.\n",
      hours == "1" ? "1 hour of line was" : hours + " hours of line were",
      data.axes.empty() ? "" : fmt::format(" at {} points", measured_points(data).size()), accepted,
      accepted == 1 ? " was" : "s were",
      has_sender(data) ? fmt::format(", and {:.0f} though it sent another",
                                     DatasetCells(data, "n_frames_undetected").sum())
                       : "");
}

/// How often what should not be accepted was.
std::string rates_of(const Dataset& data) {
  return (has_sender(data)
              ? extremes(data, "undetected_per_hour", "The rate of undetected errors", " an hour")
              : "") +
         extremes(data, "false_per_hour", "The rate of false accepts", " an hour");
}

std::vector<CountedKind> line_kinds(bool of_sender) {
  std::vector<CountedKind> kinds;
  if (of_sender)
    kinds = {{"n_frames_ok", "accepted as sent"},
             {"n_frames_undetected", "accepted though the device sent another"}};
  kinds.push_back({"n_frames_false", "accepted though the device sent none"});
  kinds.push_back({"n_rejected", "refused"});
  return kinds;
}

std::vector<std::string> table_columns(bool of_sender) {
  std::vector<std::string> names{"line_h"};
  if (of_sender)
    names.insert(names.end(),
                 {"n_frames", "n_frames_ok", "n_frames_undetected", "undetected_per_hour"});
  names.insert(names.end(), {"n_frames_false", "false_per_hour", "n_rejected", "n_characters"});
  return names;
}

}  // namespace

ReportSection false_accept_section(const std::string& name, const StoredDataset& stored) {
  const Dataset& data = stored.data;
  ReportSection report{name, data.title, size_of(data) + rates_of(data) + missing_points(stored)};
  const auto add_rate = [&](const char* rate) {
    add_chart(report, swept_chart(data, drawn_column(false_accept_columns(), rate)));
  };
  add_rate("false_per_hour");
  if (has_sender(data)) add_rate("undetected_per_hour");
  report.sections.push_back(shares_section(
      "lines",
      point_shares(data, "What became of the lines that ended",
                   "lines by what the decoder made of them", line_kinds(has_sender(data)))));
  add_closing(
      report, data,
      headed_columns(data, false_accept_columns().facts(), table_columns(has_sender(data))));
  return report;
}

}  // namespace sim
