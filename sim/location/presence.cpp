#include "sim/location/presence.hpp"

#include <cmath>

#include "sim/location/presence_point.hpp"

namespace sim {
namespace {

/// Windows over which the closed form is averaged.
constexpr int theory_windows = 512;

/// What some trials gave, by the points of the ROC.
struct Counts {
  std::vector<std::uint64_t> false_alarms, detections;
  std::uint64_t clipped = 0;
  std::uint32_t trials = 0;

  void add(const PresencePoint::Trial& trial, const std::vector<RocPoint>& roc) {
    false_alarms.resize(roc.size());
    detections.resize(roc.size());
    for (std::size_t i = 0; i < roc.size(); ++i) {
      false_alarms[i] += trial.without > roc[i].threshold ? 1 : 0;
      detections[i] += trial.with > roc[i].threshold ? 1 : 0;
    }
    clipped += trial.clipped;
    ++trials;
  }
};

/// Worth nothing after an interrupt.
Counts count(const PresencePoint& point, const std::vector<RocPoint>& roc, std::uint32_t first,
             int n, const Workers& workers) {
  Counts counts;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n) && !workers.interrupted(); ++i)
    counts.add(point.trial(first + i), roc);
  return counts;
}

std::vector<RocPoint> thresholds(const PresenceSettings& settings) {
  std::vector<RocPoint> roc;
  for (const double pfa : settings.pfa)
    roc.push_back({.pfa = pfa, .threshold = detection_threshold(settings.detector, pfa)});
  return roc;
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

void add_counts(const std::vector<Counts>& lots, double level, std::uint64_t samples_a_trial,
                PresenceResult& result) {
  std::uint64_t clipped = 0;
  for (const Counts& lot : lots) {
    for (std::size_t i = 0; i < result.roc.size(); ++i) {
      result.roc[i].false_alarms += lot.false_alarms[i];
      result.roc[i].detections += lot.detections[i];
    }
    clipped += lot.clipped;
    result.trials += lot.trials;
  }
  for (RocPoint& roc : result.roc) {
    roc.false_alarm = share(roc.false_alarms, result.trials, level);
    roc.detection = share(roc.detections, result.trials, level);
  }
  result.clipped = ratio(clipped, result.trials * samples_a_trial);
}

}  // namespace

std::optional<PresenceResult> measure_presence(const PresenceSettings& settings,
                                               const Workers& workers) {
  const PresencePoint point(settings);
  PresenceResult result{.roc = thresholds(settings)};
  RunSharing<Counts> trials(
      shared_trials(settings.trials, workers),
      [&](std::uint32_t first, int n) { return count(point, result.roc, first, n, workers); });
  add_counts(trials(), settings.level, point.samples_drawn(), result);
  if (result.trials == 0 && workers.interrupted()) return std::nullopt;
  add_theory(point, settings.detector, result);
  result.noise_v = point.deviation();
  result.noise_over_step = result.noise_v / channel::adc_step(settings.meter);
  return result;
}

PresenceResult measure_presence(const PresenceSettings& settings) {
  return measure_presence(settings, {}).value();
}

void check_presence(const PresenceSettings& settings) { const PresencePoint point(settings); }

}  // namespace sim
