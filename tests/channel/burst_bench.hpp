#pragma once
// The data sheets' measuring bench: bursts of a carrier at a receiver module, pulses at its output.
#include <cmath>
#include <vector>

#include "channel/chain.hpp"

namespace channel {

struct BurstTrain {
  double carrier_hz = 56e3;
  double burst_s = 30 / 56e3;  // Vishay's "optical test signal", Fig. 1: 30 cycles every 10 ms
  double period_s = 10e-3;
  int bursts = 20;
};

struct Bench {
  ModuleData module;  // a TSOP4856 by default
  double ambient_w_per_m2 = 0;
  double noise_scale = 0;
  double sample_rate_hz = 600e3;  // the scenarios' default
};

inline dsp::LogicTrace drive_of(const BurstTrain& train) {
  dsp::LogicTrace drive(true);
  for (int i = 0; i < train.bursts; ++i) {
    // Not whole samples apart: bursts meet every phase of the sample grid.
    const double start = 2e-3 + i * (train.period_s + 0.37e-6);
    drive.flip_at(dsp::Seconds(start));
    drive.flip_at(dsp::Seconds(start + train.burst_s));
  }
  drive.observe_until(dsp::Seconds(2e-3 + train.bursts * train.period_s + 2e-3));
  return drive;
}

inline ChainDesign design_of(const Bench& bench, const BurstTrain& train, double e_mw_per_m2) {
  const LightSettings light{.signal = dsp::WattsPerSquareMetre(e_mw_per_m2 * 1e-3),
                            .ambient = dsp::WattsPerSquareMetre(bench.ambient_w_per_m2),
                            .carrier = dsp::Hertz(train.carrier_hz),
                            .noise_scale = bench.noise_scale};
  return design_chain(bench.module, light, dsp::Hertz(bench.sample_rate_hz));
}

/// The module's pin in `n` trials (up to eight) of other noise and carrier phase.
inline std::vector<dsp::LogicTrace> outputs_of(const Bench& bench, const BurstTrain& train,
                                               double e_mw_per_m2, std::uint32_t n) {
  const dsp::LogicTrace drive = drive_of(train);
  std::vector<ChainInput> inputs;
  for (std::uint32_t seed = 1; seed <= n; ++seed)
    inputs.push_back({&drive, seed * 0x9E3779B9u, {seed, seed + 1, seed + 2, seed + 3}});
  return propagate(design_of(bench, train, e_mw_per_m2), inputs);
}

inline dsp::LogicTrace output_of(const Bench& bench, const BurstTrain& train, double e_mw_per_m2) {
  return outputs_of(bench, train, e_mw_per_m2, 1).front();
}

/// Output pulses (pin low) as {start, end} in seconds.
struct Pulse {
  double start, end;
  double width() const { return end - start; }
};

inline std::vector<Pulse> pulses_of(const dsp::LogicTrace& pin) {
  std::vector<Pulse> pulses;
  const auto flips = pin.flips();
  for (std::size_t i = 0; i + 1 < flips.size(); i += 2)
    pulses.push_back({flips[i].value, flips[i + 1].value});
  return pulses;
}

/// Mean output pulse less burst, in carrier cycles, over a train; a burst without one counts as 0.
inline double mean_stretch_cycles(const Bench& bench, const BurstTrain& train, double e) {
  double total = 0;
  for (const Pulse& pulse : pulses_of(output_of(bench, train, e))) total += pulse.width();
  return (total / train.bursts - train.burst_s) * train.carrier_hz;
}

/// Emin as the data sheet defines it: the irradiance at which the pulse is as much shorter as the
/// part's window allows. Bisection on a logarithmic scale, mW/m2.
inline double measured_emin(const Bench& bench, const BurstTrain& train) {
  double low = 1e-3, high = 1e3;
  while (high / low > 1.002) {
    const double middle = std::sqrt(low * high);
    const bool enough = mean_stretch_cycles(bench, train, middle) >= bench.module.emin_width_cycles;
    (enough ? high : low) = middle;
  }
  return high;
}

}  // namespace channel
