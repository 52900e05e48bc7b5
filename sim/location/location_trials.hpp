#pragma once
// How well a device is located from where receivers stand: readings of a known place with noise,
// located again and again; the rms error beside the Cramer-Rao bound, and how often the 95 %
// region and the ellipse of the covariance hold the truth.
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/counting/statistics.hpp"
#include "sim/location/locate.hpp"

namespace sim {

struct LocationTrialsSettings {
  LocateSettings locate;
  Position truth;
  /// Places, headings and deviations; what they measure is drawn.
  std::vector<Reading> readings;
  std::uint32_t trials = 1000;
  std::uint64_t seed = 1;
  std::uint32_t point = 0;  // of the randomness
  double level = 0.95;      // of the intervals
};

struct LocationTrials {
  static constexpr std::size_t outcomes = 5;
  std::array<std::uint64_t, outcomes> count{};  // by LocateOutcome
  double squared_um2 = 0;                       // sum of the squared errors of the located ones
  Estimate rmse_m;  // of the located ones; the mean square's interval is that of SkewedMean
  std::optional<PositionCovariance> bound;  // of Cramer and Rao; nothing if underdetermined
  std::uint64_t covered = 0;  // located with the truth in the ellipse of the covariance
  Estimate coverage;          // of the located ones, with Clopper and Pearson's interval
  Estimate region_coverage;   // the same of the likelihood's region

  /// Fewer than asked for where it was interrupted.
  std::uint64_t trials() const;

  /// Root of the bound's trace; infinite if underdetermined.
  double bound_m() const;
};

/// What one trial came to.
struct LocationTrial {
  LocateOutcome outcome = LocateOutcome::not_converged;
  double squared_m2 = 0;  // of the error of a located one
  bool covered = false, in_region = false;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(outcome, squared_m2, covered, in_region);
  }
};

/// In the order of their numbers: sums of errors depend on it in their last digits.
struct LocationTally {
  std::vector<LocationTrial> trials{};

  LocationTally& operator+=(const LocationTally& next);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(trials);
  }
};

/// Receivers and noiseless readings, ready for any number of trials.
class LocationBench {
 public:
  explicit LocationBench(const LocationTrialsSettings& settings);

  std::vector<Reading> drawn(std::uint32_t trial) const;
  LocationTrial judged(std::uint32_t trial) const;
  LocationTrials summed(const LocationTally& tally) const;
  const Locator& locator() const { return locator_; }

 private:
  LocationTrialsSettings settings_;
  std::vector<Reading> readings_;
  Locator locator_;
  std::optional<PositionCovariance> bound_;
};

/// Of the located ones, with an interval of that level.
Estimate rms_error_m(const LocationTally& tally, double level);

/// Trials first ... first + n - 1; fewer after a stop.
LocationTally run_location(const LocationBench& bench, std::uint32_t first, int n,
                           const std::atomic<bool>* stop = nullptr);

/// All trials of the settings.
LocationTrials measure_location(const LocationTrialsSettings& settings);

struct TrialAddress {
  std::uint64_t seed = 1;
  std::uint32_t point = 0, trial = 0;
};

/// One trial: what it measured, and where that leads, with regions.
Location locate_trial(const LocationTrialsSettings& settings, std::uint32_t trial);

/// The first so many, in much less time than each alone.
std::vector<Location> locate_first_trials(const LocationTrialsSettings& settings,
                                          std::uint32_t trials);

/// What a trial measures: noiseless readings with the noise that they say they have.
std::vector<Reading> drawn_readings(std::vector<Reading> noiseless, const TrialAddress& address);

/// The readings of a device at `device` without noise; places, headings and deviations are kept.
std::vector<Reading> noiseless_readings(const LightModel& model, std::vector<Reading> readings,
                                        const Position& device);

}  // namespace sim
