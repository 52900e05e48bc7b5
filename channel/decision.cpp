#include "channel/decision.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "channel/decision_loop.hpp"

namespace channel {
namespace {

/// Where noise of less than `distance` deviations has its uniform number; the distance is taken a
/// little shorter, which covers the rounding of single precision.
double uniform_beyond(double distance) {
  const double surely = std::max(0.0, distance * (1 - 1e-5) - 1e-3);
  return 0x1p31 * std::exp(-surely * surely / 2);
}

DecisionBit bit_of(const IdealDesign& receiver, double amplitude, double deviation) {
  const double mean = amplitude / deviation, threshold = receiver.threshold / deviation;
  const double distance = threshold - mean;
  const bool envelope = receiver.statistic == IdealDesign::Statistic::envelope;
  return {.slope = static_cast<float>(2 * mean),
          .limit = static_cast<float>(envelope ? distance * (threshold + mean) : distance),
          .reach = static_cast<float>(uniform_beyond(std::abs(distance)))};
}

std::uint8_t in_all_lanes(bool value) { return value ? 0xff : 0; }

/// Two bits that are decided by one pair of normals.
void share_reach(std::vector<DecisionBit>& bits) {
  for (std::size_t i = 0; i < bits.size(); i += 2)
    bits[i].reach = bits[i + 1].reach = std::max(bits[i].reach, bits[i + 1].reach);
}

DecisionKernelInput kernel_input(const DecisionDesign& design, const NoiseSeed* seeds,
                                 WrongBits& wrong) {
  return {.noise_seed = seeds,
          .bits = design.bits.data(),
          .n_bits = design.bits.size(),
          .envelope = design.statistic == IdealDesign::Statistic::envelope,
          .sent = design.sent.data(),
          .wrong = wrong.data()};
}

void run_decisions(const DecisionKernelInput& input, [[maybe_unused]] InstructionSet set) {
#ifdef COSYS_HAVE_X86
  if (runs_v3(set)) return decide_lanes_v3(input);
#endif
  decide_lanes_baseline(input);
}

}  // namespace

CorrelatorOutput correlator_output(const ChainDesign& chain, const LightSettings& light,
                                   dsp::Hertz baud) {
  const auto deviation = [&](float sample) {
    return amplitude_deviation(static_cast<double>(sample), chain.sample_rate, baud);
  };
  return {.amplitude = fundamental_of(light.signal.value * 1e3, light.duty),
          .deviation_dark = deviation(chain.noise_dark),
          .deviation_lit = deviation(chain.noise_lit)};
}

DecisionDesign design_decisions(const IdealDesign& receiver, const CorrelatorOutput& output,
                                const std::vector<bool>& levels) {
  assert(levels.size() % 2 == 0);
  DecisionDesign design{.statistic = receiver.statistic};
  for (const bool dark : levels) {
    const double amplitude = dark ? 0 : output.amplitude;
    const bool heard = amplitude > receiver.threshold;
    design.bits.push_back(
        bit_of(receiver, amplitude, dark ? output.deviation_dark : output.deviation_lit));
    design.sent.push_back(in_all_lanes(!dark));
    design.noiseless.push_back(in_all_lanes(heard == dark));
  }
  if (receiver.statistic == IdealDesign::Statistic::in_phase) share_reach(design.bits);
  return design;
}

WrongBits decide(const DecisionDesign& design, std::span<const NoiseSeed> trials,
                 InstructionSet set) {
  assert(trials.size() <= lanes_per_group);
  std::array<NoiseSeed, lanes_per_group> seeds{};
  std::ranges::copy(trials, seeds.begin());
  WrongBits wrong = design.noiseless;
  run_decisions(kernel_input(design, seeds.data(), wrong), set);
  return wrong;
}

WrongBits decide_alone(const DecisionDesign& design, const NoiseSeed& trial) {
  WrongBits wrong = design.noiseless;
  run_decisions<float>(kernel_input(design, &trial, wrong));
  return wrong;
}

}  // namespace channel
