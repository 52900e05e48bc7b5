#pragma once
// Presence: does a light meter notice a device by its light alone, without demodulating it? Windows
// with and without the light are drawn and judged at thresholds of the closed form: probability of
// detection against that of false alarm (ROC), counted and computed, for one operating point.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "channel/light_meter.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/location/detection_theory.hpp"
#include "sim/location/trial_sharing.hpp"

namespace sim {

/// Light that a message keys: each window lies somewhere inside of it, anywhere equally likely.
/// Detectors look for a steady carrier all the same.
struct KeyedMessage {
  std::string message = "IND 011111 OK";
  dsp::Hertz baud{600};
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

/// The same for any equal settings and number of threads; nothing if an interrupt came before any
/// trial was done. Throws
/// bad_input for a window that the message does not fill, and for a carrier that looks like steady
/// light at this sample rate.
std::optional<PresenceResult> measure_presence(const PresenceSettings& settings,
                                               const Workers& workers);

/// The same by one thread.
PresenceResult measure_presence(const PresenceSettings& settings);

/// Throws as measure_presence.
void check_presence(const PresenceSettings& settings);

}  // namespace sim
