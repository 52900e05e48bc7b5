#pragma once
// A module's band-pass seen as readings of a trial's noise: what noise adds to the output at the
// peak of each carrier cycle, which is where the comparator looks. Instants are thirds of a sample,
// as the comparator's are (channel/band_pass.hpp).
#include <array>
#include <cstdint>
#include <vector>

#include "channel/keyed_carrier.hpp"
#include "channel/receiver_module.hpp"
#include "sim/noise/trial_noise.hpp"

namespace sim {

class PeakReadings {
 public:
  /// Of the lit carrier, of which `phase` is the fundamental's at the centre of sample 0.
  PeakReadings(const channel::ModuleDesign& module, const channel::CarrierDesign& carrier,
               std::uint32_t phase);

  /// Samples a carrier cycle.
  double cycle() const { return 1 / cycles_per_sample_; }
  /// How far back a reading looks, samples.
  std::int64_t length() const { return static_cast<std::int64_t>(thirds_[0].against.size()); }

  /// Peaks are numbered by the cycles of the carrier. The first at or behind a time, in samples.
  std::int64_t first_from(double time) const;
  /// When one is, in samples from the start of the trial, sample i ending at i + 1.
  double time_of(std::int64_t peak) const;

  /// What noise takes from that peak, in standard deviations; the coefficients are this object's.
  NoiseReading reading(std::int64_t peak) const;
  /// Standard deviation of the output at that peak, of samples with deviation 1.
  double deviation(std::int64_t peak) const { return third_of(peak).deviation; }

 private:
  /// The output some thirds into a sample: of unit deviation, against the signal, oldest first.
  struct Third {
    std::vector<float> against;
    double deviation;
  };
  struct Instant {
    std::int64_t sample;
    int third;  // 0, 1: on the way; 2: the end of the sample
  };

  Instant instant_of(std::int64_t peak) const;
  const Third& third_of(std::int64_t peak) const;

  double cycles_per_sample_;
  double offset_;  // of peak 0, samples
  std::array<Third, 3> thirds_;
};

}  // namespace sim
