#include "sim/location/presence.hpp"

#include <cmath>

#include "sim/location/presence_point.hpp"

namespace sim {
namespace {

/// Windows over which the closed form is averaged.
constexpr int theory_windows = 512;

void count(const PresencePoint::Trial& trial, std::vector<RocPoint>& roc) {
  for (RocPoint& point : roc) {
    point.false_alarms += trial.without > point.threshold ? 1 : 0;
    point.detections += trial.with > point.threshold ? 1 : 0;
  }
}

Estimate share(std::uint64_t successes, std::uint32_t trials, double level) {
  const Interval ci = clopper_pearson(static_cast<double>(successes), trials, level);
  return {ratio(successes, trials), ci.low, ci.high};
}

/// The mean over phases and places of a grid that fills their square.
void add_theory(const PresencePoint& point, Detector detector, PresenceResult& result) {
  constexpr double golden = 0.6180339887498949;
  for (int k = 0; k < theory_windows; ++k) {
    const DetectionLaw law = point.law(std::fmod(k * golden, 1.0), (k + 0.5) / theory_windows);
    result.signal += law.signal / theory_windows;
    for (RocPoint& roc : result.roc)
      roc.detection_theory += detection_probability(detector, roc.pfa, law) / theory_windows;
  }
}

}  // namespace

PresenceResult measure_presence(const PresenceSettings& settings) {
  const PresencePoint point(settings);
  PresenceResult result;
  for (const double pfa : settings.pfa)
    result.roc.push_back({.pfa = pfa, .threshold = detection_threshold(settings.detector, pfa)});
  add_theory(point, settings.detector, result);
  std::uint64_t clipped = 0;
  for (std::uint32_t number = 0; number < settings.trials; ++number) {
    const PresencePoint::Trial trial = point.trial(number);
    clipped += trial.clipped;
    count(trial, result.roc);
  }
  for (RocPoint& roc : result.roc) {
    roc.false_alarm = share(roc.false_alarms, settings.trials, settings.level);
    roc.detection = share(roc.detections, settings.trials, settings.level);
  }
  result.noise_v = point.deviation();
  result.noise_over_step = result.noise_v / channel::adc_step(settings.meter);
  result.clipped = ratio(clipped, settings.trials * point.samples_drawn());
  return result;
}

}  // namespace sim
