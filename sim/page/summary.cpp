#include "sim/page/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sim/columns/estimate_text.hpp"
#include "sim/columns/unit_spread_text.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link_experiment/answer_text.hpp"
#include "sim/link_experiment/link_notes.hpp"
#include "sim/result/place_text.hpp"
#include "sim/result/point_loss.hpp"
#include "sim/result/ranking.hpp"
#include "sim/result/unit_spread.hpp"
#include "sim/text/letters.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

/// Each line as a sentence.
std::string sentences(const std::string& lines) {
  std::string text;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) text += capitalised(line) + (line.ends_with('.') ? "\n" : ".\n");
  return text;
}

/// Of several points together the ratio means nothing.
std::string size_of(const LinkResult& result) {
  Tally all;
  for (const LinkPoint& point : result.points) all += point.tally;
  const auto points = std::ranges::count_if(result.points, &LinkPoint::reached);
  std::string more;
  if (is_weighted(result))
    more = ", as drawn by importance sampling";
  else if (points == 1)
    more = ": frame loss ratio " +
           estimate_text(frame_loss_of(*std::ranges::find_if(result.points, &LinkPoint::reached),
                                       LinkResult::ci_level));
  return fmt::format("{} frames were simulated{}; {} of them were lost{}.\n", all.n_frames,
                     points > 1 ? fmt::format(" at {} points", points) : "", all.n_frames_lost,
                     more);
}

/// "1.5 [0.3, 4.3] %"
std::string loss_in_percent(const Estimate& loss) {
  return estimate_text({100 * loss.value, 100 * loss.low, 100 * loss.high}) + " %";
}

/// Theory is known of matched receivers alone, which have no band-pass.
std::string noise_note(const OperatingPoint& at) {
  if (!std::isfinite(at.snr_db)) return "";
  return fmt::format(
      "; noise is {:.0f} dB {} the signal {}", std::abs(at.snr_db),
      at.snr_db < 0 ? "above" : "below",
      std::isfinite(at.ber_theory) ? "in the bandwidth of a bit" : "behind the band-pass");
}

std::string where_it_fails(const LinkResult& result) {
  const LinkPoint* point = failing_point(result);
  if (point == nullptr) return "";
  const std::string place = place_text(result.axes, point->coordinates);
  return capitalised(fmt::format(
      "{}{}{} of frames are lost{}.\n",
      rank(result).rows.size() > 1 ? "one point is looked at closer: " : "",
      place.empty() ? "" : "at " + place + ", ",
      loss_in_percent(frame_loss_of(*point, LinkResult::ci_level)), noise_note(point->operating)));
}

/// ", 3 without noise".
std::string counts_with(const std::vector<Ablation>& limits) {
  std::string text;
  for (const Ablation& o : limits) text += fmt::format(", {} {}", o.tally.n_frames_lost, o.change);
  return text;
}

/// How much farther the link would go.
std::string halves_with(const Ablations& ablations, const std::vector<Ablation>& limits) {
  if (!ablations.along) return "";
  const auto text = [&](const Ablation& o) {
    return with_unit(half_loss_text(*o.half), ablations.along->unit);
  };
  std::string words = fmt::format("Half of the frames are lost at about {} = {} as it is",
                                  ablations.along->key, text(ablations.ablations.front()));
  for (const Ablation& o : limits)
    if (o.half) words += fmt::format(", {} {}", text(o), o.change);
  return words + ".\n";
}

std::string what_limits(const Ablations& ablations) {
  if (ablations.ablations.size() < 2) return "";
  const Tally& whole = ablations.ablations.front().tally;
  const std::vector<Ablation> limits = limits_of(ablations);
  if (!limits.empty())
    return fmt::format("What limits it there: of {} frames sent again {} are lost{}.\n",
                       whole.n_frames, whole.n_frames_lost, counts_with(limits)) +
           halves_with(ablations, limits);
  std::vector<std::string> all;
  for (const Ablation& o : ablations.ablations)
    if (!o.change.empty()) all.push_back(o.change);
  return fmt::format(
      "What limits it there: nothing alone. Run again {}, it does not clearly lose less: it is "
      "several together, or light too weak for what the receiver needs.\n",
      fmt::join(all, ", or "));
}

/// Curves would end without a word.
std::string without_estimate(const LinkResult& result) {
  const auto unknown = std::ranges::count_if(result.points, [&](const LinkPoint& point) {
    return point.reached() && std::isnan(bit_error_ratio(point.tally, LinkResult::ci_level).value);
  });
  if (unknown == 0) return "";
  return fmt::format("{} of {} points have no estimate and are missing in the curves.\n", unknown,
                     std::ranges::count_if(result.points, &LinkPoint::reached));
}

}  // namespace

std::string answer_of(const LinkResult& result, const Ranking& ranking) {
  std::string answer = sentences(missing_lines(result));
  if (const auto units = unit_spread(result))
    answer += sentences(range_lines(*units));
  else if (ranking.rows.size() <= 1)
    answer += sentences(ranking_lines(result, ranking));
  else
    answer += answer_sentence(result, ranking);
  return answer;
}

std::string summary_of(const LinkResult& result, const Ablations& ablations) {
  return size_of(result) + without_estimate(result) + where_it_fails(result) +
         what_limits(ablations);
}

}  // namespace sim
