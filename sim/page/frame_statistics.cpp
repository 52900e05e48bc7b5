#include "sim/page/frame_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "channel/instruction_set.hpp"
#include "protocol/uart.hpp"
#include "sim/link/link.hpp"
#include "sim/trace/traced_message.hpp"
#include "sim/trial/heard_trials.hpp"

namespace sim {
namespace {

/// How much later than `at` the nearest flip to that level is, in seconds.
std::optional<double> delay_of(const dsp::LogicTrace& pin, double at_s, bool level, double most_s) {
  const auto flips = pin.flips();
  const auto from = std::ranges::lower_bound(flips, at_s - most_s, {}, &dsp::Seconds::value);
  std::optional<double> nearest;
  for (auto flip = from; flip != flips.end() && flip->value < at_s + most_s; ++flip) {
    const double delay = flip->value - at_s;
    if (pin.level_at(*flip) == level && (!nearest || std::abs(delay) < std::abs(*nearest)))
      nearest = delay;
  }
  return nearest;
}

/// A frequency polygon: how many are in each step, at its middle.
ChartCurve histogram(const std::string& name, const std::vector<double>& delays_us,
                     double step_us) {
  std::map<long, int> counts;
  for (const double delay : delays_us) ++counts[std::lround(std::floor(delay / step_us))];
  ChartCurve curve{.name = name, .points = {}, .kind = CurveKind::continuous};
  if (counts.empty()) return curve;
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

/// "all 400 trials that were counted", "the first 400 trials".
std::string trials_text(const FrameStatistics& frames) {
  return frames.are_all ? fmt::format("all {} trials that were counted", frames.trials)
                        : fmt::format("the first {} trials", frames.trials);
}

std::uint32_t trials_to_look_at(const Link& link, std::uint64_t counted) {
  constexpr std::uint64_t most = 400, fewest = 20;
  constexpr double most_samples = 1e9;
  const double samples = transmit(link, 0).messages.back().end.value * link.chain.sample_rate.value;
  const auto affordable = static_cast<std::uint64_t>(most_samples / std::max(samples, 1.0));
  return static_cast<std::uint32_t>(std::min(counted, std::clamp(affordable, fewest, most)));
}

/// Trials without their taps, which would take long and much memory.
std::vector<TracedTrial> wires_of(const Link& link, HeardTrials heard) {
  std::vector<TracedTrial> trials(heard.pins.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    trials[i].tx = std::move(heard.sent[i].line);
    trials[i].rx = std::move(heard.pins[i]);
    trials[i].baud = link.device_baud;
  }
  return trials;
}

void add_trial(FrameStatistics& frames, const Link& link, const TracedTrial& trial) {
  const TracedMessage message = message_of(trial);
  frames.character_s = message.character_s;
  add_delays(frames.delays, trial);
  add_wrong_bits(frames.wrong, trial, link.delay);
  if (!frames.first_misread && message.first_wrong())
    frames.first_misread = static_cast<std::uint32_t>(frames.trials);
  ++frames.trials;
}

}  // namespace

FrameStatistics look_at_frames(const Scenario& scenario, std::uint64_t counted,
                               const Workers& workers) {
  const Link link = make_link(scenario);
  const std::uint32_t trials = trials_to_look_at(link, counted);
  FrameStatistics frames{.are_all = trials == counted};
  if (trials == 0) return frames;
  RunSharing<std::vector<TracedTrial>> sharing(
      {.runs = trials,
       .most_at_once = static_cast<std::uint32_t>(channel::trials_at_once()),
       .workers = workers},
      [&](std::uint32_t first, int n) {
        return wires_of(link, hear_trials(link, first, n, workers.interrupt));
      });
  for (const std::vector<TracedTrial>& lot : sharing())
    for (const TracedTrial& trial : lot) add_trial(frames, link, trial);
  return frames;
}

void add_delays(EdgeDelays& delays, const TracedTrial& trial) {
  const TracedMessage message = message_of(trial);
  if (message.sent.empty()) return;
  const double half_bit_s = message.character_s / protocol::bits_per_byte / 2;
  for (const dsp::Seconds flip : trial.tx.flips()) {
    if (flip.value < message.start_s(0) - half_bit_s || flip.value > message.end_s()) continue;
    const bool level = trial.tx.level_at(flip);
    if (const auto delay = delay_of(trial.rx, flip.value, level, half_bit_s))
      (level ? delays.rising_us : delays.falling_us).push_back(*delay * 1e6);
  }
}

void add_wrong_bits(WrongBits& wrong, const TracedTrial& trial, dsp::Seconds delay) {
  const TracedMessage message = message_of(trial);
  const double bit_s = message.character_s / protocol::bits_per_byte;
  if (wrong.counts.empty()) wrong.counts.resize(message.sent.size());
  wrong.characters.clear();
  std::size_t burst = 0;
  const auto end_burst = [&] {
    if (burst == 0) return;
    if (wrong.bursts.size() < burst) wrong.bursts.resize(burst);
    ++wrong.bursts[burst - 1];
    burst = 0;
  };
  for (std::size_t i = 0; i < std::min(message.sent.size(), wrong.counts.size()); ++i) {
    wrong.characters.push_back(shown(message.sent[i]));
    for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
      const double middle_s = message.start_s(i) + (slot + 0.5) * bit_s + delay.value;
      if (trial.rx.level_at(dsp::Seconds(middle_s)) ==
          protocol::line_bit(message.sent[i].value, slot)) {
        end_burst();
      } else {
        ++burst;
        ++wrong.counts[i][static_cast<std::size_t>(slot)];
      }
    }
  }
  end_burst();
}

HeatMap wrong_bits_map(const FrameStatistics& frames) {
  HeatMap map{.title = "Wrong bits",
              .description = fmt::format("share of {} in which a bit is wrong at the pin, by its "
                                         "character, from the first above, and its place in it",
                                         trials_text(frames)),
              .x_label = "bit, in the order of sending",
              .y_label = "character",
              .columns = {"start", "0", "1", "2", "3", "4", "5", "6", "7", "stop"},
              .rows = {},
              .values = {}};
  for (std::size_t i = frames.wrong.characters.size(); i-- > 0;) {
    map.rows.push_back(fmt::format("{}: {}", i + 1, frames.wrong.characters[i]));
    std::vector<double>& shares = map.values.emplace_back();
    for (const int count : frames.wrong.counts[i])
      shares.push_back(static_cast<double>(count) / std::max(1, frames.trials));
  }
  return map;
}

Chart settling_chart(const FrameStatistics& frames) {
  ChartCurve curve{.name = "wrong bits", .points = {}, .kind = CurveKind::continuous};
  for (std::size_t i = 0; i < frames.wrong.counts.size(); ++i) {
    const auto& counts = frames.wrong.counts[i];
    const double share = std::accumulate(counts.begin(), counts.end(), 0.0) /
                         static_cast<double>(counts.size()) / std::max(1, frames.trials);
    curve.points.push_back(
        {(static_cast<double>(i) + 0.5) * frames.character_s * 1e3, share, share, share});
  }
  return {.title = "Wrong bits since the message began",
          .description = fmt::format("Share of the bits of a character that are wrong, at its "
                                     "middle, of {}: what settles in a message shows here",
                                     trials_text(frames)),
          .x = {"time since the message began [ms]", false},
          .y = {"share of wrong bits", false},
          .curves = {curve}};
}

Chart burst_chart(const FrameStatistics& frames) {
  ChartCurve curve{.name = "bursts", .points = {}, .kind = CurveKind::continuous};
  const std::vector<int>& bursts = frames.wrong.bursts;
  for (std::size_t n = 0; n <= bursts.size() + 1; ++n) {  // from nothing to nothing
    const double count = n == 0 || n > bursts.size() ? 0 : bursts[n - 1];
    curve.points.push_back({static_cast<double>(n), count, count, count});
  }
  return {.title = "Bursts of wrong bits",
          .description = fmt::format("How often so many wrong bits followed each other in {}",
                                     trials_text(frames)),
          .x = {"wrong bits in a row", false},
          .y = {"bursts", false},
          .curves = {curve}};
}

Chart jitter_chart(const FrameStatistics& frames) {
  const double step_us = step_for(frames.delays);
  return {.title = "Delay of edges",
          .description =
              fmt::format("Histogram of how much later than the light's the edges of the pin "
                          "are, in steps of {:g} us, of {}",
                          step_us, trials_text(frames)),
          .x = {"delay [us]", false},
          .y = {"edges", false},
          .curves = {histogram("falling: light begins", frames.delays.falling_us, step_us),
                     histogram("rising: light ends", frames.delays.rising_us, step_us)}};
}

}  // namespace sim
