#pragma once
// Link: one operating point with everything worked out that its trials share, from the bytes of the
// message to the numbers per sample. Built once a point from a Scenario; constant from then on.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "channel/chain.hpp"
#include "channel/geometry.hpp"
#include "dsp/units.hpp"
#include "protocol/uart_receivers.hpp"
#include "sim/link/decision_link.hpp"
#include "sim/link/envelope_link.hpp"
#include "sim/link/operating_point.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

struct ImportanceLink;

struct Link {
  // Device.
  std::string message;     // as the user knows it
  protocol::Bytes bytes;   // as the line carries it
  dsp::Hertz device_baud;  // true rates, clock errors included
  dsp::Seconds pulse{0};   // of light, for each zero bit; 0: the whole bit
  dsp::Seconds start_jitter, interval_min, interval_max;
  int warmup_messages = 1;
  // Light and module.
  channel::ChainDesign chain;
  std::optional<channel::IdealDesign> ideal;         // a matched receiver instead of the module
  std::optional<DecisionLink> decisions;             // where no waveform is made
  std::optional<EnvelopeLink> envelope;              // where the module's is made in place of one
  std::shared_ptr<const ImportanceLink> importance;  // where trials are weighted
  dsp::Seconds delay;                                // constant part, light to pin
  channel::ModuleData module;                        // under the point's conditions
  dsp::WattsPerSquareMetre ambient;
  std::vector<DisturbanceSettings> disturbances;  // in the order of the chain's
  bool population = false;                        // each trial has a unit of its own
  bool draws_constants = false;                   // of which what nobody printed is drawn too
  // Receiver.
  dsp::Hertz receiver_baud;
  const protocol::UartReceiver* uart = nullptr;
  bool has_monostable = false;  // that makes whole bits of short pulses before it
  // Randomness.
  std::uint64_t seed = 0;
  std::uint32_t point = 0;  // hash of the point's canonical text

  OperatingPoint operating;
  std::uint64_t validity_flags = 0;  // of the models' validity, as sim/link/validity has it
};

/// The carrier's true frequency, as the chain has it.
dsp::Hertz carrier_of(const Link& link);

Link make_link(const Scenario& scenario);

/// What bounds the envelope (sim/scenario/fidelity) at a point of a module.
struct EnvelopeBounds {
  double detuning;          // of the carrier from f0, as a share of f0
  double overload;          // the light's irradiance over the limiter's
  double level_over_noise;  // the comparator's level over the deviation of the noise in the dark
  double steps;             // carrier cycles at a stretch, at most
};

EnvelopeBounds envelope_bounds(const Scenario& scenario);

/// What makes its random numbers other than those of other points: a hash of its canonical text.
std::uint32_t point_hash(const Scenario& scenario);

/// Whether a monostable before the UART makes whole bits of short pulses.
bool reads_by_monostable(const Scenario& scenario);

/// The scenario's module as it is where and how it is used.
channel::ModuleData module_of(const Scenario& scenario);

/// |H| of its band-pass at `f`: the formula of channel/band_pass.hpp (Vishay 82459 rev 1.8 Fig. 5).
double band_pass_gain(const channel::ModuleData& module, dsp::Hertz f);

/// What a module makes of an LED's colour, relative to 940 nm.
double colour_response(const channel::ModuleData& module, const channel::EmitterData& led,
                       double celsius);

/// Light that the scenario's receiver gets, by path.
channel::ReceivedLight light_of(const Scenario& scenario);

/// The same with another receiver in the module's place.
channel::ReceivedLight light_of(const Scenario& scenario, const channel::Directivity& directivity);

}  // namespace sim
