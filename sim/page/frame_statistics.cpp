#include "sim/page/frame_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "channel/instruction_set.hpp"
#include "protocol/uart.hpp"
#include "sim/trace/traced_message.hpp"
#include "sim/trial/heard_trials.hpp"

namespace sim {
namespace {

/// How much later than `at` the edge to that level is that is nearest to `at`, in seconds.
std::optional<double> delay_of(const dsp::LogicTrace& pin, double at_s, bool level, double most_s) {
  const auto edges = pin.edges();
  const auto from = std::ranges::lower_bound(edges, at_s - most_s, {}, &dsp::Seconds::value);
  std::optional<double> nearest;
  for (auto edge = from; edge != edges.end() && edge->value < at_s + most_s; ++edge) {
    const double delay = edge->value - at_s;
    if (pin.level_at(*edge) == level && (!nearest || std::abs(delay) < std::abs(*nearest)))
      nearest = delay;
  }
  return nearest;
}

/// Trials without their taps, which would take long and much memory.
std::vector<TracedTrial> wires_of(const Link& link, HeardTrials heard) {
  std::vector<TracedTrial> trials(heard.pins.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    trials[i].tx = std::move(heard.sent[i].line);
    trials[i].rx = std::move(heard.pins[i]);
    trials[i].baud = link.device_baud;
    trials[i].delay = link.delay;
  }
  return trials;
}

void add_trial(FrameStatistics& frames, const Link& link, const TracedTrial& trial) {
  const TracedMessage message = message_of(trial);
  frames.character_s = message.character_s;
  if (!link.ideal) add_delays(frames.delays, trial);  // ideal ones decide at a bit's end
  add_wrong_bits(frames.wrong, trial);
  if (!frames.first_misread && message.first_wrong())
    frames.first_misread = static_cast<std::uint32_t>(frames.trials);
  ++frames.trials;
}

}  // namespace

std::uint64_t affordable_trials(const Link& link, double most_samples) {
  constexpr double fewest = 20, most = 1e6;
  const double samples = mean_length(link).value * link.chain.sample_rate.value;
  return static_cast<std::uint64_t>(
      std::clamp(most_samples / std::max(samples, 1.0), fewest, most));
}

FrameStatistics look_at_frames(const Scenario& scenario, const TrialRange& counted,
                               const Workers& workers) {
  const Link link = make_link(scenario);
  constexpr std::uint64_t most = 400;
  constexpr double most_samples = 1e9;
  const std::uint64_t all = counted.last - counted.first;
  const auto trials =
      static_cast<std::uint32_t>(std::min({all, most, affordable_trials(link, most_samples)}));
  FrameStatistics frames{.are_all = trials == all};
  if (trials == 0) return frames;
  const auto begin = static_cast<std::uint32_t>(counted.first);
  ParallelRuns<std::vector<TracedTrial>> parallel(
      {.runs = trials,
       .most_at_once = static_cast<std::uint32_t>(channel::trials_at_once()),
       .workers = workers},
      [&](std::uint32_t first, int n, const std::atomic<bool>* over) {
        return wires_of(link, hear_trials(link, begin + first, n, over));
      });
  for (const std::vector<TracedTrial>& batch : parallel())
    for (const TracedTrial& trial : batch) add_trial(frames, link, trial);
  if (frames.first_misread) *frames.first_misread += begin;
  return frames;
}

void add_delays(EdgeDelays& delays, const TracedTrial& trial) {
  const TracedMessage message = message_of(trial);
  if (message.sent.empty()) return;
  const double half_bit_s = message.character_s / protocol::bits_per_byte / 2;
  for (const dsp::Seconds edge : trial.tx.edges()) {
    if (edge.value < message.start_s(0) - half_bit_s || edge.value > message.end_s()) continue;
    const bool level = trial.tx.level_at(edge);
    const double expected_s = edge.value + trial.delay.value;
    if (const auto late = delay_of(trial.rx, expected_s, level, half_bit_s))
      (level ? delays.rising_us : delays.falling_us).push_back((trial.delay.value + *late) * 1e6);
    else
      ++delays.missing;
  }
}

void add_wrong_bits(WrongBits& wrong, const TracedTrial& trial) {
  const TracedMessage message = message_of(trial);
  if (wrong.counts.empty()) {
    wrong.counts.resize(message.sent.size());
    wrong.shares.resize(message.sent.size());
  }
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
    std::uint64_t of_character = 0;
    for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
      if (is_wrong_at_pin(trial, message, i, slot)) {
        ++burst;
        ++of_character;
        ++wrong.counts[i][static_cast<std::size_t>(slot)];
      } else {
        end_burst();
      }
    }
    wrong.shares[i].add(of_character, protocol::bits_per_byte);
  }
  end_burst();
}

}  // namespace sim
