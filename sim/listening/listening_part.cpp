#include <fmt/format.h>

#include "sim/listening/listening_report.hpp"
#include "sim/page/dataset_cells.hpp"
#include "sim/page/dataset_words.hpp"
#include "sim/page/experiment_part.hpp"
#include "sim/page/picture_sections.hpp"
#include "sim/report/swept_rows.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

std::string size_of(const Dataset& data) {
  return fmt::format(
      "{:.3g} hours of line were listened to{}; {:.0f} messages were accepted though none was "
      "sent, and {:.0f} while another was sent.\n",
      DatasetCells(data, "line_h").sum(),
      data.axes.empty() ? "" : fmt::format(" at {} points", measured_points(data).size()),
      DatasetCells(data, "n_frames_false").sum(), DatasetCells(data, "n_frames_undetected").sum());
}

struct LineKind {
  const char *name, *words;
};
constexpr LineKind kinds[] = {{"n_frames_ok", "accepted as sent"},
                              {"n_frames_undetected", "accepted while another was sent"},
                              {"n_frames_false", "accepted though none was sent"},
                              {"n_rejected", "refused"}};

ShareBars lines_of(const Dataset& data) {
  const SweptRows rows(data.axes);
  ShareBars bars{.title = "What became of the lines that ended",
                 .description = "Lines that the decoder read to their end, by what it made of them",
                 .rows_label = rows.head(),
                 .kinds = {},
                 .rows = {}};
  std::vector<DatasetCells> cells;
  for (const LineKind& kind : kinds) {
    bars.kinds.emplace_back(kind.words);
    cells.emplace_back(data, kind.name);
  }
  for (std::size_t i = 0; i < cells.front().size(); ++i) {
    std::vector<std::uint64_t> counts;
    for (const DatasetCells& c : cells) counts.push_back(static_cast<std::uint64_t>(c[i]));
    add_counts(bars, rows.label(point_coordinates(data.axes, i)), counts);
  }
  return bars;
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
  ReportPart part{name, data.title,
                  size_of(data) +
                      extremes(data, "false_per_hour", "The rate of false accepts", " an hour") +
                      missing_points(data)};
  for (const auto& [variable, title] :
       {std::pair{"false_per_hour", "False accepts"}, {"undetected_per_hour", "Undetected errors"}})
    add_chart(part, swept_chart(data, {.name = variable,
                                       .title = title,
                                       .label = "an hour of line",
                                       .logarithmic = true}));
  part.sections.push_back(shares_section("lines", lines_of(data)));
  add_closing(part, data, columns());
  return part;
}

}  // namespace sim
