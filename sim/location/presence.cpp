#include "sim/location/presence.hpp"

#include <algorithm>
#include <cmath>

#include "sim/location/presence_point.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {
namespace {

/// Windows over which the closed form is averaged.
constexpr int theory_windows = 512;

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

}  // namespace

PresenceTally& PresenceTally::operator+=(const PresenceTally& other) {
  trials += other.trials;
  false_alarms.resize(std::max(false_alarms.size(), other.false_alarms.size()));
  detections.resize(false_alarms.size());
  for (std::size_t i = 0; i < other.false_alarms.size(); ++i) {
    false_alarms[i] += other.false_alarms[i];
    detections[i] += other.detections[i];
  }
  clipped += other.clipped;
  return *this;
}

PresenceBench::PresenceBench(const PresenceSettings& settings)
    : level_(settings.level),
      point_(std::make_shared<PresencePoint>(settings)),
      uncounted_{.roc = thresholds(settings)} {
  add_theory(*point_, settings.detector, uncounted_);
  uncounted_.noise_v = point_->deviation();
  uncounted_.noise_over_step = uncounted_.noise_v / channel::adc_step(settings.meter);
}

PresenceTally PresenceBench::no_trials() const {
  const std::vector<std::uint64_t> none(uncounted_.roc.size());
  return {.false_alarms = none, .detections = none};
}

void PresenceBench::count(std::uint32_t number, PresenceTally& tally) const {
  const PresencePoint::Trial trial = point_->trial(number);
  for (std::size_t i = 0; i < uncounted_.roc.size(); ++i) {
    tally.false_alarms[i] += trial.without > uncounted_.roc[i].threshold ? 1 : 0;
    tally.detections[i] += trial.with > uncounted_.roc[i].threshold ? 1 : 0;
  }
  tally.clipped += trial.clipped;
  ++tally.trials;
}

PresenceResult PresenceBench::result(const PresenceTally& tally) const {
  PresenceResult result = uncounted_;
  result.trials = tally.trials;
  for (std::size_t i = 0; i < result.roc.size(); ++i) {
    RocPoint& roc = result.roc[i];
    roc.false_alarms = tally.false_alarms[i];
    roc.detections = tally.detections[i];
    roc.false_alarm = share(roc.false_alarms, result.trials, level_);
    roc.detection = share(roc.detections, result.trials, level_);
  }
  result.clipped = ratio(tally.clipped, result.trials * point_->samples_drawn());
  return result;
}

Estimate detection(const PresenceTally& tally, double level) {
  return share(tally.detections.front(), tally.trials, level);
}

PresenceTally run_presence(const PresenceBench& bench, std::uint32_t first, int n,
                           const std::atomic<bool>* stop) {
  PresenceTally tally = bench.no_trials();
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n) && !is_stopped(stop); ++i)
    bench.count(first + i, tally);
  return tally;
}

PresenceResult measure_presence(const PresenceSettings& settings) {
  const PresenceBench bench(settings);
  return bench.result(run_presence(bench, 0, static_cast<int>(settings.trials)));
}

void check_presence(const PresenceSettings& settings) { const PresencePoint point(settings); }

}  // namespace sim
