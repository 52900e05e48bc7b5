#include "sim/trace/trace.hpp"

#include <cmath>
#include <utility>

#include "protocol/short_pulses.hpp"
#include "sim/link/link.hpp"
#include "sim/trial/decision_trial.hpp"
#include "sim/trial/envelope_trial.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

using channel::Recording;

constexpr Tap all_taps[] = {
    {"irradiance_mw_per_m2", "mW m-2", "effective irradiance at the module, noise included",
     &Recording::irradiance},
    {"band_pass_mw_per_m2", "mW m-2", "output of the band-pass, referred to irradiance",
     &Recording::band_pass},
    {"threshold_mw_per_m2", "mW m-2", "threshold of the comparator, referred to irradiance",
     &Recording::threshold},
    {"integrator_samples", "1", "integrator behind the comparator, in samples",
     &Recording::integrator},
    {"agc_gain", "1", "factor by which the slow AGC has raised the fixed threshold",
     &Recording::agc_gain}};

/// The module's pin, or a matched receiver's; fills the taps of a waveform.
dsp::LogicTrace pin_of(const Link& link, std::uint32_t trial, const Transmission& sent,
                       Recording& taps) {
  const auto unit = draw_unit(link, trial);
  const channel::ChainInput input = chain_input(link, trial, sent, unit);
  if (link.envelope) return envelope_pin(link, trial, sent);
  if (!link.ideal) return channel::propagate_alone(link.chain, input, &taps);
  return channel::detect_alone(link.chain, *link.ideal, input, bit_slots(link, sent), &taps);
}

}  // namespace

std::span<const Tap> analogue_taps() { return all_taps; }

bool tells_something(const TracedTrial& trial, std::vector<float> Recording::*samples) {
  if (samples == &Recording::agc_gain && !trial.has_slow_agc) return false;
  return !(trial.taps.*samples).empty() && !std::isnan((trial.taps.*samples).front());
}

TracedTrial trace_trial(const Scenario& scenario, std::uint32_t trial) {
  const Link link = make_link(scenario);
  Transmission sent = transmit(link, trial);
  TracedTrial traced;
  traced.sample_rate = link.chain.sample_rate;
  traced.carrier = carrier_of(link);
  traced.baud = link.device_baud;
  traced.delay = link.delay;
  traced.has_slow_agc = link.module.agc_attack_db_per_ms > 0;
  traced.has_pulses = link.pulse > dsp::Seconds(0);
  traced.has_monostable = link.has_monostable;
  traced.rx =
      link.decisions ? decided_pin(link, trial, sent) : pin_of(link, trial, sent, traced.taps);
  traced.tx = std::move(sent.line);
  return traced;
}

dsp::LogicTrace sent_line(const TracedTrial& trial) {
  return trial.has_pulses ? protocol::whole_bits(trial.tx, trial.baud) : trial.tx;
}

dsp::LogicTrace read_line(const TracedTrial& trial) {
  return trial.has_monostable ? protocol::whole_bits(trial.rx, trial.baud) : trial.rx;
}

std::vector<double> sample_times_s(const TracedTrial& trial) {
  std::vector<double> times(trial.taps.irradiance.size());
  for (std::size_t i = 0; i < times.size(); ++i)
    times[i] = static_cast<double>(i + 1) / trial.sample_rate.value;
  return times;
}

std::vector<std::uint8_t> levels_at(const dsp::LogicTrace& wire, std::span<const double> times_s) {
  std::vector<std::uint8_t> levels;
  levels.reserve(times_s.size());
  dsp::TraceReader reader(wire);
  for (const double time : times_s) levels.push_back(reader.level_at(dsp::Seconds(time)));
  return levels;
}

}  // namespace sim
