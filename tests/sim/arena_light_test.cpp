// Light in arenas: a lone device is a link, and along a way the light is that of the geometry.
#include <cmath>
#include <random>

#include "arena_scenes.hpp"
#include "channel/geometry.hpp"
#include "gtest/gtest.h"
#include "sim/arena/light_track.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

using dsp::Seconds;

/// Of a link and of the arena with the same device at the same place.
TEST(ArenaLight, ALoneDeviceIsALink) {
  for (const char* metres : {"0.5", "2", "13"}) {
    std::vector<std::string> set{"led.height_mm=20", "floor.part=tile", "led.current_ma=70",
                                 "receiver.temperature_c=40"};
    const Arena arena = arena_of(device("a", metres), set);
    set.insert(set.end(), {"receiver.module=TSSP4056", std::string("receiver.range_m=") + metres});
    const double expected = link_of(set).operating.irradiance_mw_per_m2;
    ASSERT_EQ(arena.light.front().irradiance.size(), 1u);
    EXPECT_NEAR(arena.light.front().highest() / expected, 1, 1e-6) << metres;
  }
}

// In any direction: bearing and the receiver's own yaw against place and heading.
TEST(ArenaLight, ADeviceAsideIsALinkAside) {
  const double expected =
      link_of({"receiver.module=TSSP4056", "receiver.range_m=2", "receiver.bearing_deg=30",
               "receiver.yaw_deg=20", "receiver.tilt_deg=10"})
          .operating.irradiance_mw_per_m2;
  // The device at (1, -3) looks along y, the receiver is 2 m away, 30 degrees to the left of that.
  const Arena arena = arena_of(
      "tilt_deg = 10\nyaw_deg = 20\n[path]\nx_m = 0\ny_m = -1.2679491924311228\n"
      "heading_deg = -60\n[devices.a]\nx_m = 1\ny_m = -3\nyaw_deg = 90\n");
  EXPECT_NEAR(arena.light.front().highest() / expected, 1, 1e-6);
}

/// Messages of a link that loses about half of them, each with its own warm-up.
Tally link_at_its_limit(const std::vector<std::string>& set) {
  const Link link = link_of(set);
  Tally tally;
  for (const GroupResult& group : run_groups(link, 0, 400)) tally += group.tally;
  return tally;
}

TEST(ArenaLight, MeasuredALoneDeviceIsLostAsOftenAsOnALink) {
  for (const char* metres : {"12.35", "12.45"}) {
    const Tally link =
        link_at_its_limit({"receiver.module=TSSP4056", "simulation.warmup_messages=1",
                           std::string("receiver.range_m=") + metres});
    const ArenaPoint point =
        arena_point("[arena]\nduration_s = 10\nruns = 32\n" + device("a", metres));
    const SenderTally& tally = point.tally.senders.front();
    const double p = static_cast<double>(link.n_frames_lost) / static_cast<double>(link.n_frames);
    const double q = static_cast<double>(tally.lost()) / static_cast<double>(tally.sent());
    const double deviation = std::sqrt(p * (1 - p) / static_cast<double>(link.n_frames) +
                                       q * (1 - q) / static_cast<double>(tally.sent()));
    EXPECT_GT(p, 0.05);
    EXPECT_LT(p, 0.95);
    EXPECT_NEAR(q, p, 2.576 * deviation) << metres;  // 99 %
  }
}

// ---- along a way ----

/// Total light of a sender at a place, straight from the geometry.
double light_at(const Scenario& s, const Sender& sender, const Pose2D& place) {
  const auto axial = channel::axial_intensity(sender.emitter, sender.current, s.led.temperature_c);
  const channel::Pose receiver{.x = place.x,
                               .y = place.y,
                               .z = s.receiver.height_mm * 1e-3,
                               .yaw = place.heading + dsp::degrees(s.receiver.yaw_deg),
                               .elevation = dsp::degrees(s.receiver.tilt_deg)};
  double sum = 0;
  for (int i = 0; i < sender.leds; ++i) {
    const channel::Pose led{.x = sender.x_m,
                            .y = sender.y_m,
                            .z = sender.height_m,
                            .yaw = sender.yaw + dsp::degrees(360.0 * i / sender.leds),
                            .elevation = dsp::degrees(s.led.elevation_deg)};
    sum += channel::received_light(sender.emitter, axial, led,
                                   {.relative_distance = s.module.directivity,
                                    .vertical = s.module.directivity_vertical},
                                   receiver, s.floor, s.led.temperature_c)
               .total()
               .value;
  }
  return sum * 1e3 * colour_response(s.module, sender.emitter, s.led.temperature_c);
}

