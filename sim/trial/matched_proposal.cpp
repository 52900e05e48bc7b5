#include "sim/trial/matched_proposal.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/link/importance_link.hpp"
#include "sim/link/sampled_theory.hpp"
#include "sim/trial/exposed_bits.hpp"

namespace sim {
namespace {

using Statistic = channel::IdealDesign::Statistic;

/// Directions in which noise makes light of a dark bit's envelope. The half-planes that begin at
/// cos(pi / 16) of the threshold cover all beyond it.
constexpr int envelope_directions = 16;

/// Levels are lower than those worked out by this, in standard deviations: a bit's noise differs by
/// up to .3 % from bit to bit, as a slot is not a whole number of carrier cycles.
constexpr double slack = 0.05;

/// Beyond this, noise is so rare (1e-149) that sums of squared weights would underflow.
constexpr double highest_matched_level = 26;

/// A carrier over a slot, its cosine and its sine, of unit length each.
struct Tones {
  Eigen::VectorXf cosine, sine;
  double length;  // that the cosine had

  Tones(const channel::SlotSamples& slot, double cycles_per_sample, double phase)
      : cosine(slot.end - slot.begin), sine(slot.end - slot.begin) {
    for (std::int64_t i = slot.begin; i < slot.end; ++i) {
      const double turns = phase + cycles_per_sample * static_cast<double>(i);
      cosine[i - slot.begin] = static_cast<float>(std::cos(2 * std::numbers::pi * turns));
      sine[i - slot.begin] = static_cast<float>(std::sin(2 * std::numbers::pi * turns));
    }
    length = static_cast<double>(cosine.norm());
    cosine.normalize();
    sine.normalize();
  }
};

class MatchedBuilder {
 public:
  MatchedBuilder(const Link& link, std::uint32_t phase)
      : link_(link),
        cycles_per_sample_(link.chain.carrier.step * 0x1p-32),
        start_(phase * 0x1p-32),
        phase_(channel::fundamental_phase(link.chain.carrier, phase) * 0x1p-32) {}

  void add(const ExposedBit& bit) {
    const channel::CorrelatorOutput& output = link_.importance->output;
    const double threshold = link_.ideal->threshold;
    const channel::SlotSamples slot =
        channel::slot_samples({bit.begin, bit.end}, link_.chain.sample_rate);
    const Tones tones(slot, cycles_per_sample_, phase_);
    const double amplitude = bit.light ? amplitude_of(bit, slot, tones) : 0;
    const bool ring = !bit.light && link_.ideal->statistic == Statistic::envelope;
    const double level = bit.light ? (amplitude - threshold) / output.deviation_lit
                                   : (threshold - leak_of(bit, slot)) / output.deviation_dark;
    if (ring)
      add_ring(slot.begin, tones, bit.share, level);
    else
      add_spot({slot.begin, kept(tones.cosine), bit.light ? -1.0f : 1.0f}, bit.share, level);
  }

  Proposal take() { return {std::move(readings_), spots_, std::move(coefficients_)}; }

 private:
  /// What lit neighbours of a dark bit bring to it at most, by the samples that it shares with
  /// them.
  double leak_of(const ExposedBit& bit, const channel::SlotSamples& slot) const {
    const double begin = dsp::cycles(bit.begin, link_.chain.sample_rate);
    const double end = dsp::cycles(bit.end, link_.chain.sample_rate);
    const double shared = std::max(0.0, begin - static_cast<double>(slot.begin)) +
                          std::max(0.0, static_cast<double>(slot.end) - end);
    const double lit_sample =
        static_cast<double>(link_.chain.carrier.amplitude) * cycles_per_sample_;
    return 2 * lit_sample * shared / static_cast<double>(slot.end - slot.begin);
  }

  /// Of a bit that is light, with dark ones beside it, as its samples have it: at some carriers it
  /// differs by 2 % with their phase (sim/link/sampled_theory.hpp).
  double amplitude_of(const ExposedBit& bit, const channel::SlotSamples& slot,
                      const Tones& tones) const {
    const double begin = dsp::cycles(bit.begin, link_.chain.sample_rate);
    const double end = dsp::cycles(bit.end, link_.chain.sample_rate);
    double in_phase = 0;
    for (std::int64_t i = slot.begin; i < slot.end; ++i) {
      const double from = std::max(static_cast<double>(i), begin);
      const double to = std::min(static_cast<double>(i + 1), end);
      in_phase += carrier_light(link_.chain.carrier, start_ + cycles_per_sample_ * from,
                                start_ + cycles_per_sample_ * to) *
                  static_cast<double>(tones.cosine[i - slot.begin]);
    }
    return 2 * in_phase * tones.length / static_cast<double>(slot.end - slot.begin);
  }

  std::span<const float> kept(const Eigen::VectorXf& tone) {
    return coefficients_.emplace_back(tone.begin(), tone.end());
  }
  /// The cosine, behind which the sine is.
  std::span<const float> kept(const Tones& tones) {
    std::vector<float>& both = coefficients_.emplace_back(tones.cosine.begin(), tones.cosine.end());
    both.insert(both.end(), tones.sine.begin(), tones.sine.end());
    return std::span(both).first(both.size() / 2);
  }

  void add_ring(std::int64_t first, const Tones& tones, double share, double radius) {
    const double level = radius * std::cos(std::numbers::pi / envelope_directions);
    const double both = static_cast<double>(tones.cosine.dot(tones.sine));
    const std::span<const float> cosine = kept(tones);
    for (int i = 0; i < envelope_directions; ++i) {
      const double angle = 2 * std::numbers::pi * i / envelope_directions;
      const double c = std::cos(angle), s = -std::sin(angle);
      const double length = std::sqrt(1 + 2 * c * s * both);
      add_spot({first, cosine, static_cast<float>(c / length), static_cast<float>(s / length)},
               share, level);
    }
  }

  void add_spot(const NoiseReading& reading, double share, double level) {
    if (level > highest_matched_level) return;
    readings_.of.push_back(reading);
    readings_.levels.push_back(level);
    const double about = link_.importance->likelihoods->of(level - slack, 0);
    spots_.push_back({readings_.of.size() - 1, slack, share * about});
  }

  const Link& link_;
  double cycles_per_sample_, start_, phase_;  // phase_: of the fundamental
  std::vector<std::vector<float>> coefficients_;
  Readings readings_;
  std::vector<WeakSpot> spots_;
};

}  // namespace

TrialProposal matched_proposal(const Link& link, const Transmission& sent, std::uint32_t phase) {
  const dsp::Hertz rate = link.chain.sample_rate;
  TrialProposal trial;
  MatchedBuilder builder(link, phase);
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
