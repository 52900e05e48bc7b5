// `cosys-sim compare`: which decoder loses least, or accepts least of what was not sent?
#include <algorithm>

#include "sim/check/decoder_comparison.hpp"
#include "sim/check/false_accept_comparison.hpp"
#include "sim/check/program_decoder.hpp"
#include "sim/command/commands.hpp"
#include "sim/command/judging.hpp"
#include "sim/failure.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/threads/stop_signals.hpp"
#include "sim/threads/worker_threads.hpp"

namespace sim {
namespace {

std::vector<std::unique_ptr<Decoder>> decoders_of(const CompareRequest& request) {
  std::vector<std::unique_ptr<Decoder>> decoders;
  for (const std::string& name : request.decoders.empty() ? built_in_decoders() : request.decoders)
    decoders.push_back(make_decoder(name, request.program_settings));
  return decoders;
}

bool any_failed(const std::vector<DecoderComparisonPoint>& points) {
  for (const DecoderComparisonPoint& point : points)
    for (const auto& fault : point.faults)
      if (fault) return true;
  return false;
}

bool any_failed(const std::vector<FalseAcceptComparisonPoint>& points) {
  for (const FalseAcceptComparisonPoint& point : points)
    for (const Accepts& accepts : point.accepts)
      if (accepts.fault) return true;
  return false;
}

bool listens(const LoadedScenario& scenario) { return scenario.base.experiment == "listening"; }

ExitCode print_and_end(const std::string& text, bool failed) {
  print(text);
  return failed ? ExitCode::check_failed : ExitCode::done;
}

/// Which decoder loses least.
ExitCode compare_losses(const CompareRequest& request, const std::vector<JudgedPoint>& points,
                        const Decoders& decoders, const Workers& workers) {
  std::vector<DecoderComparisonPoint> comparisons;
  for (const JudgedPoint& point : points) {
    comparisons.push_back(
        compare_decoders(point, decoders, static_cast<std::uint32_t>(point.frames), workers));
    if (workers.interrupted()) return end_interrupted();
    show_progress(request.quiet, "compare", comparisons.size(), points.size());
  }
  decide(comparisons, request.alpha);
  const DecoderComparisonReport report{comparisons, decoders, request.alpha};
  return print_and_end(
      request.json ? decoder_comparison_json(report) : decoder_comparison_text(report),
      any_failed(comparisons));
}

/// Which decoder accepts what was not sent.
ExitCode compare_accepts(const CompareRequest& request,
                         const std::vector<LoadedScenario>& scenarios, const Decoders& decoders,
                         const Workers& workers) {
  std::vector<FalseAcceptComparisonPoint> comparisons;
  std::size_t all = 0;
  for (const LoadedScenario& scenario : scenarios) all += count_points(scenario.sweep);
  for (const LoadedScenario& scenario : scenarios)
    for (std::size_t i = 0; i < count_points(scenario.sweep); ++i) {
      comparisons.push_back(false_accept_comparison(scenario, i, decoders, workers));
      if (workers.interrupted()) return end_interrupted();
      show_progress(request.quiet, "compare", comparisons.size(), all);
    }
  return print_and_end(request.json ? false_accept_comparison_json(comparisons, decoders)
                                    : false_accept_comparison_text(comparisons, decoders),
                       any_failed(comparisons));
}

/// Whether all of them listen. Throws where only some do.
bool all_listen(const std::vector<LoadedScenario>& scenarios) {
  const auto one = std::ranges::find_if(scenarios, listens);
  if (one == scenarios.end()) return false;
  if (!std::ranges::all_of(scenarios, listens))
    throw bad_input(one->path.string(), "it listens, and not all others do",
                    "compare on it in a command of its own");
  return true;
}

}  // namespace

ExitCode compare_command(const CompareRequest& request) {
  std::vector<LoadedScenario> scenarios;
  for (const auto& path : request.scenarios) scenarios.push_back(load_with(request.options, path));
  const bool setup = all_listen(scenarios);
  if (!setup)
    for (const LoadedScenario& scenario : scenarios) refuse_other_than_link(scenario, "compare");
  const auto points = setup ? std::vector<JudgedPoint>{} : judged_points(scenarios);
  const auto owned = decoders_of(request);
  Decoders decoders;
  for (const auto& decoder : owned) decoders.push_back(decoder.get());
  const Workers workers{.threads = threads_for(request.threads), .interrupt = &heed_stop_signals()};
  return setup ? compare_accepts(request, scenarios, decoders, workers)
               : compare_losses(request, points, decoders, workers);
}

}  // namespace sim
