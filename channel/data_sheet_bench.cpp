#include "channel/data_sheet_bench.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace channel {
namespace {

constexpr double lead_s = 2e-3;  // of darkness before and after a train

ChainInput input_of(const dsp::LogicTrace& drive, std::uint32_t seed) {
  ChainInput input{};
  input.drive = &drive;
  input.carrier_phase = seed * 0x9E3779B9u;
  input.noise_seed = {seed, seed + 1, seed + 2, seed + 3};
  return input;
}

/// Amplitude of the taps at a frequency between two instants.
double amplitude_at(const std::vector<float>& tap, double cycles_a_sample, std::size_t from,
                    std::size_t to) {
  double in_phase = 0, quadrature = 0;
  for (std::size_t i = from; i < to; ++i) {
    const double angle = 2 * std::numbers::pi * cycles_a_sample * static_cast<double>(i);
    in_phase += static_cast<double>(tap[i]) * std::cos(angle);
    quadrature += static_cast<double>(tap[i]) * std::sin(angle);
  }
  return 2 * std::hypot(in_phase, quadrature) / static_cast<double>(to - from);
}

/// Whether the pin is low when the middle of each burst comes out, of those in the second half of
/// a train that begins after `from_s`.
bool reports_all(const ModuleData& module, const BurstTrain& train, const dsp::LogicTrace& pin,
                 double from_s) {
  const double middle = train.burst_s / 2 + nominal_delay(module).value;
  for (int i = train.bursts / 2; i < train.bursts; ++i)
    if (pin.level_at(dsp::Seconds(from_s + burst_start(train, i) + middle))) return false;
  return true;
}

/// The longest short burst, in seconds.
double long_burst_s(const ModuleData& module) {
  return design_slow_agc(module, dsp::Hertz(1)).long_burst;
}

/// A carrier in front of a train, in seconds, so long that the slow AGC lets go of it: from there a
/// train that it tolerates comes back, and of another no burst is heard again. From the dark the
/// gain takes seconds to fall where a train is little more than it tolerates. None before short
/// bursts for a part that holds its gain: it would not come back to them either.
double carrier_before(const ModuleData& module, double burst_s, double e_mw_per_m2) {
  if (module.agc_attack_db_per_ms == 0) return 0;
  if (module.agc_hold_ms > 0 && burst_s <= long_burst_s(module)) return 0;
  constexpr double longest_s = 2, further_db = 6;
  const double fall_db = 20 * std::log10(e_mw_per_m2 / module.emin_mw_per_m2) + further_db;
  return std::clamp(fall_db / module.agc_attack_db_per_ms * 1e-3, 2 * lead_s, longest_s);
}

/// The train behind a carrier of so many seconds.
dsp::LogicTrace drive_after(double carrier_s, const BurstTrain& train) {
  if (carrier_s == 0) return drive_of(train);
  const dsp::LogicTrace bursts = drive_of(train);
  dsp::LogicTrace drive(true);
  drive.add_edge(dsp::Seconds(lead_s));
  drive.add_edge(dsp::Seconds(carrier_s));
  for (const dsp::Seconds edge : bursts.edges()) drive.add_edge(dsp::Seconds(carrier_s) + edge);
  drive.observe_until(dsp::Seconds(carrier_s + 2 * lead_s + train.bursts * train.period_s));
  return drive;
}

/// As long as a gain control takes to settle: while it can fall by 600 dB, 2 to 12 s.
BurstTrain settling_train(const Bench& bench, double burst_s, double period_s) {
  constexpr double fall_db = 600;
  const double attack_db_per_s = 1e3 * bench.module.agc_attack_db_per_ms;
  const double seconds = attack_db_per_s > 0 ? std::clamp(fall_db / attack_db_per_s, 2., 12.) : 2;
  return {.carrier_hz = bench.module.centre_hz,
          .burst_s = burst_s,
          .period_s = period_s,
          .bursts = static_cast<int>(seconds / period_s)};
}

/// Of eight periods in increasing order, whether each is long enough.
std::vector<bool> long_enough(const Bench& bench, const std::vector<double>& periods,
                              double burst_s, double e_mw_per_m2) {
  const double carrier_s = carrier_before(bench.module, burst_s, e_mw_per_m2);
  std::vector<BurstTrain> trains;
  std::vector<dsp::LogicTrace> drives;
  for (const double period : periods) trains.push_back(settling_train(bench, burst_s, period));
  for (const BurstTrain& train : trains) drives.push_back(drive_after(carrier_s, train));
  std::vector<ChainInput> inputs;
  for (const dsp::LogicTrace& drive : drives) inputs.push_back(input_of(drive, 1));
  const auto pins = propagate(design_of(bench, trains.front(), e_mw_per_m2), inputs);
  std::vector<bool> enough;
  for (std::size_t i = 0; i < pins.size(); ++i)
    enough.push_back(reports_all(bench.module, trains[i], pins[i], carrier_s));
  return enough;
}

/// `n` values between two, evenly on a logarithmic scale, the upper one included.
std::vector<double> steps_up_to(double from, double to, int n) {
  std::vector<double> all;
  for (int i = 1; i <= n; ++i)
    all.push_back(from * std::pow(to / from, i / static_cast<double>(n)));
  return all;
}

}  // namespace