const std::string drive_past =
    "[path]\nx_m = [0, 3, 3, 0]\ny_m = [0, 0, 1, 1]\nspeed_m_per_s = 0.5\n"
    "[devices.a]\nx_m = 1.5\ny_m = 0.4\nyaw_deg = -70\n"
    "[devices.b]\nx_m = -1\ny_m = 0.5\nleds = 3\nheight_mm = 60\n"
    "[devices.c]\nx_m = 4\ny_m = -1\nyaw_deg = 170\nled = \"TSAL6400\"\ncurrent_ma = 40\n";

TEST(LightTrack, MeasuredIsTheGeometrysAllAlongTheWay) {
  Scenario s = point_scenario(loaded_arena(drive_past, {"floor.part=concrete"}), {});
  s.module = module_of(s);
  const Trajectory way(s.path);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(0, way.duration().value + 1);
  for (const Sender& sender : make_senders(s)) {
    const Seconds step(4096 / 600e3);
    const LightTrack track = light_track(s, sender, way, way.duration() + Seconds(1), step);
    EXPECT_GE(static_cast<double>(track.irradiance.size() - 1) * step.value,
              way.duration().value + 1 + step.value);
    int bends = 0;
    for (int i = 0; i < 100; ++i) {
      const Seconds t(i == 0 ? 0 : u(random));
      const double expected = light_at(s, sender, way.at(t));
      // At corners of the way the light bends within a step; where nothing is heard, a thousandth
      // of what any module hears will do.
      const double bend = std::fabs(light_at(s, sender, way.at(t + step)) +
                                    light_at(s, sender, way.at(t - step)) - 2 * expected);
      ASSERT_NEAR(track.at(t), expected, 0.01 * expected + bend / 2 + 1e-4)
          << sender.name << " " << t.value;
      bends += bend > 0.01 * expected;
    }
    EXPECT_LT(bends, 12);
  }
}

TEST(LightTrack, EndsAndMiddlesAreThoseOfItsNumbers) {
  const LightTrack track{Seconds(0.5), {1, 3, 2}};
  EXPECT_EQ(track.at(Seconds(-1)), 1);
  EXPECT_EQ(track.at(Seconds(0.25)), 2);
  EXPECT_EQ(track.at(Seconds(0.75)), 2.5);
  EXPECT_EQ(track.at(Seconds(9)), 2);
  EXPECT_EQ(track.highest(), 3);
  EXPECT_EQ(track.mean(), 2);
}

// 30 mm: nobody drives through a device.
TEST(LightTrack, BodiesKeepLedAndModuleApart) {
  const auto light = [](const std::string& x) {
    return arena_of("[devices.a]\nx_m = " + x + "\nyaw_deg = 180\n").light.front().highest();
  };
  EXPECT_EQ(light("0.001"), light("0.03"));
  EXPECT_GT(light("0.03"), light("0.031"));
}

// All their light together raises the threshold, as the sun's does.
TEST(ArenaLight, TheMeanOfAllIsAmbientLight) {
  const std::string near = device("a", "0.1", "interval_min_ms = 0\ninterval_max_ms = 0") +
                           device("b", "0.2", "interval_min_ms = 100");
  const LoadedScenario scenario = loaded_arena(near);
  const Arena arena = make_arena(scenario.base);
  double mean = 0;
  for (std::size_t i = 0; i < 2; ++i)
    mean += mean_light(arena.senders[i]) * arena.light[i].highest() * 1e-3;
  EXPECT_GT(mean, 0.5);
  const channel::ModuleData module = module_of(scenario.base);
  const auto ambient = ambient_of(scenario.base) + dsp::WattsPerSquareMetre(mean);
  EXPECT_NEAR(arena.reach_mw_per_m2,
              channel::emin_in_ambient(module, ambient) / band_pass_gain(module, dsp::Hertz(59e3)),
              1e-6);
}

// Half of a message's data bits, its start bits, and half of each of their cycles are light.
TEST(ArenaLight, TheMeanIsThatOfWhatIsSent) {
  const Arena arena = arena_of(
      device("a", "1",
             "interval_min_ms = 500\ninterval_max_ms = 500\nsilent_every_s = 3\nsilent_for_s = 1"));
  const double frame = 17 * 10 / 600.0;
  EXPECT_NEAR(mean_load(arena.senders.front()), 0.75 * frame / (frame + 0.5), 1e-12);
  EXPECT_NEAR(mean_light(arena.senders.front()), 0.5 * 0.5 * 0.75 * frame / (frame + 0.5), 1e-12);
}

}  // namespace
}  // namespace sim
