#pragma once
// The chain from the wire that drives the LED to the wire that the receiver module gives: keying,
// light, noise, module, edges. Wires are LogicTraces: low = light on the way in, and on the way
// out. Results do not depend on how many trials run together nor on the instruction set.
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "channel/disturbance.hpp"
#include "channel/ideal_receiver.hpp"
#include "channel/instruction_set.hpp"
#include "channel/keyed_carrier.hpp"
#include "channel/noise_window.hpp"
#include "channel/receiver_module.hpp"
#include "channel/stage_clock.hpp"
#include "dsp/logic_trace.hpp"
#include "dsp/units.hpp"

namespace channel {

struct ChainDesign {
  dsp::Hertz sample_rate;
  CarrierDesign carrier;
  ModuleDesign module;
  float noise_dark = 0;  // standard deviation of a sample, mW/m2
  float noise_lit = 0;   // the same while the carrier is on
  std::vector<Disturbance> disturbances{};
};

/// What the light of one operating point is made of.
struct LightSettings {
  dsp::WattsPerSquareMetre signal;   // effective, peak of the on/off wave
  dsp::WattsPerSquareMetre ambient;  // effective, constant; means of disturbances included
  dsp::Hertz carrier;                // its true frequency
  double duty = 0.5;
  double noise_scale = 1;
};

/// Needs a sample rate above twice the carrier and a duty in (0, 1).
ChainDesign design_chain(const ModuleData& module, const LightSettings& light,
                         dsp::Hertz sample_rate);

/// A unit of the module that differs from the others, for ChainInput::unit in trials of a chain.
ModuleDesign design_unit(const ModuleData& unit, dsp::WattsPerSquareMetre ambient,
                         const ChainDesign& chain);

/// One trial: the wire that drives the LED, observed to its end, and the trial's random state.
struct ChainInput {
  const dsp::LogicTrace* drive;
  std::uint32_t carrier_phase;  // at time 0, in 2^-32 cycles
  std::array<std::uint32_t, 4> noise_seed;
  const ModuleDesign* unit = nullptr;  // a module of the trial's own instead of the design's
  std::vector<DisturbanceInput> disturbances{};  // one for each of the design's
  std::span<const NoiseWindow> noise_windows{};
  std::span<const MarginWindow> margin_windows{};  // filled by propagate()
};

/// Trials that belong together: a random number of theirs, or a result, may be the group's.
constexpr int lanes_per_group = 8;

/// The module's pin for each of the trials, as many at once as the processor has lanes for, and
/// those of like length together, so many trials at a call are the faster. Gives up soon after
/// `*stop` has become true; the pins are then worth nothing. `clock`, if given, is told where the
/// time goes.
std::vector<dsp::LogicTrace> propagate(const ChainDesign& design,
                                       std::span<const ChainInput> inputs,
                                       const std::atomic<bool>* stop = nullptr,
                                       InstructionSet set = InstructionSet::best,
                                       StageClock* clock = nullptr);

/// Every sample of one trial at the chain's taps.
struct Recording {
  std::vector<float> irradiance, band_pass, threshold, integrator, agc_gain;
};

/// The pin of one trial, computed alone; the same bits as in a group. Fills `recording` if given.
dsp::LogicTrace propagate_alone(const ChainDesign& design, const ChainInput& input,
                                Recording* recording = nullptr);

/// The same light and noise heard by a matched receiver instead of the module, which is told each
/// trial's bits' slots.
std::vector<dsp::LogicTrace> detect(const ChainDesign& design, const IdealDesign& receiver,
                                    std::span<const ChainInput> inputs,
                                    std::span<const BitSlots> slots,
                                    const std::atomic<bool>* stop = nullptr,
                                    InstructionSet set = InstructionSet::best,
                                    StageClock* clock = nullptr);

/// One trial of that alone; of `recording` only the irradiance has numbers, the rest is NaN.
dsp::LogicTrace detect_alone(const ChainDesign& design, const IdealDesign& receiver,
                             const ChainInput& input, const BitSlots& slots,
                             Recording* recording = nullptr);

}  // namespace channel