BurstTrain test_signal(double centre_hz, int bursts) {
  return {.carrier_hz = centre_hz, .burst_s = 30 / centre_hz, .period_s = 10e-3, .bursts = bursts};
}

double burst_start(const BurstTrain& train, int i) {
  return lead_s + i * (train.period_s + 0.37e-6);
}

dsp::LogicTrace drive_of(const BurstTrain& train) {
  dsp::LogicTrace drive(true);
  for (int i = 0; i < train.bursts; ++i) {
    drive.add_edge(dsp::Seconds(burst_start(train, i)));
    drive.add_edge(dsp::Seconds(burst_start(train, i) + train.burst_s));
  }
  drive.observe_until(dsp::Seconds(lead_s + train.bursts * train.period_s + lead_s));
  return drive;
}

ChainDesign design_of(const Bench& bench, const BurstTrain& train, double e_mw_per_m2) {
  const LightSettings light{.signal = dsp::WattsPerSquareMetre(e_mw_per_m2 * 1e-3),
                            .ambient = dsp::WattsPerSquareMetre(bench.ambient_w_per_m2),
                            .carrier = dsp::Hertz(train.carrier_hz),
                            .noise_scale = bench.noise_scale};
  return design_chain(bench.module, light, dsp::Hertz(bench.sample_rate_hz));
}

std::vector<dsp::LogicTrace> outputs_of(const Bench& bench, const BurstTrain& train,
                                        double e_mw_per_m2, std::uint32_t n) {
  const dsp::LogicTrace drive = drive_of(train);
  std::vector<ChainInput> inputs;
  for (std::uint32_t seed = 1; seed <= n; ++seed) inputs.push_back(input_of(drive, seed));
  return propagate(design_of(bench, train, e_mw_per_m2), inputs);
}

dsp::LogicTrace output_of(const Bench& bench, const BurstTrain& train, double e_mw_per_m2) {
  return outputs_of(bench, train, e_mw_per_m2, 1).front();
}

std::vector<Pulse> pulses_of(const dsp::LogicTrace& pin) {
  std::vector<Pulse> pulses;
  const auto edges = pin.edges();
  for (std::size_t i = 0; i + 1 < edges.size(); i += 2)
    pulses.push_back({edges[i].value, edges[i + 1].value});
  return pulses;
}

double mean_stretch_cycles(const Bench& bench, const BurstTrain& train, double e_mw_per_m2) {
  double total = 0;
  for (const dsp::LogicTrace& pin : outputs_of(bench, train, e_mw_per_m2, bench.trials))
    for (const Pulse& pulse : pulses_of(pin)) total += pulse.width();
  return (total / train.bursts / bench.trials - train.burst_s) * train.carrier_hz;
}

double measured_emin(const Bench& bench, const BurstTrain& train) {
  double low = 1e-4, high = 1e5;
  const auto enough = [&](double e) {
    return mean_stretch_cycles(bench, train, e) >= bench.module.emin_width_cycles;
  };
  if (enough(low) || !enough(high)) return std::numeric_limits<double>::quiet_NaN();
  while (high / low > 1.002) {
    const double middle = std::sqrt(low * high);
    (enough(middle) ? high : low) = middle;
  }
  return high;
}

OnOffTimes on_off_times(const Bench& bench, const BurstTrain& train, double e_mw_per_m2) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto pulses = pulses_of(output_of(bench, train, e_mw_per_m2));
  if (pulses.size() < 2) return {unknown, unknown};
  OnOffTimes sum{0, 0};
  for (std::size_t i = 0; i + 1 < pulses.size(); ++i) {
    sum.on += pulses[i].width();
    sum.off += pulses[i + 1].start - pulses[i].end;
  }
  const auto n = static_cast<double>(pulses.size() - 1);
  return {sum.on / n, sum.off / n};
}

double carrier_gain(const Bench& bench, double carrier_hz) {
  const BurstTrain steady{
      .carrier_hz = carrier_hz, .burst_s = 60e-3, .period_s = 60e-3, .bursts = 1};
  const dsp::LogicTrace drive = drive_of(steady);
  Recording taps;
  propagate_alone(design_of(bench, steady, 1), input_of(drive, 0), &taps);
  const auto at = [&](double s) { return static_cast<std::size_t>(s * bench.sample_rate_hz); };
  constexpr double fundamental = 2 / std::numbers::pi;
  return amplitude_at(taps.band_pass, carrier_hz / bench.sample_rate_hz, at(10e-3), at(50e-3)) /
         fundamental;
}

double shortest_period(const Bench& bench, double burst_s, double e_mw_per_m2, double from_s,
                       double to_s) {
  constexpr double precise = 1.003;
  while (to_s / from_s > precise) {
    const auto periods = steps_up_to(from_s, to_s, lanes_per_group);
    const auto enough = long_enough(bench, periods, burst_s, e_mw_per_m2);
    const auto first = std::ranges::find(enough, true);
    if (first == enough.end()) return 0;
    const auto i = static_cast<std::size_t>(first - enough.begin());
    to_s = periods[i];
    from_s = i > 0 ? periods[i - 1] : from_s;
  }
  return to_s;
}

}  // namespace channel
