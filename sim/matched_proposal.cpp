#include "sim/matched_proposal.hpp"

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/exposed_bits.hpp"
#include "sim/importance_link.hpp"

namespace sim {
namespace {

using Statistic = channel::IdealDesign::Statistic;

/// Directions in which noise makes light of a dark bit's envelope. The half-planes that begin at
/// cos(pi / 16) of the threshold cover all beyond it.
constexpr int envelope_directions = 16;

/// Levels are lower than the nominal ones by this, in standard deviations: what a bit measures
/// differs by up to .3 % from bit to bit, as a slot is not a whole number of carrier cycles.
constexpr double slack = 0.1;

/// Beyond this, noise is so rare (1e-149) that sums of squared weights would underflow.
constexpr double highest_level = 26;

/// A carrier over a slot, its cosine and its sine.
struct Tones {
  Eigen::VectorXf cosine, sine;

  Tones(const channel::SlotSamples& slot, double cycles_per_sample, double phase)
      : cosine(slot.end - slot.begin), sine(slot.end - slot.begin) {
    for (std::int64_t i = slot.begin; i < slot.end; ++i) {
      const double turns = phase + cycles_per_sample * static_cast<double>(i);
      cosine[i - slot.begin] = static_cast<float>(std::cos(2 * std::numbers::pi * turns));
      sine[i - slot.begin] = static_cast<float>(std::sin(2 * std::numbers::pi * turns));
    }
  }

  /// The carrier shifted by a phase, of unit length.
  std::vector<float> at(double phase) const {
    const auto angle = static_cast<float>(2 * std::numbers::pi * phase);
    const Eigen::VectorXf tone = (std::cos(angle) * cosine - std::sin(angle) * sine).normalized();
    return {tone.begin(), tone.end()};
  }
};

class Builder {
 public:
  Builder(const Link& link, std::uint32_t phase)
      : link_(link),
        cycles_per_sample_(link.chain.carrier.step * 0x1p-32),
        phase_(channel::fundamental_phase(link.chain.carrier, phase) * 0x1p-32) {}

  void add(const ExposedBit& bit) {
    const channel::CorrelatorOutput& output = link_.importance->output;
    const double threshold = link_.ideal->threshold;
    const channel::SlotSamples slot =
        channel::slot_samples({bit.begin, bit.end}, link_.chain.sample_rate);
    const Tones tones(slot, cycles_per_sample_, phase_);
    if (bit.light)
      add_spot(slot.begin, tones, bit.share, 0.5,
               (output.amplitude - threshold) / output.deviation_lit);
    else if (link_.ideal->statistic == Statistic::in_phase)
      add_spot(slot.begin, tones, bit.share, 0, threshold / output.deviation_dark);
    else
      add_ring(slot.begin, tones, bit.share, threshold / output.deviation_dark);
  }

  Proposal take() { return {std::move(readings_), spots_, std::move(coefficients_)}; }

 private:
  void add_ring(std::int64_t first, const Tones& tones, double share, double radius) {
    for (int i = 0; i < envelope_directions; ++i)
      add_spot(first, tones, share, static_cast<double>(i) / envelope_directions,
               radius * std::cos(std::numbers::pi / envelope_directions));
  }

  /// Noise of that phase against the carrier's at least at `level`.
  void add_spot(std::int64_t first, const Tones& tones, double share, double phase, double level) {
    if (level > highest_level) return;
    coefficients_.push_back(tones.at(phase));
    readings_.of.push_back({first, coefficients_.back()});
    readings_.levels.push_back(level);
    const double about = link_.importance->likelihoods->of(level - slack, 0);
    spots_.push_back({readings_.of.size() - 1, slack, share * about});
  }

  const Link& link_;
  double cycles_per_sample_, phase_;
  std::vector<std::vector<float>> coefficients_;
  Readings readings_;
  std::vector<WeakSpot> spots_;
};

}  // namespace

TrialProposal matched_proposal(const Link& link, const Transmission& sent, std::uint32_t phase) {
  const dsp::Hertz rate = link.chain.sample_rate;
  TrialProposal trial;
  Builder builder(link, phase);
  for (const std::vector<ExposedBit>& part : exposed_bits(link, sent)) {
    for (const ExposedBit& bit : part) builder.add(bit);
    const std::int64_t first =
        channel::slot_samples({part.front().begin, part.front().end}, rate).begin;
    const std::int64_t end = channel::slot_samples({part.back().begin, part.back().end}, rate).end;
    trial.stretches.push_back({first, end - first});
  }
  trial.proposal = builder.take();
  return trial;
}

}  // namespace sim
