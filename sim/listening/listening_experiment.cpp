#include "sim/listening/listening_experiment.hpp"

#include <fmt/format.h>

#include "channel/instruction_set.hpp"
#include "sim/counting/event_rate.hpp"
#include "sim/failure.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/listening/listening.hpp"
#include "sim/scenario/places.hpp"

namespace sim {
namespace {

constexpr double ci_level = 0.95;

ListeningPoint run_point(const Scenario& scenario, const std::vector<double>& coordinates,
                         const Workers& workers) {
  if (workers.interrupted()) return {coordinates};
  const Listening listening = make_listening(scenario);
  ListeningPoint point{.coordinates = coordinates,
                       .operating = listening.judged.link.operating,
                       .outside = listening.judged.link.outside};
  RunSharing<ListeningTally> sharing(
      {.runs = static_cast<std::uint32_t>(scenario.listening.runs),
       .most_at_once = static_cast<std::uint32_t>(channel::trials_at_once()),
       .workers = workers},
      [&](std::uint32_t first, int n) {
        return run_listening(listening, first, n, workers.interrupt);
      });
  for (const ListeningTally& lot : sharing()) point.tally += lot;
  point.hours = hours_of(listening, point.tally.n_runs);
  return point;
}

/// Of what a point's other lights have, `listening.air` has the defaults: these may be too fast.
void check_air(const Scenario& scenario, const Places& places) {
  const double rate = scenario.simulation.sample_rate_hz;
  for (const auto& [name, d] : with_air(scenario).disturbances)
    if (is_keyed(d) && rate < 4 * d.carrier_hz)
      throw bad_input(
          fmt::format("listening.air = \"{}\" {} with simulation.sample_rate_hz = {} {}",
                      scenario.listening.air, place_of(places, "listening.air"), rate,
                      place_of(places, "simulation.sample_rate_hz")),
          "a carrier period takes at least 4 samples",
          fmt::format("raise simulation.sample_rate_hz to {}", 4 * d.carrier_hz));
}

}  // namespace

Estimate ListeningPoint::false_per_hour() const {
  return event_rate({tally.n_runs, tally.n_frames_false, tally.false_squared}, hours, ci_level);
}

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

std::vector<ListeningPoint> run_listenings(const LoadedScenario& scenario, const Workers& workers,
                                           const OnPoint<ListeningPoint>& on_point) {
  return run_points<ListeningPoint>(scenario, workers, on_point, run_point);
}

}  // namespace sim
