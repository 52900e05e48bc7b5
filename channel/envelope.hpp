#pragma once
// The chain of channel/chain.hpp as its envelope, one step a carrier cycle. Behind the band-pass,
// the real part of one complex pole's state, light and noise are narrow, so a cycle is known by one
// complex number: its positive peak's height and instant, and from these how long the comparator is
// high. The pole is advanced exactly: by the response to steady light, that to each edge of a burst
// at its own instant and phase, and white noise with the covariance of a whole step. Hold,
// integrator, follower and slow AGC then go from peak to peak (channel/envelope_receiver.hpp).
//
// It stands for a waveform of a given sample rate: amplitude, front end and what the comparator
// misses of a peak between samples are those of its samples, on average over the grid.
//
// A trial is computed in stretches. Before each the dark may have been left out: the AGC's gain
// falls as it would, to where noise begins to be seen at most, and the stretch must begin so much
// earlier than its light that the gain settles in noise (EnvelopeUnit::settling).
//
// A trial's noise is its own, eight trials together are each the trial alone, and all instruction
// sets give the same bits.
#include <array>
#include <atomic>
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "channel/chain.hpp"
#include "channel/envelope_design.hpp"
#include "channel/envelope_kernel.hpp"
#include "dsp/logic_trace.hpp"
#include "dsp/units.hpp"

namespace channel {

/// A module in the light of one operating point.
struct EnvelopeUnit {
  EnvelopeDesign design;
  std::complex<double> pole;  // of the band-pass, 1/s
  std::complex<double> gain;  // the band-pass output is the real part of this times the state
  double irradiance;          // of the carrier as the band-pass gets it, peak, mW/m2
  double peak_phase;          // of the carrier when the band-pass output has its peak, cycles
  dsp::Seconds delay;         // of an edge in the front end
  double settling;            // steps of dark that settle the gain in noise
  double ending;              // steps that the pin needs to be idle behind the last light
};

struct EnvelopeChain {
  dsp::Hertz carrier;  // and the steps' rate
  double duty;
  EnvelopeUnit unit;
};

/// Standard deviation of the noise in the dark behind the band-pass, mW/m2.
double noise_deviation(const ModuleData& module, const ChainDesign& waveform);

/// The module of a waveform, in the same light. Disturbances are not looked at.
EnvelopeChain design_envelope(const ModuleData& module, const LightSettings& light,
                              const ChainDesign& waveform);

/// One trial, as channel::ChainInput, and when its stretches begin.
struct EnvelopeInput {
  const dsp::LogicTrace* drive;
  std::uint32_t carrier_phase;
  std::array<std::uint32_t, 4> noise_seed;
  std::vector<dsp::Seconds> begins;
};

/// The module's pin for each of the trials, as many at once as the processor has lanes for. `steps`
/// of each stretch are the same in all of them, and whole blocks; stretches are in order, do not
/// overlap and hold all light of the drive. Gives up soon after `*stop` has become true; the pins
/// are then worth nothing.
std::vector<dsp::LogicTrace> propagate_envelopes(const EnvelopeChain& chain,
                                                 std::span<const EnvelopeInput> inputs,
                                                 std::span<const std::int32_t> steps,
                                                 const std::atomic<bool>* stop = nullptr,
                                                 InstructionSet set = InstructionSet::best);

/// The pin of one trial, computed alone; the same bits as in a group.
dsp::LogicTrace propagate_envelope(const EnvelopeChain& chain, const EnvelopeInput& input,
                                   std::span<const std::int32_t> steps);

}  // namespace channel
