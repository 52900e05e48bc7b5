#include "sim/listening/listening_experiment.hpp"

#include <fmt/format.h>

#include "channel/instruction_set.hpp"
#include "sim/counting/event_rate.hpp"
#include "sim/failure.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/listening/listening_keys.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/source_locations.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

constexpr double ci_level = 0.95;

void describe_listening(ListeningPoint& point, const Listening& listening,
                        const ListeningTally& tally) {
  point.operating = listening.link.operating;
  point.outside = listening.link.outside;
  point.hours = hours_of(listening, tally.n_runs);
  point.tally = tally;
}

/// Of what a point's other lights have, `listening.air` has the defaults: these may be too fast.
void check_air(const Scenario& scenario, const SourceLocations& places) {
  const double rate = scenario.simulation.sample_rate_hz;
  for (const auto& [name, d] : with_air(scenario).disturbances)
    if (is_keyed(d) && rate < 4 * d.carrier_hz)
      throw bad_input(
          fmt::format("listening.air = \"{}\" {} with simulation.sample_rate_hz = {} {}",
                      scenario.settings.of<ListeningSettings>().air,
                      place_of(places, "listening.air"), rate,
                      place_of(places, "simulation.sample_rate_hz")),
          "a carrier period takes at least 4 samples",
          fmt::format("raise simulation.sample_rate_hz to {}", 4 * d.carrier_hz));
}

Estimate false_rate(const ListeningTally& tally, double hours, double level) {
  return event_rate({tally.n_runs, tally.n_frames_false, tally.false_squared}, hours, level);
}

}  // namespace

Estimate ListeningPoint::false_per_hour() const { return false_rate(tally, hours, ci_level); }

Estimate ListeningPoint::undetected_per_hour() const {
  return event_rate({tally.n_runs, tally.n_frames_undetected, tally.undetected_squared},
                    tally.n_frames == 0 ? 0 : hours, ci_level);
}

void check_listening(const LoadedScenario& scenario) {
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i) {
    const Scenario point = point_scenario(scenario, point_coordinates(scenario.sweep, i));
    check_receiver_module(point, scenario.places);
    check_air(point, scenario.places);
  }
}

constinit const Measurement<Listening, ListeningTally, ListeningPoint> listening_measurement{
    .unreached =
        [](const Scenario&, const SourceLocations&, const std::vector<double>& coordinates) {
          return ListeningPoint{.coordinates = coordinates};
        },
    .prepare = [](const Scenario& s, const SourceLocations&,
                  const Workers&) { return make_listening(s); },
    .most_at_once = [](const Listening&, std::uint32_t,
                       int) { return static_cast<std::uint32_t>(channel::trials_at_once()); },
    .run = run_listening,
    .ratio =
        [](const Listening& listening, const ListeningTally& tally, double level) {
          return false_rate(tally, hours_of(listening, tally.n_runs), level);
        },
    .describe = describe_listening};

}  // namespace sim
