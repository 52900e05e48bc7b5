#pragma once
// The ideal link as one decision variable a bit: what a matched receiver (channel/ideal_receiver)
// measures over a bit is drawn from its distribution, and no sample is made. In white noise the
// in-phase and the quadrature part are independent Gaussians; their deviation is that of the
// samples' noise, and the mean of the in-phase part is the fundamental's amplitude where the bit is
// light, 0 where it is dark. Proakis & Salehi, "Digital Communications", 5th ed., 4.2, 4.5.
//
// A trial's noise is its own, eight trials together are each the trial alone, and all instruction
// sets give the same bits. Normals end at 6.5 deviations (dsp/normal.hpp).
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "channel/chain.hpp"
#include "channel/decision_kernel.hpp"
#include "channel/ideal_receiver.hpp"
#include "dsp/units.hpp"

namespace channel {

/// What a matched receiver measures of a bit, in mW/m2.
struct CorrelatorOutput {
  double amplitude;       // of light: the mean of the in-phase part
  double deviation_dark;  // a component
  double deviation_lit;
};

/// The same that the samples of `chain` would give it.
CorrelatorOutput correlator_output(const ChainDesign& chain, const LightSettings& light,
                                   dsp::Hertz baud);

/// The bits that all trials of a point send, and how each is decided.
struct DecisionDesign {
  IdealDesign::Statistic statistic = IdealDesign::Statistic::in_phase;
  std::vector<DecisionBit> bits{};
  std::vector<std::uint8_t> sent{};       // 0xff light, 0 dark
  std::vector<std::uint8_t> noiseless{};  // 0xff: wrong even without noise, else 0
};

/// `levels` are those of the line, an even number of them: false is light.
DecisionDesign design_decisions(const IdealDesign& receiver, const CorrelatorOutput& output,
                                const std::vector<bool>& levels);

using NoiseSeed = std::array<std::uint32_t, 4>;

/// Of each bit: bit i tells whether trial i takes it for what it is not.
using WrongBits = std::vector<std::uint8_t>;

/// Decides all bits of up to eight trials at once.
WrongBits decide(const DecisionDesign& design, std::span<const NoiseSeed> trials,
                 InstructionSet set = InstructionSet::best);

/// Those of one trial, computed alone: bit 0 is that trial's.
WrongBits decide_alone(const DecisionDesign& design, const NoiseSeed& trial);

}  // namespace channel
