#include "sim/trial/heard_trials.hpp"

#include <utility>

#include "sim/threads/stopwatch.hpp"
#include "sim/trial/decision_trial.hpp"
#include "sim/trial/drawn_trials.hpp"
#include "sim/trial/envelope_trial.hpp"

namespace sim {
namespace {

std::vector<Transmission> transmit_all(const Link& link, std::uint32_t first, int n) {
  std::vector<Transmission> sent;
  for (int i = 0; i < n; ++i) sent.push_back(transmit(link, first + static_cast<std::uint32_t>(i)));
  return sent;
}

HeardTrials hear_waveforms(const Link& link, std::uint32_t first, int n,
                           const std::atomic<bool>* stop, bool profiled) {
  const Stopwatch watch;
  DrawnTrials trials = draw_trials(link, first, n);
  const double messages_s = watch.seconds();
  channel::StageClock clock;
  std::vector<dsp::LogicTrace> pins =
      pins_of(link, pointers(trials.sent), trials.inputs, stop, profiled ? &clock : nullptr);
  return {std::move(trials.sent),
          std::move(pins),
          {.messages_s = messages_s, .chain_s = clock.seconds()}};
}

HeardTrials hear_envelopes(const Link& link, std::uint32_t first, int n,
                           const std::atomic<bool>* stop) {
  Stopwatch watch;
  std::vector<Transmission> sent = transmit_all(link, first, n);
  const double messages_s = watch.lap();
  std::vector<dsp::LogicTrace> pins = envelope_pins(link, first, sent, stop);
  return {
      std::move(sent), std::move(pins), {.messages_s = messages_s, .envelope_s = watch.seconds()}};
}

HeardTrials hear_decisions(const Link& link, std::uint32_t first, int n) {
  HeardTrials heard{.sent = transmit_all(link, first, n), .pins = {}, .profile = {}};
  for (const Transmission& sent : heard.sent)
    heard.pins.push_back(
        decided_pin(link, first + static_cast<std::uint32_t>(heard.pins.size()), sent));
  return heard;
}

}  // namespace

HeardTrials hear_trials(const Link& link, std::uint32_t first, int n, const std::atomic<bool>* stop,
                        bool profiled) {
  if (link.decisions) return hear_decisions(link, first, n);
  if (link.envelope) return hear_envelopes(link, first, n, stop);
  return hear_waveforms(link, first, n, stop, profiled);
}

}  // namespace sim
