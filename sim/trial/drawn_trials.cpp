#include "sim/trial/drawn_trials.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sim {

DrawnTrials draw_trials(const Link& link, std::uint32_t first, int n) {
  std::vector<Transmission> sent;
  for (int i = 0; i < n; ++i) sent.push_back(transmit(link, first + static_cast<std::uint32_t>(i)));
  return draw_trials(link, first, std::move(sent));
}

DrawnTrials draw_trials(const Link& link, std::uint32_t first, std::vector<Transmission> sent) {
  DrawnTrials drawn{.sent = std::move(sent), .units = {}, .inputs = {}};
  const auto trial = [&](std::size_t i) { return first + static_cast<std::uint32_t>(i); };
  for (std::size_t i = 0; i < drawn.sent.size(); ++i)
    drawn.units.push_back(draw_unit(link, trial(i)));
  for (std::size_t i = 0; i < drawn.sent.size(); ++i)
    drawn.inputs.push_back(chain_input(link, trial(i), drawn.sent[i], drawn.units[i]));
  return drawn;
}

std::vector<dsp::LogicTrace> pins_of(const Link& link, const std::vector<const Transmission*>& sent,
                                     const std::vector<channel::ChainInput>& inputs,
                                     const std::atomic<bool>* stop, channel::StageClock* clock) {
  constexpr auto best = channel::InstructionSet::best;
  if (!link.ideal) return channel::propagate(link.chain, inputs, stop, best, clock);
  std::vector<channel::BitSlots> slots;
  for (const Transmission* trial : sent) slots.push_back(bit_slots(link, *trial));
  return channel::detect(link.chain, *link.ideal, inputs, slots, stop, best, clock);
}

std::vector<TrialSpan> groups_of(std::size_t trials) {
  constexpr std::size_t size = channel::lanes_per_group;
  std::vector<TrialSpan> groups;
  for (std::size_t first = 0; first < trials; first += size)
    groups.push_back({first, std::min(size, trials - first)});
  return groups;
}

std::vector<const Transmission*> pointers(const std::vector<Transmission>& sent) {
  std::vector<const Transmission*> all;
  for (const Transmission& trial : sent) all.push_back(&trial);
  return all;
}

void add_cost(GroupResult& result, const Link& link, const Transmission& sent) {
  const double duration = sent.line.end().value;
  result.simulated_s += duration;
  if (link.envelope) return;
  result.n_samples +=
      static_cast<std::uint64_t>(std::ceil(duration * link.chain.sample_rate.value));
}

}  // namespace sim
