#include "sim/trial/decision_trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

#include "sim/threads/stopwatch.hpp"

namespace sim {
namespace {

/// What one lane of some decisions takes its bits for.
struct Heard {
  const channel::DecisionDesign& bits;
  const channel::WrongBits& wrong;
  std::size_t lane;

  bool light(std::size_t i) const { return (((wrong[i] ^ bits.sent[i]) >> lane) & 1) != 0; }
};

dsp::LogicTrace pin_of(const Link& link, const Transmission& sent, const Heard& heard) {
  const channel::BitSlots slots = bit_slots(link, sent);
  channel::SlotPin pin(slots, link.delay);
  for (std::size_t i = 0; i < slots.size(); ++i) pin.decide(heard.light(i));
  return pin.take(sent.line.end());
}

Tally decode(const Link& link, std::uint32_t trial, const Heard& heard) {
  const Transmission sent = transmit(link, trial);
  return count(link, sent, receive(link, trial, pin_of(link, sent, heard)));
}

/// Bit i: trial i must be decoded.
unsigned to_be_decoded(const DecisionLink& decisions, const channel::WrongBits& wrong) {
  if (!decisions.clean) return ~0u;
  return std::accumulate(wrong.begin(), wrong.end(), 0u, std::bit_or<>());
}

GroupResult count_decisions(const Link& link, std::uint32_t first, std::size_t n,
                            const channel::WrongBits& wrong) {
  const DecisionLink& decisions = *link.decisions;
  const unsigned decoded = to_be_decoded(decisions, wrong);
  GroupResult result;
  for (std::size_t i = 0; i < n; ++i)
    result.tally += ((decoded >> i) & 1) != 0 ? decode(link, first + static_cast<std::uint32_t>(i),
                                                       {decisions.bits, wrong, i})
                                              : *decisions.clean;
  result.simulated_s = static_cast<double>(n) * decisions.trial.value;
  return result;
}

/// The largest mismatch of clocks at which either UART reads right bits right, with much to spare:
/// over the 10 bits of a character 2 % add up to a fifth of a bit.
constexpr double harmless_mismatch = 0.02;

bool clocks_agree(const Link& link) {
  return std::abs(link.device_baud / link.receiver_baud - 1) <= harmless_mismatch;
}

std::vector<bool> levels_of(const Link& link) {
  std::vector<bool> levels;
  for (int i = 0; i <= link.warmup_messages; ++i)
    std::ranges::copy(protocol::line_bits(link.bytes), std::back_inserter(levels));
  return levels;
}

}  // namespace

DecisionLink make_decision_link(const Link& link, const channel::CorrelatorOutput& output) {
  DecisionLink decisions{.bits = channel::design_decisions(*link.ideal, output, levels_of(link)),
                         .trial = mean_length(link)};
  const channel::WrongBits none(decisions.bits.sent.size());
  if (clocks_agree(link)) decisions.clean = decode(link, 0, {decisions.bits, none, 0});
  return decisions;
}

GroupResult decide_group(const Link& link, std::uint32_t first, int n, bool profiled) {
  Stopwatch watch(profiled);
  std::array<channel::NoiseSeed, channel::lanes_per_group> seeds;
  const auto trials = std::span(seeds).first(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < trials.size(); ++i)
    trials[i] = noise_seed(link, first + static_cast<std::uint32_t>(i));
  const double messages_s = watch.lap();
  const channel::WrongBits wrong = channel::decide(link.decisions->bits, trials);
  const double decisions_s = watch.lap();
  GroupResult result = count_decisions(link, first, trials.size(), wrong);
  result.profile = {
      .messages_s = messages_s, .decisions_s = decisions_s, .decoding_s = watch.seconds()};
  return result;
}

dsp::LogicTrace decided_pin(const Link& link, std::uint32_t trial, const Transmission& sent) {
  const channel::DecisionDesign& bits = link.decisions->bits;
  return pin_of(link, sent, {bits, channel::decide_alone(bits, noise_seed(link, trial)), 0});
}

}  // namespace sim
