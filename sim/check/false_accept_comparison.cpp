#include "sim/check/false_accept_comparison.hpp"

#include <limits>

#include "channel/instruction_set.hpp"
#include "sim/check/judged_point.hpp"
#include "sim/counting/event_rate.hpp"
#include "sim/false_accepts/false_accept_keys.hpp"
#include "sim/false_accepts/false_accepts.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

constexpr double comparison_ci_level = 0.95;

using AcceptsOfDecoders = std::vector<Accepts>;

DecoderFault lost_markers() {
  return {.kind = DecoderFault::Kind::garbage,
          .what = "it lost an undisturbed message before or behind a run",
          .words = {}};
}

Accepts accepts_of(const FalseAcceptSetup& setup, const Decoder& decoder,
                   const DelimitedStream& line) {
  const Decoded decoded = decoder.decode(line);
  if (decoded.fault) return {.fault = decoded.fault};
  const auto accepted = accepted_between_markers(decoded.accepted, line.first);
  if (!accepted) return {.fault = lost_markers()};
  Accepts accepts{.n_runs = 1};
  for (const std::string& message : *accepted) {
    const bool sent = setup.device_sends && message == setup.link.message;
    ++(sent ? accepts.n_ok : accepts.n_wrong);
  }
  accepts.wrong_squared = accepts.n_wrong * accepts.n_wrong;
  return accepts;
}

AcceptsOfDecoders accepts_of_all(const FalseAcceptSetup& setup, dsp::Hertz baud,
                                 const Decoders& decoders, std::uint32_t first, int n,
                                 const std::atomic<bool>* stop) {
  const JudgedLink judged{setup.link, baud};
  const HeardTrials heard = hear_runs(setup, first, n, stop);
  AcceptsOfDecoders all(decoders.size());
  for (std::size_t i = 0; i < heard.pins.size() && !is_stopped(stop); ++i) {
    const DelimitedStream line = mark(judged, first + static_cast<std::uint32_t>(i), heard.pins[i]);
    for (std::size_t d = 0; d < decoders.size(); ++d)
      all[d] += accepts_of(setup, *decoders[d], line);
  }
  return all;
}

}  // namespace

Accepts& Accepts::operator+=(const Accepts& other) {
  n_runs += other.n_runs;
  n_ok += other.n_ok;
  n_wrong += other.n_wrong;
  wrong_squared += other.wrong_squared;
  if (!fault) fault = other.fault;
  return *this;
}

Estimate FalseAcceptComparisonPoint::wrong_per_hour(std::size_t decoder) const {
  const Accepts& of = accepts[decoder];
  const double hours = of.fault ? 0 : static_cast<double>(of.n_runs) * hours_of_a_run;
  return event_rate({of.n_runs, of.n_wrong, of.wrong_squared}, hours, comparison_ci_level);
}

FalseAcceptComparisonPoint false_accept_comparison(const LoadedScenario& scenario,
                                                   std::size_t point, const Decoders& decoders,
                                                   const Workers& workers) {
  const std::vector<double> coordinates = point_coordinates(scenario.sweep, point);
  const Scenario at = point_scenario(scenario, coordinates);
  refuse_marker(scenario, at.device.message);
  const FalseAcceptSetup setup = make_false_accepts(at);
  ParallelRuns<AcceptsOfDecoders> parallel(
      {.runs = static_cast<std::uint32_t>(at.settings.of<FalseAcceptSettings>().runs),
       .most_at_once = static_cast<std::uint32_t>(channel::trials_at_once()),
       .workers = workers},
      [&](std::uint32_t first, int n, const std::atomic<bool>* over) {
        return accepts_of_all(setup, dsp::Hertz(at.device.baud), decoders, first, n, over);
      });
  FalseAcceptComparisonPoint result{.name = point_name(scenario, coordinates),
                                    .hours_of_a_run = hours_of(setup, 1),
                                    .accepts = AcceptsOfDecoders(decoders.size())};
  for (const AcceptsOfDecoders& batch : parallel())
    for (std::size_t d = 0; d < batch.size(); ++d) result.accepts[d] += batch[d];
  return result;
}

}  // namespace sim
