#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/check/decoder_comparison.hpp"
#include "sim/columns/text_table.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/text/json_answer.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

/// How often the first of two won, and the second, and how often neither.
struct Score {
  std::size_t first = 0, second = 0, open = 0;
};

Score score_of(const DecoderComparisonReport& report, std::size_t first, std::size_t second) {
  Score score;
  for (const DecoderComparisonPoint& point : report.points)
    for (const PairComparison& pair : point.pairs) {
      if (pair.first != first || pair.second != second) continue;
      ++(!pair.decided ? score.open : pair.first_wins() ? score.first : score.second);
    }
  return score;
}

/// Those that no other beats at the point.
std::string unbeaten(const DecoderComparisonReport& report, const DecoderComparisonPoint& point) {
  std::vector<std::string> names;
  for (std::size_t d = 0; d < report.decoders.size(); ++d) {
    const bool beaten = std::ranges::any_of(point.pairs, [&](const PairComparison& pair) {
      return pair.decided && (pair.first_wins() ? pair.second : pair.first) == d;
    });
    if (!beaten && !point.faults[d]) names.push_back(report.decoders[d]->name());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string lost_text(const DecoderComparisonPoint& point, std::size_t decoder) {
  const FrameCounts& counts = point.counts[decoder];
  if (point.faults[decoder]) return "failed";
  const std::string wrong =
      counts.undetected_error == 0 ? "" : fmt::format(" ({} wrong)", counts.undetected_error);
  return fmt::format("{:.2f} %{}", 100 * ratio(counts.lost, counts.frames), wrong);
}

std::vector<TextColumn> comparison_columns(const DecoderComparisonReport& report) {
  std::size_t width = 5;
  for (const DecoderComparisonPoint& point : report.points)
    width = std::max(width, point.point.name.size());
  std::vector<TextColumn> columns{{{"", "", "point"}, -static_cast<int>(width)}};
  for (const Decoder* decoder : report.decoders)
    columns.push_back(
        {{"", "lost by", decoder->name()}, std::max(18, static_cast<int>(decoder->name().size()))});
  columns.push_back({{"", "beaten by", "none"}, -12});
  return columns;
}

std::string all_faults(const DecoderComparisonReport& report) {
  std::string text;
  for (const DecoderComparisonPoint& point : report.points)
    for (std::size_t d = 0; d < report.decoders.size(); ++d)
      if (const auto& fault = point.faults[d])
        text += fault_line(report.decoders[d]->name(), point.point.name, *fault);
  return text;
}

Json comparison_point_json(const DecoderComparisonReport& report,
                           const DecoderComparisonPoint& point) {
  Json decoders = Json::array(), pairs = Json::array();
  for (std::size_t d = 0; d < report.decoders.size(); ++d) {
    const FrameCounts& counts = point.counts[d];
    const auto& fault = point.faults[d];
    decoders.push_back({{"decoder", report.decoders[d]->name()},
                        {"n_frames", counts.frames},
                        {"n_frames_lost", counts.lost},
                        {"n_frames_undetected", counts.undetected_error},
                        {"fault", fault ? Json(fault->what) : Json(nullptr)}});
  }
  for (const PairComparison& pair : point.pairs)
    pairs.push_back({{"first", report.decoders[pair.first]->name()},
                     {"second", report.decoders[pair.second]->name()},
                     {"lost_by_both", pair.losses.both},
                     {"lost_by_first_alone", pair.losses.candidate_only},
                     {"lost_by_second_alone", pair.losses.baseline_only},
                     {"p_value", pair.p_value},
                     {"different", pair.decided}});
  return {{"name", point.point.name}, {"decoders", decoders}, {"duels", pairs}};
}

}  // namespace

std::string decoder_comparison_text(const DecoderComparisonReport& report) {
  const std::vector<TextColumn> columns = comparison_columns(report);
  std::string text = table_head(columns);
  for (const DecoderComparisonPoint& point : report.points) {
    std::vector<std::string> row{point.point.name};
    for (std::size_t d = 0; d < report.decoders.size(); ++d) row.push_back(lost_text(point, d));
    row.push_back(unbeaten(report, point));
    text += table_line(columns, row);
  }
  text += all_faults(report);
  for (std::size_t second = 1; second < report.decoders.size(); ++second)
    for (std::size_t first = 0; first < second; ++first) {
      const Score score = score_of(report, first, second);
      text += fmt::format("{} loses less than {} at {} points, more at {}; at {} it is open\n",
                          report.decoders[first]->name(), report.decoders[second]->name(),
                          score.first, score.second, score.open);
    }
  return text + fmt::format(
                    "were two alike, they would be told apart in one comparison of {:.0f} at "
                    "most\n",
                    1 / report.alpha);
}

std::string decoder_comparison_json(const DecoderComparisonReport& report) {
  Json points = Json::array();
  for (const DecoderComparisonPoint& point : report.points)
    points.push_back(comparison_point_json(report, point));
  const Json json{{"alpha", report.alpha}, {"points", std::move(points)}};
  return json_line(json);
}

}  // namespace sim
