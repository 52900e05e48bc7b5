#include "sim/page/numbers_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/columns/estimate_text.hpp"
#include "sim/columns/text_table.hpp"
#include "sim/columns/validity_column.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link_experiment/link_notes.hpp"
#include "sim/result/point_loss.hpp"
#include "sim/section/swept_curves.hpp"

namespace sim {
namespace {

bool has_theory(const LinkResult& result) {
  return std::ranges::any_of(result.points, [](const LinkPoint& point) {
    return !std::isnan(point.operating.ber_theory);
  });
}

std::vector<std::string> head_of(const LinkResult& result, bool theory) {
  std::vector<std::string> head;
  for (const Axis& axis : result.axes) head.push_back(axis_name(axis));
  for (const char* name :
       {"irradiance [mW/m2]", "SNR [dB]", "frames", "lost", "FLR", "bit errors", "BER"})
    head.emplace_back(name);
  if (theory) head.emplace_back("BER in theory");
  head.emplace_back("undetected");
  head.emplace_back("stopped by");
  return head;
}

std::vector<std::string> row_of(const LinkResult& result, const LinkPoint& point, bool theory) {
  std::vector<std::string> row = coordinate_texts(result.axes, point.coordinates);
  row.push_back(irradiance_text(point.operating.irradiance_mw_per_m2));
  row.push_back(decibel_text(point.operating.snr_db));
  row.push_back(std::to_string(point.tally.n_frames));
  row.push_back(std::to_string(point.tally.n_frames_lost));
  row.push_back(estimate_text(frame_loss_of(point, LinkResult::ci_level)));
  row.push_back(std::to_string(point.tally.n_bit_errors));
  row.push_back(estimate_text(bit_error_ratio(point.tally, LinkResult::ci_level)));
  if (theory) row.push_back(theory_text(point.operating.ber_theory));
  row.push_back(std::to_string(point.tally.n_frames_undetected));
  row.push_back(closing_text(point));
  return row;
}

PageTable table_of(const LinkResult& result) {
  const bool theory = has_theory(result);
  PageTable table{.head = head_of(result, theory), .rows = {}};
  for (const LinkPoint& point : result.points)
    if (point.reached()) table.rows.push_back(row_of(result, point, theory));
  return table;
}

}  // namespace

PageSection numbers_section(const LinkResult& result) {
  return {.heading = "All numbers", .text = mark_notes(result), .table = table_of(result)};
}

std::string marked_points(const LinkResult& result) {
  const auto outside = std::ranges::count_if(
      result.points, [](const LinkPoint& point) { return point.validity_flags != 0; });
  const auto alarming = std::ranges::count_if(
      result.points, [](const LinkPoint& point) { return point.alarms != 0; });
  std::vector<std::string> marks;
  if (outside > 0) marks.push_back(fmt::format("{} {}", outside, validity_words));
  if (alarming > 0) marks.push_back(fmt::format("{} with an alarm", alarming));
  return marked_line(result.points.size(), marks);
}

}  // namespace sim
