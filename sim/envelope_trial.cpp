#include "sim/envelope_trial.hpp"

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

std::int32_t whole_blocks(double steps) {
  constexpr double block = channel::envelope_block;
  return static_cast<std::int32_t>(std::ceil(steps / block) * block);
}

/// By how much jitter can make a message longer: the first byte's moves all of it.
dsp::Seconds most_jitter(const Link& link) {
  return static_cast<double>(link.bytes.size() - 1) * link.start_jitter;
}

/// Longest time from the start of a message's first byte to its end.
dsp::Seconds longest_message(const Link& link) {
  const auto bits = static_cast<double>(link.bytes.size() * protocol::bits_per_byte);
  return bits * dsp::period(link.device_baud) + most_jitter(link);
}

/// How the trials of a group are computed.
struct Inputs {
  std::vector<channel::EnvelopeInput> trials;
  std::vector<std::int32_t> steps;
};

std::vector<dsp::Seconds> begins_of(const EnvelopeLink& envelope, const Transmission& sent) {
  if (envelope.stretches.empty()) return {dsp::Seconds(0)};
  std::vector<dsp::Seconds> begins;
  for (std::size_t i = 0; i < sent.messages.size(); ++i)
    begins.push_back(sent.messages[i].byte_start.front() - envelope.stretches[i].before);
  return begins;
}

std::vector<std::int32_t> steps_of(const EnvelopeLink& envelope,
                                   std::span<const Transmission> sent) {
  std::vector<std::int32_t> steps;
  for (const EnvelopeLink::Stretch& stretch : envelope.stretches) steps.push_back(stretch.steps);
  if (!steps.empty()) return steps;
  dsp::Seconds longest;
  for (const Transmission& trial : sent) longest = std::max(longest, trial.line.end());
  return {whole_blocks(dsp::cycles(longest, envelope.chain.carrier) + 1)};
}

Inputs inputs_of(const Link& link, std::uint32_t first, std::span<const Transmission> sent) {
  Inputs inputs{.trials = {}, .steps = steps_of(*link.envelope, sent)};
  for (const Transmission& trial : sent) {
    const auto number = first + static_cast<std::uint32_t>(inputs.trials.size());
    inputs.trials.push_back({.drive = &trial.line,
                             .carrier_phase = carrier_phase(link, number),
                             .noise_seed = noise_seed(link, number),
                             .begins = begins_of(*link.envelope, trial)});
  }
  return inputs;
}

}  // namespace

EnvelopeLink make_envelope_link(const Link& link, const channel::LightSettings& light) {
  EnvelopeLink envelope{.chain = channel::design_envelope(link.module, light, link.chain)};
  const channel::EnvelopeUnit& unit = envelope.chain.unit;
  const dsp::Hertz rate = light.carrier;
  // A stretch is as long as the longest message; the next may come behind the shortest.
  const double dark = dsp::cycles(link.interval_min - most_jitter(link), rate) - unit.ending -
                      2 * channel::envelope_block;
  if (dark < 0) return envelope;
  const double light_steps = dsp::cycles(longest_message(link), rate) + unit.ending;
  for (int i = 0; i <= link.warmup_messages; ++i) {
    const double quiet = i == 0 ? dsp::cycles(lead_in, rate) - 1 : dark;
    const double before = std::floor(std::min(unit.settling, quiet));
    envelope.stretches.push_back(
        {before / rate.value * dsp::Seconds(1), whole_blocks(before + light_steps)});
  }
  return envelope;
}

std::vector<dsp::LogicTrace> envelope_pins(const Link& link, std::uint32_t first,
                                           std::span<const Transmission> sent,
                                           const std::atomic<bool>* stop) {
  const Inputs inputs = inputs_of(link, first, sent);
  return channel::propagate_envelopes(link.envelope->chain, inputs.trials, inputs.steps, stop);
}

dsp::LogicTrace envelope_pin(const Link& link, std::uint32_t trial, const Transmission& sent) {
  const Inputs inputs = inputs_of(link, trial, {&sent, 1});
  return channel::propagate_envelope(link.envelope->chain, inputs.trials.front(), inputs.steps);
}

}  // namespace sim
