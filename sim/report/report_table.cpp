#include "sim/report/report_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "sim/columns/estimate_text.hpp"
#include "sim/columns/text_table.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link/validity.hpp"
#include "sim/result/alarms.hpp"
#include "sim/result/point_loss.hpp"
#include "sim/scenario/flags.hpp"
#include "sim/text/rounded_text.hpp"

namespace sim {
namespace {

std::vector<TextColumn> columns_of(const std::vector<Axis>& axes, bool theory) {
  std::vector<TextColumn> columns = axis_columns(axes);
  columns.push_back({{"", "irradiance", "[mW/m2]"}, number_width});
  columns.push_back({{"", "SNR", "[dB]"}, 6});
  columns.push_back({{"", "", "frames"}, number_width});
  columns.push_back({{"", "bit", "errors"}, number_width});
  columns.push_back({{"", "bit error ratio", "[interval]"}, -estimate_width});
  if (theory) columns.push_back({{"", "in theory", ""}, number_width});
  columns.push_back({{"", "frame loss ratio", "[interval]"}, -estimate_width});
  columns.push_back({{"", "real", "time"}, 7});
  columns.push_back({{"", "", "stopped by"}, -1});
  return columns;
}

constexpr const char* alarm_sign = "!!";

/// How many errors more than theory the samples should make: of the points where bits failed, that
/// where it is most.
std::string theory_note(const ExperimentResult& result) {
  double most = 0;
  for (const PointResult& p : result.points) {
    const double more = p.operating.ber_sampled / p.operating.ber_theory - 1;
    const bool has_failed = bit_error_ratio(p.tally, result.ci_level).value > 0;
    if (has_failed && std::isfinite(more) && std::abs(more) > std::abs(most)) most = more;
  }
  if (std::abs(most) < 0.001) return "";
  return fmt::format(
      "in theory all bits are alike; sampled they are not, and make up to {:.1f} % {} errors\n",
      100 * std::abs(most), most > 0 ? "more" : "fewer");
}

std::string target_note(const ExperimentResult& result) {
  if (std::ranges::none_of(result.points, may_stop_by_target)) return "";
  return "frame loss ratios are median-unbiased and their intervals allow for a stop by "
         "target_flr; "
         "lost over frames is `flr` in the file\n";
}

template <class Flag>
std::string mark(std::span<const Flag> table, std::uint64_t mask, const char* sign) {
  return (mask == 0 ? "" : "  ") + raised_mark(table, mask, sign);
}

std::string real_time_factor(const PointResult& p) {
  const double factor = p.simulated_s / p.elapsed_s;
  if (!std::isfinite(factor)) return "-";
  if (factor >= 1e6) return scientific_text(factor, 2) + "x";
  return fmt::format("{:.{}f}x", factor, factor < 10 ? 1 : 0);
}

}  // namespace

std::string table_header(const std::vector<Axis>& axes, bool theory) {
  return table_head(columns_of(axes, theory));
}

std::string table_row(const std::vector<Axis>& axes, const PointResult& point, double ci_level,
                      bool theory) {
  const bool known = measured(point);
  std::vector<std::string> texts = coordinate_texts(axes, point.coordinates);
  texts.push_back(known ? irradiance_text(point.operating.irradiance_mw_per_m2) : "-");
  texts.push_back(known ? decibel_text(point.operating.snr_db) : "-");
  texts.push_back(std::to_string(point.tally.n_frames));
  texts.push_back(std::to_string(point.tally.n_bit_errors));
  texts.push_back(estimate_text(bit_error_ratio(point.tally, ci_level)));
  if (theory) texts.push_back(theory_text(point.operating.ber_theory));
  texts.push_back(estimate_text(frame_loss_of(point, ci_level)));
  texts.push_back(real_time_factor(point));
  texts.push_back(known ? closing_text(point) : "-");
  return table_line(columns_of(axes, theory), texts);
}

std::string irradiance_text(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.4g}", value);
}

std::string decibel_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.1f}", value) : "-";
}

std::string theory_text(double ber) {
  if (std::isnan(ber)) return "-";
  return ber < 0.01 ? scientific_text(ber, 3) : fmt::format("{:.4f}", ber);
}

std::string closing_text(const PointResult& point) {
  return stop_reason_name(point.stop) +
         mark(validity_limits(), point.validity_flags, validity_sign) +
         mark(alarms(), point.alarms, alarm_sign);
}

std::string mark_notes(const ExperimentResult& result) {
  std::uint64_t validity_flags = 0, alarming = 0;
  for (const PointResult& p : result.points) {
    validity_flags |= p.validity_flags;
    alarming |= p.alarms;
  }
  return raised_notes(validity_limits(), validity_flags, validity_sign) +
         raised_notes(alarms(), alarming, alarm_sign) + target_note(result) + theory_note(result);
}

namespace {

/// All points that are counted, or all that are weighted.
Tally sum_of(const ExperimentResult& result, bool weighted) {
  Tally all;
  for (const PointResult& p : result.points)
    if (p.tally.is_weighted() == weighted) all += p.tally;
  return all;
}

std::string weighted_note(const Tally& all) {
  if (all.n_frames == 0) return "";
  return fmt::format(
      "importance sampling: {} of {} frames lost as drawn; ratios are weighted to what comes by "
      "nature\n",
      all.n_frames_lost, all.n_frames);
}

std::string reasons_note(const Tally& all) {
  if (all.n_frames_lost == 0) return "";
  const std::pair<const char*, std::uint64_t> reasons[]{
      {"nothing heard", all.n_frames_unheard},
      {"no line ended", all.n_frames_unended},
      {"wrong checksum", all.n_rejected_checksum},
      {"unprintable characters", all.n_rejected_unprintable},
      {"no hexadecimal checksum", all.n_rejected_not_hex},
      {"too short", all.n_rejected_short},
      {"too long", all.n_rejected_overlong}};
  std::vector<std::string> known;
  for (const auto& [reason, count] : reasons)
    if (count > 0) known.push_back(fmt::format("{} {}", reason, count));
  return fmt::format("{} frames lost: {}{}\n", all.n_frames_lost, fmt::join(known, ", "),
                     known.size() > 1 ? " (a frame may have several reasons)" : "");
}

}  // namespace

std::string loss_reasons(const ExperimentResult& result) {
  return reasons_note(sum_of(result, false)) + weighted_note(sum_of(result, true));
}

std::string unfinished_note(const ExperimentResult& result) {
  const auto begun = std::ranges::count_if(result.points, measured);
  const auto finished = std::ranges::count_if(result.points, [](const PointResult& p) {
    return measured(p) && p.stop != StopReason::interrupted;
  });
  return unfinished_note(result.points.size(), static_cast<std::size_t>(finished),
                         static_cast<std::size_t>(begun));
}

std::string unfinished_note(std::size_t all, std::size_t finished, std::size_t begun) {
  if (finished == all) return "";
  return fmt::format("unfinished: {} of {} points{}; what follows is of what was counted\n",
                     all - finished, all,
                     begun < all ? fmt::format(", {} of them not begun", all - begun) : "");
}

}  // namespace sim
