#include "sim/trial/module_proposal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "sim/link/importance_link.hpp"
#include "sim/noise/peak_readings.hpp"
#include "sim/trial/exposed_bits.hpp"

namespace sim {
namespace {

/// Noise where a run is to have none, in standard deviations: without any, filters decay into
/// denormal numbers.
constexpr float quiet = 1e-4f;

/// Levels of a row's components are the margins less this, in standard deviations. Most of what is
/// missed is beyond the margins themselves; some not quite, as the comparator follows noise too;
/// and in a longer row one peak may be a little above.
struct Component {
  double slack, share;
};
constexpr std::array components{Component{0.6, 0.1}, Component{0.1, 0.35}, Component{0, 0.55}};

/// About how often a row that is not near makes a bit fail, as against those that are.
constexpr double far_share = 0.1;

/// Rows that are further above the level than this on average fail too rarely to matter; the
/// likelihood is then below 1e-30.
constexpr double highest_module_level = 14;
/// Those further below it are missed anyway; those that differ by more are edges of a burst.
constexpr double lowest_level = -8, steepest = 10;

/// Samples, on the grid of a chain.
double samples(dsp::Seconds t, const Link& link) { return t.value * link.chain.sample_rate.value; }

double mean_of(std::span<const double> x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

/// One stretch of a message: its bits, and the margins of the light without noise around them.
struct Part {
  std::vector<ExposedBit> bits;
  Stretch stretch;  // of margins
  std::vector<float> margins;
};

/// Which rows of missed peaks make a bit read as dark: those whose last peak is so many carrier
/// cycles before or behind the instant at which the pin is looked at.
struct PeakReach {
  double before, behind;
};

/// The pin is up for as long as the integrator needs to fill again and `spare` cycles; a UART looks
/// up to `late` of a bit late, and its clock is another.
PeakReach reach_within(const Link& link, double spare, double late) {
  const double bit = carrier_of(link) / link.device_baud;
  const double drift =
      protocol::bits_per_byte * bit * std::abs(link.device_baud / link.receiver_baud - 1);
  return {link.importance->readings + spare + drift, bit * late + drift};
}

/// Nearly all that fail, and all that may: the pin is up for longer if further peaks are missed
/// meanwhile.
PeakReach near_reach(const Link& link) { return reach_within(link, 4, 0.1); }
PeakReach far_reach(const Link& link) { return reach_within(link, 12, 0.125); }

/// When the decision of a bit is known at the pin, samples.
double decision(const Link& link, const ExposedBit& bit) {
  return samples((bit.begin + bit.end) * 0.5 + link.delay, link);
}

/// Where margins are wanted for bits, within a trial of so many samples.
Stretch around(const Link& link, const std::vector<ExposedBit>& bits, double cycle,
               std::int64_t end) {
  const PeakReach reach = far_reach(link);
  const double before = (reach.before + link.importance->readings + 2) * cycle;
  const double behind = (reach.behind + 2) * cycle;
  const auto from = static_cast<std::int64_t>(decision(link, bits.front()) - before);
  const auto to = static_cast<std::int64_t>(decision(link, bits.back()) + behind);
  const std::int64_t first = std::max<std::int64_t>(from, 0);
  return {first, std::min(to, end) - first};
}

/// A message's stretches, as one where they touch.
void add_part(std::vector<Part>& parts, Part part, std::int64_t apart) {
  if (parts.empty() || parts.back().stretch.end() + apart < part.stretch.first) {
    parts.push_back(std::move(part));
    return;
  }
  Part& last = parts.back();
  last.bits.insert(last.bits.end(), part.bits.begin(), part.bits.end());
  last.stretch.n = part.stretch.end() - last.stretch.first;
}

std::vector<Part> parts_of(const Link& link, const Transmission& sent, const PeakReadings& peaks) {
  const auto end = static_cast<std::int64_t>(samples(sent.line.end(), link));
  std::vector<Part> parts;
  for (std::vector<ExposedBit>& bits : exposed_bits(link, sent)) {
    const Stretch stretch = around(link, bits, peaks.cycle(), end);
    add_part(parts, {std::move(bits), stretch, {}}, peaks.length());
  }
  for (Part& part : parts) part.margins.assign(static_cast<std::size_t>(part.stretch.n), 0.0f);
  return parts;
}

std::vector<channel::MarginWindow> margin_windows(std::vector<Part>& parts) {
  std::vector<channel::MarginWindow> windows;
  for (Part& part : parts)
    windows.push_back({part.stretch.first, part.stretch.n, part.margins.data()});
  return windows;
}

/// Builds the proposal of one trial from its margins.
class ModuleBuilder {
 public:
  ModuleBuilder(const Link& link, const PeakReadings& peaks)
      : link_(link), peaks_(peaks), reach_(far_reach(link)), near_(near_reach(link)) {
    readings_.row = link.importance->readings;
  }

  void add(const Part& part) {
    const std::int64_t first = first_peak(part);
    const std::int64_t last =
        peaks_.first_from(static_cast<double>(part.stretch.end()) - peaks_.cycle());
    const std::size_t base = readings_.of.size();
    std::vector<double> levels;
    for (std::int64_t peak = first; peak < last; ++peak) {
      levels.push_back(level(part, peak));
      readings_.of.push_back(peaks_.reading(peak));
      readings_.levels.push_back(std::max(levels.back(), lowest_level));
    }
    for (const ExposedBit& bit : part.bits) {
      if (bit.light)
        add_rows(base, levels, first, bit);
      else
        add_dark_bit(part, decision(link_, bit));
    }
  }

  double dark_likelihood() const { return dark_likelihood_; }
  Proposal take() { return {std::move(readings_), spots_}; }

 private:
  /// With a margin, and whose reading does not begin before the trial.
  std::int64_t first_peak(const Part& part) const {
    std::int64_t peak = peaks_.first_from(static_cast<double>(part.stretch.first) + peaks_.cycle());
    while (peaks_.reading(peak).first < 0) ++peak;
    return peak;
  }

  /// By how many deviations the noise may lower a peak before it is missed.
  double level(const Part& part, std::int64_t peak) const {
    const double half = peaks_.cycle() / 2, time = peaks_.time_of(peak);
    const auto at = [&](double sample) {
      return part.margins.begin() + (static_cast<std::int64_t>(sample) - part.stretch.first);
    };
    const float margin = *std::max_element(at(time - half), at(time + half));
    return static_cast<double>(margin) /
           (static_cast<double>(link_.chain.noise_lit) * peaks_.deviation(peak));
  }

  /// All rows whose last peak is within reach of a bit. `levels` are of the peaks from `first` on,
  /// whose readings begin at `base`.
  void add_rows(std::size_t base, std::span<const double> levels, std::int64_t first,
                const ExposedBit& bit) {
    const double time = decision(link_, bit);
    const int n = link_.importance->readings;
    const std::int64_t to = peaks_.first_from(time + reach_.behind * peaks_.cycle());
    std::int64_t peak = peaks_.first_from(time - reach_.before * peaks_.cycle());
    for (; peak < to; ++peak) {
      const std::int64_t from = peak + 1 - n - first;
      if (from < 0 || from + n > static_cast<std::int64_t>(levels.size())) continue;
      const double behind = (peaks_.time_of(peak) - time) / peaks_.cycle();
      const bool near = -near_.before <= behind && behind <= near_.behind;
      const auto at = static_cast<std::size_t>(from);
      add_row(base + at, levels.subspan(at, static_cast<std::size_t>(n)),
              near ? bit.share : bit.share * far_share);
    }
  }

  /// Readings from `first` on, of these levels.
  void add_row(std::size_t first, std::span<const double> levels, double share) {
    if (mean_of(levels) > highest_module_level ||
        std::abs(levels.back() - levels.front()) > steepest)
      return;
    const std::span known = std::span(readings_.levels).subspan(first, levels.size());
    const double steps = std::max(1.0, static_cast<double>(known.size()) - 1);
    const double rise = (known.back() - known.front()) / steps;
    const double about = share * link_.importance->likelihoods->of(mean_of(known), rise);
    for (const Component& component : components)
      spots_.push_back({first, component.slack, component.share * about});
  }

  /// As many peaks of noise in a row above the level, at any phase and within reach of `time`.
  void add_dark_bit(const Part& part, double time) {
    constexpr double phases = 8;
    const std::int64_t at = static_cast<std::int64_t>(time) - part.stretch.first;
    const auto row = static_cast<std::int64_t>(link_.importance->readings * peaks_.cycle());
    const auto begin = part.margins.begin() + std::max<std::int64_t>(at - row, 0);
    const auto end = part.margins.begin() + at;
    if (begin >= end) return;
    const double deviation =
        static_cast<double>(link_.chain.noise_dark) * peaks_.deviation(peaks_.first_from(time));
    const double level = -static_cast<double>(*std::max_element(begin, end)) / deviation;
    if (level > highest_module_level) return;
    const double about = link_.importance->likelihoods->of(std::max(level, 0.0), 0);
    dark_likelihood_ += (reach_.before + reach_.behind) * phases * about;
  }

  const Link& link_;
  const PeakReadings& peaks_;
  const PeakReach reach_, near_;
  double dark_likelihood_ = 0;
  Readings readings_;
  std::vector<WeakSpot> spots_;
};

/// One trial on its way to a proposal. The proposal's readings point into `peaks`.
struct Trial {
  std::shared_ptr<PeakReadings> peaks;
  std::vector<Part> parts;
  std::vector<channel::MarginWindow> margins;
  std::vector<channel::NoiseWindow> noise;
};

/// The noise that the readings of a trial look at.
std::vector<Stretch> stretches_of(const Trial& trial) {
  std::vector<Stretch> stretches;
  for (const Part& part : trial.parts) {
    const std::int64_t first =
        std::max<std::int64_t>(part.stretch.first - trial.peaks->length(), 0);
    stretches.push_back({first, part.stretch.end() - first});
  }
  return stretches;
}

Trial open_trial(const Link& link, const Transmission& sent, const channel::ChainInput& input) {
  const channel::CarrierDesign& carrier = link.chain.carrier;
  Trial trial;
  trial.peaks = std::make_shared<PeakReadings>(
      input.unit != nullptr ? *input.unit : link.chain.module, carrier,
      channel::fundamental_phase(carrier, input.carrier_phase));
  trial.parts = parts_of(link, sent, *trial.peaks);
  trial.margins = margin_windows(trial.parts);
  return trial;
}

/// Gives all of them next to no noise; what it returns must outlive its use.
std::vector<float> silence(std::vector<Trial>& trials) {
  std::int64_t longest = 0;
  for (const Trial& trial : trials)
    for (const Stretch& s : stretches_of(trial)) longest = std::max(longest, s.n);
  std::vector<float> normals(static_cast<std::size_t>(longest), quiet);
  for (Trial& trial : trials)
    for (const Stretch& s : stretches_of(trial))
      trial.noise.push_back({s.first, s.n, normals.data()});
  return normals;
}

}  // namespace

std::vector<TrialProposal> module_proposals(const Link& link, const DrawnTrials& drawn,
                                            const std::atomic<bool>* stop,
                                            channel::StageClock* clock) {
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < drawn.sent.size(); ++i)
    trials.push_back(open_trial(link, drawn.sent[i], drawn.inputs[i]));
  const std::vector<float> silent = silence(trials);
  std::vector<channel::ChainInput> inputs = drawn.inputs;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    inputs[i].margin_windows = trials[i].margins;
    inputs[i].noise_windows = trials[i].noise;
  }
  channel::propagate(link.chain, inputs, stop, channel::InstructionSet::best, clock);
  std::vector<TrialProposal> proposals;
  for (const Trial& trial : trials) {
    ModuleBuilder builder(link, *trial.peaks);
    for (const Part& part : trial.parts) builder.add(part);
    proposals.push_back(
        {stretches_of(trial), builder.take(), trial.peaks, builder.dark_likelihood()});
  }
  return proposals;
}

}  // namespace sim
