#include "sim/listening/listening_part.hpp"

#include <fmt/format.h>

#include <utility>

#include "sim/page/dataset_cells.hpp"
#include "sim/page/dataset_shares.hpp"
#include "sim/page/dataset_words.hpp"
#include "sim/page/experiment_part.hpp"
#include "sim/page/picture_sections.hpp"

namespace sim {
namespace {

std::string size_of(const Dataset& data) {
  const std::string hours = fmt::format("{:.3g}", DatasetCells(data, "line_h").sum());
  const double accepted = DatasetCells(data, "n_frames_false").sum();
  return fmt::format(
      "{} listened to{}; {:.0f} message{} accepted though the device sent none, and {:.0f} though "
      "it sent another.\n",
      hours == "1" ? "1 hour of line was" : hours + " hours of line were",
      data.axes.empty() ? "" : fmt::format(" at {} points", measured_points(data).size()), accepted,
      accepted == 1 ? " was" : "s were", DatasetCells(data, "n_frames_undetected").sum());
}

/// How often what should not be accepted was. Without a device no error is undetected.
std::string rates_of(const Dataset& data) {
  const bool sends = DatasetCells(data, "n_frames").sum() > 0;
  return (sends ? extremes(data, "undetected_per_hour", "The rate of undetected errors", " an hour")
                : "") +
         extremes(data, "false_per_hour", "The rate of false accepts", " an hour");
}

std::vector<CountedKind> line_kinds() {
  return {{"n_frames_ok", "accepted as sent"},
          {"n_frames_undetected", "accepted though the device sent another"},
          {"n_frames_false", "accepted though the device sent none"},
          {"n_rejected", "refused"}};
}

std::vector<DatasetColumn> columns() {
  return {{"line_h", "line [h]"},
          {"n_frames", "messages sent"},
          {"n_frames_ok", "accepted as sent"},
          {"n_frames_undetected", "undetected errors"},
          {"undetected_per_hour", "undetected errors an hour"},
          {"n_frames_false", "false accepts"},
          {"false_per_hour", "false accepts an hour"},
          {"n_rejected", "lines refused"},
          {"n_characters", "characters read"}};
}

}  // namespace

ReportPart listening_part(const std::string& name, const StoredDataset& stored) {
  const Dataset& data = stored.data;
  ReportPart part{name, data.title, size_of(data) + rates_of(data) + missing_points(stored)};
  for (const auto& [variable, title] :
       {std::pair{"false_per_hour", "False accepts"}, {"undetected_per_hour", "Undetected errors"}})
    add_chart(part, swept_chart(data, {.name = variable,
                                       .title = title,
                                       .label = std::string(title) + " an hour of line",
                                       .logarithmic = true}));
  part.sections.push_back(shares_section(
      "lines", point_shares(data, "What became of the lines that ended",
                            "lines by what the decoder made of them", line_kinds())));
  add_closing(part, data, columns());
  return part;
}

}  // namespace sim
