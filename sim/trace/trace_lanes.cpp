#include "sim/trace/trace_lanes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sim {
namespace {

constexpr int values_a_cycle = 8;

/// Each sample is the mean of its period.
SampledWave wave_of(const TracedTrial& trial, const std::vector<float>& samples) {
  const double period_s = 1 / trial.sample_rate.value;
  return {samples, period_s / 2, period_s};
}

/// Makes room for a curve.
void cover(Lane& lane, std::span<const float> samples) {
  const auto [least, greatest] = std::ranges::minmax(samples);
  lane.least = std::min(lane.least, double{least});
  lane.greatest = std::max(lane.greatest, double{greatest});
}

/// Where all is level, as of an integrator that nothing moves, there is room all the same.
void settle(Lane& lane) {
  if (!(lane.greatest > lane.least)) lane.greatest = lane.least + 1;
}

struct TapCurve {
  std::vector<float> channel::Recording::*samples;
  const char* style;
};

struct TapLane {
  std::vector<std::string> names;
  std::vector<TapCurve> curves;
};

std::vector<TapLane> lanes_behind_light() {
  using channel::Recording;
  return {{{"band-pass", "threshold: thick", "mW/m2"},
           {{&Recording::band_pass, "curve3"}, {&Recording::threshold, "threshold"}}},
          {{"integrator", "samples"}, {{&Recording::integrator, "curve4"}}},
          {{"threshold raised", "by slow AGC", "factor"}, {{&Recording::agc_gain, "curve6"}}}};
}

}  // namespace

std::vector<float> keyed_light(const TracedTrial& trial) {
  if (!trial.taps.irradiance.empty()) return {};
  const double period_s = 1 / (trial.carrier.value * values_a_cycle);
  const auto count = static_cast<std::size_t>(trial.tx.end().value / period_s);
  std::vector<float> light;
  dsp::TraceReader tx(trial.tx);
  for (std::size_t i = 0; i < count; ++i) {
    const bool dark = tx.level_at(dsp::Seconds(static_cast<double>(i) * period_s));
    light.push_back(!dark && i % values_a_cycle < values_a_cycle / 2 ? 1 : 0);
  }
  return light;
}

Lane light_lane(const TracedTrial& trial, const std::vector<float>& keyed) {
  const std::vector<float>& samples = trial.taps.irradiance;
  if (samples.empty())
    return {.names = {"light", "as keyed"},
            .is_measured = false,
            .curves = {{{keyed, 0, 1 / (trial.carrier.value * values_a_cycle)}, "light"}}};
  Lane lane{.names = {"light"}, .greatest = 0, .curves = {{wave_of(trial, samples), "light"}}};
  cover(lane, samples);
  lane.names.push_back(fmt::format("to {:.3g} mW/m2", lane.greatest));
  lane.names.emplace_back("noise included");
  settle(lane);
  return lane;
}

std::vector<Lane> tap_lanes(const TracedTrial& trial) {
  std::vector<Lane> lanes;
  for (const TapLane& each : lanes_behind_light()) {
    Lane lane{.names = each.names, .greatest = 0};
    for (const TapCurve& curve : each.curves) {
      const std::vector<float>& samples = trial.taps.*curve.samples;
      if (!tells_something(trial, curve.samples)) continue;
      cover(lane, samples);
      lane.curves.push_back({wave_of(trial, samples), curve.style});
    }
    settle(lane);
    if (!lane.curves.empty()) lanes.push_back(std::move(lane));
  }
  return lanes;
}

}  // namespace sim
