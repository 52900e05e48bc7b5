#pragma once
// Disturbance: another light at the module, by what is known of lamps and senders, made into the
// sources of channel/interference.hpp. Irradiance is effective (at the module, as if at 950 nm).
//
// A lamp adds its wave without the mean; the mean of every source counts as ambient light, in shot
// noise and in the threshold. A keyed sender is the on/off wave itself, as the link's own signal.
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "channel/interference.hpp"
#include "channel/keyed_carrier.hpp"
#include "dsp/logic_trace.hpp"
#include "dsp/units.hpp"

namespace channel {

struct Disturbance {
  std::vector<ToneDesign> tones{};
  /// As PeriodicTable wants it, its period followed by a block; empty: none.
  std::vector<float> table{};
  std::optional<CarrierDesign> carrier{};
  /// Factor on the carrier's light at every gain_step samples, linear between, up to one knot
  /// behind the trial's last sample; empty: always 1.
  std::vector<float> gain{};
};

/// What is random of one disturbance in one trial.
struct DisturbanceInput {
  /// At time 0, in 2^-32 cycles: of the carrier or the table; of the tones.
  std::array<std::uint32_t, 2> phase{};
  dsp::LogicTrace drive{};  // keys the carrier; low = light
};

/// A lamp at the mains: mean * (1 + depth cos) at twice the mains' frequency. Depths of
/// incandescent lamps are assumed, about 0.05 to 0.1: no source with figures was found.
Disturbance design_ripple(dsp::WattsPerSquareMetre mean, dsp::Hertz mains, double depth,
                          dsp::Hertz sample_rate);

/// A fluorescent lamp at an electronic ballast: Moreira, Valadas & de Oliveira Duarte, "Optical
/// interference produced by artificial light", Wireless Networks 3 (1997), with the coefficients
/// and phases of Ghassemlooy, Popoola & Rajbhandari, "Optical Wireless Communications" (2012),
/// Program 3.4: 40 lines at multiples of the mains' frequency, and 12 (one, then the even ones) of
/// the ballast's. Measured at 50 Hz; at other mains the same lines are put in proportion.
struct FluorescentLight {
  dsp::WattsPerSquareMetre mean;
  dsp::Hertz mains{50};
  dsp::Hertz ballast{37500};
  /// The ballast's lines are printed in dB, without saying of what: 20 reads them as amplitudes, 10
  /// as powers, which the listing does. The line at twice the ballast's frequency is the same.
  double decibels_per_decade = 20;
  double ballast_share = 1;  // of the model's lines of the ballast that there are
};
Disturbance design_fluorescent(const FluorescentLight& lamp, dsp::Hertz sample_rate);

/// A part of that lamp's light around its mean, relative to it.
double fluorescent_low_part(double mains_cycles);
/// Amplitude of its line at `harmonic` times the ballast's frequency, relative to the mean; 0 where
/// the model has no line.
double fluorescent_line(int harmonic, double decibels_per_decade);

/// A lamp that is dimmed by pulses, as means over samples: lines near the module's carrier are low
/// by 1.6 % at ten samples a cycle.
Disturbance design_pwm(dsp::WattsPerSquareMetre mean, dsp::Hertz frequency, double duty,
                       dsp::Hertz sample_rate);

/// A sender of carrier bursts; `peak` is that of the on/off wave.
Disturbance design_keyed_light(dsp::WattsPerSquareMetre peak, dsp::Hertz carrier, double duty,
                               dsp::Hertz sample_rate);

/// Needs a sample rate above twice the carrier and a duty in (0, 1).
CarrierDesign design_carrier(dsp::WattsPerSquareMetre peak, dsp::Hertz carrier, double duty,
                             dsp::Hertz sample_rate);

}  // namespace channel
