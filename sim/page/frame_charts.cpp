#include "sim/page/frame_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "sim/counting/sample_quantile.hpp"
#include "sim/section/picture_sections.hpp"

namespace sim {
namespace {

/// Half of what the middle 68 % span: the standard deviation of what is normal.
double spread(const std::vector<double>& values) {
  return (sample_quantile(values, 0.8413) - sample_quantile(values, 0.1587)) / 2;
}

/// What is further out than that from the median is counted where the histogram ends.
constexpr long most_steps = 40;

/// A frequency polygon: how many are in each step, at its middle.
ChartCurve histogram(const std::string& name, const std::vector<double>& delays_us,
                     double step_us) {
  ChartCurve curve{.name = name, .points = {}, .kind = CurveKind::continuous};
  if (delays_us.empty()) return curve;
  std::map<long, int> counts;
  const long middle = std::lround(std::floor(sample_quantile(delays_us, 0.5) / step_us));
  for (const double delay : delays_us)
    ++counts[std::clamp(std::lround(std::floor(delay / step_us)), middle - most_steps,
                        middle + most_steps)];
  for (long bin = counts.begin()->first - 1; bin <= counts.rbegin()->first + 1; ++bin) {
    const auto found = counts.find(bin);
    const double count = found == counts.end() ? 0 : found->second;
    curve.points.push_back({(static_cast<double>(bin) + 0.5) * step_us, count, count, count});
  }
  return curve;
}

/// Of as many microseconds that there are some tens of them, but for those far out.
double step_for(const EdgeDelays& delays) {
  std::vector<double> all = delays.falling_us;
  all.insert(all.end(), delays.rising_us.begin(), delays.rising_us.end());
  if (all.empty()) return 1;
  std::ranges::sort(all);
  constexpr double steps = 40;
  const std::size_t far_out = all.size() / 50;
  return std::max(1.0, std::ceil((all[all.size() - 1 - far_out] - all[far_out]) / steps));
}

/// With its 95 % interval; bits of a character fail together. Where none did nothing is known of
/// that, and trials count, not bits.
Estimate share_of_bits(const ClusterSums& sums) {
  constexpr double level = 0.95;
  if (sums.part > 0) return clustered_ratio(sums, level);
  const Interval none = clopper_pearson(0, static_cast<double>(sums.n), level);
  return {0, none.low, none.high};
}

/// "all 400 trials that were counted", "the first 400 trials".
std::string trials_text(const FrameStatistics& frames) {
  return frames.are_all ? fmt::format("all {} trials that were counted", frames.trials)
                        : fmt::format("the first {} trials", frames.trials);
}

Chart burst_chart(const FrameStatistics& frames) {
  ChartCurve curve{.name = "bursts", .points = {}, .kind = CurveKind::bars};
  const std::vector<int>& bursts = frames.wrong.bursts;
  for (std::size_t n = 0; n < bursts.size(); ++n) {
    const double count = bursts[n];
    curve.points.push_back({static_cast<double>(n + 1), count, count, count});
  }
  return {.title = "Bursts of wrong bits",
          .description = fmt::format("How often so many wrong bits followed each other in {}",
                                     trials_text(frames)),
          .x = {.label = "wrong bits in a row", .is_count = true},
          .y = {.label = "bursts", .is_count = true, .from_zero = true},
          .curves = {curve}};
}

}  // namespace

HeatMap wrong_bits_map(const FrameStatistics& frames) {
  HeatMap map{.title = "Wrong bits",
              .description = fmt::format("share of {} in which a bit is wrong at the pin, by its "
                                         "character, from the first above, and its place in it",
                                         trials_text(frames)),
              .x_label = "bit, in the order of sending",
              .y_label = "character",
              .columns = {"start", "0", "1", "2", "3", "4", "5", "6", "7", "stop"},
              .rows = {},
              .values = {},
              .has_contour = false};
  for (std::size_t i = frames.wrong.characters.size(); i-- > 0;) {
    map.rows.push_back(fmt::format("{}: {}", i + 1, frames.wrong.characters[i]));
    std::vector<double>& shares = map.values.emplace_back();
    for (const int count : frames.wrong.counts[i])
      shares.push_back(static_cast<double>(count) / std::max(1, frames.trials));
  }
  return map;
}

Chart settling_chart(const FrameStatistics& frames) {
  ChartCurve curve{.name = "wrong bits", .points = {}, .kind = CurveKind::bars};
  for (std::size_t i = 0; i < frames.wrong.shares.size(); ++i) {
    const Estimate share = share_of_bits(frames.wrong.shares[i]);
    curve.points.push_back({(static_cast<double>(i) + 0.5) * frames.character_s * 1e3, share.value,
                            share.low, share.high});
  }
  return {.title = "Wrong bits since the message began",
          .description = fmt::format("Share of the bits of a character that are wrong, at its "
                                     "middle, with its 95 % interval, of {}: what settles in a "
                                     "message shows here",
                                     trials_text(frames)),
          .x = {"time since the message began [ms]", false},
          .y = {.label = "share of wrong bits", .from_zero = true},
          .curves = {curve}};
}

PageSection bursts_section(const FrameStatistics& frames) {
  Chart chart = burst_chart(frames);
  if (frames.wrong.bursts.size() > 1) return chart_section(std::move(chart));
  return {.heading = chart.title,
          .text = fmt::format("In {} no wrong bit followed another.", trials_text(frames))};
}

std::string delays_text(const FrameStatistics& frames) {
  const EdgeDelays& delays = frames.delays;
  const double begins = sample_quantile(delays.falling_us, 0.5),
               ends = sample_quantile(delays.rising_us, 0.5);
  std::string text = fmt::format(
      "Median delay: {:.0f} us where light begins and {:.0f} us where it ends, so pulses of light "
      "are {:.0f} us {} at the pin (pulse-width distortion). Jitter: {:.0f} and {:.0f} us (half of "
      "the middle 68 %).",
      begins, ends, std::abs(ends - begins), ends < begins ? "shorter" : "longer",
      spread(delays.falling_us), spread(delays.rising_us));
  if (delays.missing > 0)
    text += fmt::format(
        " Of {} edges of the light {} are missing at the pin, or more than half a bit from where "
        "they belong.",
        delays.falling_us.size() + delays.rising_us.size() + delays.missing, delays.missing);
  return text;
}

Chart jitter_chart(const FrameStatistics& frames) {
  const double step_us = step_for(frames.delays);
  return {.title = "Delay of edges",
          .description =
              fmt::format("Histogram of how much later than the light's the edges of the pin "
                          "are, in steps of {:g} us, of {}; what is far out is counted at the "
                          "ends",
                          step_us, trials_text(frames)),
          .x = {"delay [us]", false},
          .y = {.label = "edges", .is_count = true, .from_zero = true},
          .curves = {histogram("falling: light begins", frames.delays.falling_us, step_us),
                     histogram("rising: light ends", frames.delays.rising_us, step_us)}};
}

}  // namespace sim
