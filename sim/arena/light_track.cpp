#include "sim/arena/light_track.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "channel/geometry.hpp"
#include "sim/link/link.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {
namespace {

using dsp::Seconds;

/// A sender's light at the module, wherever that is.
class LightField {
 public:
  LightField(const Scenario& s, const Sender& sender)
      : scenario_(s),
        sender_(sender),
        even_(s.floor),
        // mW/sr, so that light comes out in mW/m2.
        axial_(channel::axial_intensity(sender.emitter, sender.current, s.led.temperature_c) *
               (1e3 * colour_response(s.module, sender.emitter, s.led.temperature_c))),
        directivity_{.relative_distance = s.module.directivity,
                     .vertical = s.module.directivity_vertical} {
    even_.diffuse_reflectance = 0;
  }

  /// mW/m2 by the direct ray and the floor's image.
  double mirrored(const Pose2D& place) const {
    return sum(place, even_, [](const channel::ReceivedLight& light) { return light.total(); });
  }

  /// mW/m2 that the floor scatters.
  double scattered(const Pose2D& place) const {
    return sum(place, scenario_.floor,
               [](const channel::ReceivedLight& light) { return light.diffuse; });
  }

 private:
  /// Bodies keep LED and module apart by this much along the floor.
  static constexpr double nearest_m = 0.03;

  Pose2D kept_apart(Pose2D place) const {
    const double dx = place.x - sender_.x_m, dy = place.y - sender_.y_m;
    const double distance = std::hypot(dx, dy);
    if (distance >= nearest_m) return place;
    place.x = sender_.x_m + nearest_m * (distance > 0 ? dx / distance : 1);
    place.y = sender_.y_m + nearest_m * (distance > 0 ? dy / distance : 0);
    return place;
  }

  template <class Part>
  double sum(const Pose2D& wanted, const channel::Floor& floor, Part part) const {
    const Pose2D place = kept_apart(wanted);
    const channel::Pose receiver{.x = place.x,
                                 .y = place.y,
                                 .z = scenario_.receiver.height_mm * 1e-3,
                                 .yaw = place.heading + dsp::degrees(scenario_.receiver.yaw_deg),
                                 .elevation = dsp::degrees(scenario_.receiver.tilt_deg)};
    double all = 0;
    for (int i = 0; i < sender_.leds; ++i)
      all += part(channel::received_light(sender_.emitter, axial_, led(i), directivity_, receiver,
                                          floor, scenario_.led.temperature_c))
                 .value;
    return all;
  }

  channel::Pose led(int i) const {
    const double turn = 2 * std::numbers::pi * i / sender_.leds;
    return {.x = sender_.x_m,
            .y = sender_.y_m,
            .z = sender_.height_m,
            .yaw = sender_.yaw + dsp::Radians(turn),
            .elevation = dsp::degrees(scenario_.led.elevation_deg)};
  }

  const Scenario& scenario_;
  const Sender& sender_;
  channel::Floor even_;  // without what it scatters
  dsp::WattsPerSteradian axial_;
  channel::Directivity directivity_;
};

/// Adds scattered light to a track of mirrored light.
class ScatterFill {
 public:
  ScatterFill(const LightField& field, const Trajectory& way, LightTrack& track,
              const std::atomic<bool>* stop)
      : field_(field), way_(way), track_(track), stop_(stop) {}

  void fill() {
    const std::size_t last = track_.irradiance.size() - 1;
    const double first_light = at(0);
    fill_between(0, first_light, last, at(last));
    track_.irradiance.front() += static_cast<float>(first_light);
  }

 private:
  static constexpr double tolerance = 0.005;
  static constexpr double nothing_mw_per_m2 = 1e-4;  // a thousandth of what any module hears
  static constexpr std::size_t farthest = 128;       // steps between two places at most

  double at(std::size_t i) const {
    return field_.scattered(way_.at(static_cast<double>(i) * track_.step));
  }

  /// Fills (from, to], both ends of which are known.
  void fill_between(std::size_t from, double light_from, std::size_t to, double light_to) {
    if (to - from > 1 && !is_stopped(stop_)) {
      const std::size_t middle = (from + to) / 2;
      const double light = at(middle);
      const double share = static_cast<double>(middle - from) / static_cast<double>(to - from);
      const double error = std::abs(light_from + share * (light_to - light_from) - light);
      const double all = track_.irradiance[middle] + light;
      if (to - from > farthest || error > tolerance * all + nothing_mw_per_m2) {
        fill_between(from, light_from, middle, light);
        return fill_between(middle, light, to, light_to);
      }
    }
    for (std::size_t i = from + 1; i <= to; ++i) {
      const double share = static_cast<double>(i - from) / static_cast<double>(to - from);
      track_.irradiance[i] += static_cast<float>(light_from + share * (light_to - light_from));
    }
  }

  const LightField& field_;
  const Trajectory& way_;
  LightTrack& track_;
  const std::atomic<bool>* stop_;
};

}  // namespace

double LightTrack::at(Seconds t) const {
  const double place = std::clamp(t / step, 0.0, static_cast<double>(irradiance.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(place), irradiance.size() - 1);
  const std::size_t next = std::min(i + 1, irradiance.size() - 1);
  return std::lerp(irradiance[i], irradiance[next], place - static_cast<double>(i));
}

double LightTrack::highest() const { return *std::ranges::max_element(irradiance); }

double LightTrack::mean() const {
  return std::accumulate(irradiance.begin(), irradiance.end(), 0.0) /
         static_cast<double>(irradiance.size());
}

LightTrack light_track(const Scenario& scenario, const Sender& sender, const Trajectory& way,
                       Seconds end, Seconds step, const std::atomic<bool>* stop) {
  const LightField field(scenario, sender);
  LightTrack track{step, {}};
  if (way.duration() == Seconds(0)) {
    const Pose2D place = way.at(Seconds(0));
    track.irradiance = {static_cast<float>(field.mirrored(place) + field.scattered(place))};
    return track;
  }
  const auto steps = static_cast<std::size_t>(std::ceil(end / step)) + 2;
  for (std::size_t i = 0; i < steps && !is_stopped(stop); ++i)
    track.irradiance.push_back(
        static_cast<float>(field.mirrored(way.at(static_cast<double>(i) * step))));
  if (!is_stopped(stop)) ScatterFill(field, way, track, stop).fill();
  return track;
}

}  // namespace sim
