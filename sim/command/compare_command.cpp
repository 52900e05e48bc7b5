// `cosys-sim compare`: which decoder loses least?
#include "sim/check/contest.hpp"
#include "sim/check/program_decoder.hpp"
#include "sim/command/commands.hpp"
#include "sim/command/judging.hpp"
#include "sim/engine/engine.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/threads/stop_signals.hpp"

namespace sim {
namespace {

std::vector<std::unique_ptr<Decoder>> decoders_of(const CompareRequest& request) {
  std::vector<std::unique_ptr<Decoder>> decoders;
  for (const std::string& name : request.decoders.empty() ? built_in_decoders() : request.decoders)
    decoders.push_back(make_decoder(name, request.program_settings));
  return decoders;
}

bool any_failed(const std::vector<ContestPoint>& points) {
  for (const ContestPoint& point : points)
    for (const auto& fault : point.faults)
      if (fault) return true;
  return false;
}

}  // namespace

ExitCode compare_command(const CompareRequest& request) {
  const auto points = judged_points(load_links(request.scenarios, request.options, "compare"));
  const auto owned = decoders_of(request);
  std::vector<const Decoder*> decoders;
  for (const auto& decoder : owned) decoders.push_back(decoder.get());
  const Workers workers{.threads = threads_for(request.threads), .interrupt = &heed_stop_signals()};
  std::vector<ContestPoint> contests;
  for (const JudgedPoint& point : points) {
    contests.push_back(contest(point, decoders, static_cast<std::uint32_t>(point.frames), workers));
    if (workers.interrupted()) return end_interrupted();
    show_progress(request.quiet, "compare", contests.size(), points.size());
  }
  decide(contests, request.alpha);
  const ContestReport report{contests, decoders, request.alpha};
  print(request.json ? contest_json(report) : contest_text(report));
  return any_failed(contests) ? ExitCode::check_failed : ExitCode::done;
}

}  // namespace sim
