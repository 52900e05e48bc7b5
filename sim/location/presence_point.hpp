#pragma once
// One operating point of a presence experiment with all worked out that its windows share.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "channel/carrier_detector.hpp"
#include "channel/light_meter.hpp"
#include "dsp/philox.hpp"
#include "sim/location/presence.hpp"
#include "sim/trial/trial.hpp"

namespace sim {

class PresencePoint {
 public:
  /// Throws as PresenceBench.
  explicit PresencePoint(const PresenceSettings& settings);

  struct Trial {
    double without, with;  // the statistic, without and with light
    std::size_t clipped;   // samples, of samples_drawn()
  };
  Trial trial(std::uint32_t number) const;
  std::size_t samples_drawn() const { return 2 * s_.window_samples + references_drawn(); }

  /// The closed form's law for a window at a phase of the carrier, in cycles, and at a place of the
  /// keyed message, from 0 to 1.
  DetectionLaw law(double phase, double place) const;

  /// Of a sample without light, as the ADC gives it; rounding counts as white noise.
  double deviation() const { return deviation_; }

 private:
  using Samples = std::vector<double>;
  using Statistic = std::function<double(const Samples& window, const Samples& reference)>;

  double in_ms(double samples) const;
  dsp::RandomAddress address(std::uint32_t trial, Purpose purpose) const;
  double deviation_at(double mean_volts) const;
  void place_message();
  void refuse_blindness() const;
  channel::MeterWindow window_at(double phase, double place) const;
  channel::SynchronousDetector synchronous(double phase) const;
  /// 0 at phases at which the carrier looks like steady light.
  Statistic statistic_at(double phase) const;
  /// Other detectors than the difference of means need no reference.
  std::size_t references_drawn() const {
    return s_.detector == Detector::dc_difference ? s_.reference_samples : 0;
  }
  Samples dark_reference() const;
  double statistic_widening(double widening) const;
  /// What the ADC makes of voltages and the noise that their mean has.
  Samples sampled(Samples volts, const float* normals) const;

  PresenceSettings s_;
  channel::GoertzelDetector goertzel_;
  double dark_volts_, deviation_;
  std::vector<channel::Burst> message_;  // light, in samples from the message's begin
  double room_ = 0;                      // places of a window in the message, in samples
};

}  // namespace sim
