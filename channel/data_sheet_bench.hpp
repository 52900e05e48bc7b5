#pragma once
// The data sheets' measuring bench: bursts of a carrier at a receiver module, pulses at its output,
// and what the sheets' typical curves plot of them. All of it runs the chain itself.
#include <cstdint>
#include <span>
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
  std::uint32_t trials = 1;       // up to eight, of other noise and carrier phase
};

/// The test signal of Fig. 1 at a part's own centre frequency.
BurstTrain test_signal(double centre_hz, int bursts = 20);

/// Start of a train's burst in seconds. Bursts are not whole samples apart: they meet every phase
/// of the sample grid.
double burst_start(const BurstTrain& train, int i);

/// The wire that drives the LED.
dsp::LogicTrace drive_of(const BurstTrain& train);

ChainDesign design_of(const Bench& bench, const BurstTrain& train, double e_mw_per_m2);

/// The module's pin in `n` trials (up to eight) of other noise and carrier phase.
std::vector<dsp::LogicTrace> outputs_of(const Bench& bench, const BurstTrain& train,
                                        double e_mw_per_m2, std::uint32_t n);
dsp::LogicTrace output_of(const Bench& bench, const BurstTrain& train, double e_mw_per_m2);

/// Output pulses (pin low) as {start, end} in seconds.
struct Pulse {
  double start, end;
  double width() const { return end - start; }
};
std::vector<Pulse> pulses_of(const dsp::LogicTrace& pin);

/// Mean output pulse less burst, in carrier cycles, over a train and all trials; a burst without
/// one counts as 0 wide. Vishay 82459 Fig. 2.
double mean_stretch_cycles(const Bench& bench, const BurstTrain& train, double e_mw_per_m2);

/// Emin as the data sheet defines it: the irradiance at which the pulse is as much shorter as the
/// part's window allows. Bisection on a logarithmic scale, mW/m2; NaN where there is none from
/// 1e-4 to 1e5. Vishay 82459 Fig. 6, 7, 9, 12.
double measured_emin(const Bench& bench, const BurstTrain& train);

/// Mean low and high time of the pin for a train, in seconds; NaN without two pulses. Vishay 82459
/// Fig. 4.
struct OnOffTimes {
  double on, off;
};
OnOffTimes on_off_times(const Bench& bench, const BurstTrain& train, double e_mw_per_m2);

/// Amplitude behind the band-pass that a steady carrier makes, relative to an on/off wave at f0.
/// Vishay 82459 Fig. 5.
double carrier_gain(const Bench& bench, double carrier_hz);

/// Of trains of bursts `burst_s` long, the shortest period, found between the two given, at which
/// the pin reports every burst once the slow AGC has settled, from a carrier that it let go of; 0
/// if it does not at any. Vishay 82459 and 82836 Fig. 8. A burst is reported if the pin is low when
/// its middle comes out: neighbours may merge.
double shortest_period(const Bench& bench, double burst_s, double e_mw_per_m2, double from_s,
                       double to_s);

}  // namespace channel
