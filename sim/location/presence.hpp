#pragma once
// Presence: does a light meter notice a device by its light alone, without demodulating it? Windows
// with and without the light are drawn and judged at thresholds of the closed form: probability of
// detection against that of false alarm (ROC), counted and computed, for one operating point.
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "channel/light_meter.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/location/detection_theory.hpp"

namespace sim {

/// Light that a message keys: each window lies somewhere inside of it, anywhere equally likely.
/// Detectors look for a steady carrier all the same.
struct KeyedMessage {
  std::string message = "IND 011111 OK";
  dsp::Hertz baud{600};
  dsp::Seconds pulse{0};  // of light, for each zero bit; 0: the whole bit
};

struct PresenceSettings {
  channel::LightMeter meter;
  channel::MeteredLight light;
  Detector detector = Detector::goertzel;
  dsp::Hertz tuned_to{59e3};                    // the carrier as the detector believes it to be
  std::size_t window_samples = 2000;            // at least 4
  std::size_t reference_samples = 2000;         // of dc_difference, before the device shines
  std::optional<KeyedMessage> keyed;            // nothing: the carrier is on all through the window
  std::vector<double> pfa = {1e-3, 1e-2, 0.1};  // each above 0 and below 1
  std::uint32_t trials = 1000;
  std::uint64_t seed = 1;
  std::uint32_t point = 0;  // of the randomness
  double level = 0.95;      // of the intervals
};

struct RocPoint {
  double pfa = 0, threshold = 0;  // of the closed form
  std::uint64_t false_alarms = 0, detections = 0;
  Estimate false_alarm = {}, detection = {};  // counted, with Clopper and Pearson's interval
  double detection_theory = 0;                // mean over phases, and of keyed light over places
};

struct PresenceResult {
  std::uint32_t trials = 0;   // fewer than asked for where it was interrupted
  std::vector<RocPoint> roc;  // a point for each of the settings' pfa
  double signal = 0;          // mean of DetectionLaw::signal over windows
  double noise_v = 0;         // of a sample without light, the ADC's rounding included
  /// The closed form holds where noise is half a step or more and nothing is clipped: Widrow and
  /// Kollar, Quantization Noise (2008), on rounding as white noise of step^2 / 12.
  double noise_over_step = 0;
  double clipped = 0;  // share of all samples
};

/// Of some trials, by the points of the ROC.
struct PresenceTally {
  std::uint32_t trials = 0;
  std::vector<std::uint64_t> false_alarms{}, detections{};
  std::uint64_t clipped = 0;  // samples

  PresenceTally& operator+=(const PresenceTally& other);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(trials, false_alarms, detections, clipped);
  }
};

class PresencePoint;

/// A point ready for any number of trials, with all that its closed form says.
class PresenceBench {
 public:
  /// Throws bad_input for a window that the message does not fill, and for a carrier that looks
  /// like steady light at this sample rate.
  explicit PresenceBench(const PresenceSettings& settings);

  /// What trials are added to.
  PresenceTally no_trials() const;
  void count(std::uint32_t number, PresenceTally& tally) const;
  PresenceResult result(const PresenceTally& tally) const;

 private:
  double level_;
  std::shared_ptr<const PresencePoint> point_;
  PresenceResult uncounted_;  // nothing counted yet
};

/// At the first threshold, with an interval of that level.
Estimate detection(const PresenceTally& tally, double level);

/// Trials first ... first + n - 1; fewer after a stop.
PresenceTally run_presence(const PresenceBench& bench, std::uint32_t first, int n,
                           const std::atomic<bool>* stop = nullptr);

/// All trials of the settings.
PresenceResult measure_presence(const PresenceSettings& settings);

/// Throws as PresenceBench.
void check_presence(const PresenceSettings& settings);

}  // namespace sim
