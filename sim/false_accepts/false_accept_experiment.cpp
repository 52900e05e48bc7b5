#include "sim/false_accepts/false_accept_experiment.hpp"

#include <fmt/format.h>

#include "channel/instruction_set.hpp"
#include "sim/counting/event_rate.hpp"
#include "sim/failure.hpp"
#include "sim/false_accepts/false_accept_keys.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/source_locations.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

constexpr double ci_level = 0.95;

void describe_false_accepts(FalseAcceptPoint& point, const FalseAcceptSetup& setup,
                            const FalseAcceptTally& tally) {
  point.operating = setup.link.operating;
  point.validity_flags = setup.link.validity_flags;
  point.hours = hours_of(setup, tally.n_runs);
  point.tally = tally;
}

/// Of what a point's other lights have, `listening.air` has the defaults: these may be too fast.
void check_air(const Scenario& scenario, const SourceLocations& places) {
  const double rate = scenario.simulation.sample_rate_hz;
  for (const auto& [name, d] : with_air(scenario).disturbances)
    if (is_keyed(d) && rate < 4 * d.carrier_hz)
      throw bad_input(
          fmt::format("listening.air = \"{}\" {} with simulation.sample_rate_hz = {} {}",
                      scenario.settings.of<FalseAcceptSettings>().air,
                      place_of(places, "listening.air"), rate,
                      place_of(places, "simulation.sample_rate_hz")),
          "a carrier period takes at least 4 samples",
          fmt::format("raise simulation.sample_rate_hz to {}", 4 * d.carrier_hz));
}

Estimate false_rate(const FalseAcceptTally& tally, double hours, double level) {
  return event_rate({tally.n_runs, tally.n_frames_false, tally.false_squared}, hours, level);
}

}  // namespace

Estimate FalseAcceptPoint::false_per_hour() const { return false_rate(tally, hours, ci_level); }

Estimate FalseAcceptPoint::undetected_per_hour() const {
  return event_rate({tally.n_runs, tally.n_frames_undetected, tally.undetected_squared},
                    tally.n_frames == 0 ? 0 : hours, ci_level);
}

void check_false_accepts(const LoadedScenario& scenario) {
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i) {
    const Scenario point = point_scenario(scenario, point_coordinates(scenario.sweep, i));
    check_receiver_module(point, scenario.places);
    check_air(point, scenario.places);
  }
}

constinit const Measurement<FalseAcceptSetup, FalseAcceptTally, FalseAcceptPoint>
    false_accept_measurement{
        .unreached =
            [](const Scenario&, const SourceLocations&, const std::vector<double>& coordinates) {
              return FalseAcceptPoint{.coordinates = coordinates};
            },
        .prepare = [](const Scenario& s, const SourceLocations&,
                      const Workers&) { return make_false_accepts(s); },
        .most_at_once = [](const FalseAcceptSetup&, std::uint32_t,
                           int) { return static_cast<std::uint32_t>(channel::trials_at_once()); },
        .run = run_false_accepts,
        .ratio =
            [](const FalseAcceptSetup& setup, const FalseAcceptTally& tally, double level) {
              return false_rate(tally, hours_of(setup, tally.n_runs), level);
            },
        .describe = describe_false_accepts,
        .fits = [](const FalseAcceptSetup&, const FalseAcceptTally& tally,
                   std::uint32_t n) { return tally.n_runs == n; }};

}  // namespace sim
