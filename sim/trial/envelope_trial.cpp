#include "sim/trial/envelope_trial.hpp"

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

/// Dark that a pause has for sure once the pin is idle. A stretch is as long as the longest
/// message; the next may come behind the shortest.
double least_dark(const Link& link, const channel::EnvelopeChain& chain) {
  return dsp::cycles(link.interval_min - most_jitter(link), chain.carrier) - chain.unit.ending -
         2 * channel::envelope_block;
}

double lead_in_steps(const channel::EnvelopeChain& chain) {
  return dsp::cycles(lead_in, chain.carrier) - 1;
}

/// Of so much dark as much as the gain needs to settle.
double settled_before(const channel::EnvelopeChain& chain, double dark) {
  return std::floor(std::min(chain.unit.settling, dark));
}

/// Of the stretch of a message with so much dark before it.
double stretch_steps(const Link& link, const channel::EnvelopeChain& chain, double before) {
  return before + dsp::cycles(longest_message(link), chain.carrier) + chain.unit.ending;
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

double longest_stretch(const Link& link, const channel::EnvelopeChain& chain) {
  const double dark = least_dark(link, chain);
  if (dark < 0) return dsp::cycles(longest_length(link), chain.carrier) + 1;
  return stretch_steps(
      link, chain,
      std::max(settled_before(chain, lead_in_steps(chain)), settled_before(chain, dark)));
}

EnvelopeLink make_envelope_link(const Link& link, const channel::LightSettings& light) {
  EnvelopeLink envelope{.chain = channel::design_envelope(link.module, light, link.chain)};
  const channel::EnvelopeChain& chain = envelope.chain;
  const double dark = least_dark(link, chain);
  if (dark < 0) return envelope;
  for (int i = 0; i <= link.warmup_messages; ++i) {
    const double before = settled_before(chain, i == 0 ? lead_in_steps(chain) : dark);
    envelope.stretches.push_back({dsp::Seconds(before / chain.carrier.value),
                                  whole_blocks(stretch_steps(link, chain, before))});
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
