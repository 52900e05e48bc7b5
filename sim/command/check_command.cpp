// `cosys-sim check`: is a decoder still as good as its baseline?
#include <fmt/format.h>

#include <algorithm>

#include "sim/check/baseline.hpp"
#include "sim/check/check_report.hpp"
#include "sim/check/frame_trace.hpp"
#include "sim/check/gate_files.hpp"
#include "sim/check/minimise.hpp"
#include "sim/check/point_check.hpp"
#include "sim/check/program_decoder.hpp"
#include "sim/command/commands.hpp"
#include "sim/command/judging.hpp"
#include "sim/failure.hpp"
#include "sim/report/finished_result.hpp"
#include "sim/text/new_file.hpp"
#include "sim/text/row_table.hpp"
#include "sim/text/shell_text.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/threads/stop_signals.hpp"
#include "sim/threads/worker_threads.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

std::vector<JudgedPoint> points_of(const CheckRequest& request) {
  std::vector<JudgedPoint> points =
      judged_points(load_links(request.scenarios, request.options, "check"));
  if (!request.point) return points;
  std::erase_if(points, [&](const JudgedPoint& p) { return p.number != *request.point; });
  if (points.empty())
    throw bad_input(fmt::format("--point {}", *request.point), "no scenario has so many points",
                    "points are counted from 0");
  return points;
}

/// ` --key value`, as a shell takes it.
std::string option(const std::string& name, const std::string& value) {
  return " " + name + " " + shell_word(value);
}

std::string scenario_options(const ScenarioOptions& options) {
  std::string text;
  for (const std::string& change : options.overrides) text += option("--set", change);
  for (std::size_t i = 0; i + 1 < options.parts.size(); ++i)  // the last is the program's own
    text += option("--parts", options.parts[i].string());
  return text;
}

std::string repeated_options(const CheckRequest& request) {
  std::string text = option("--baseline", request.baseline.string());
  if (!request.decoder.empty()) text += option("--decoder", request.decoder);
  const ProgramSettings& program = request.program_settings;
  if (program.serves) text += " --decoder-mode serve";
  if (program.prints_frames) text += " --decoder-output frames";
  if (program.timeout != ProgramSettings().timeout)
    text += option("--decoder-timeout", fmt::format("{}s", program.timeout.count()));
  const std::pair<const char*, double SequentialTestRule::*> rules[] = {
      {"--worse-than", &SequentialTestRule::worse_than},
      {"--alpha", &SequentialTestRule::alpha},
      {"--power", &SequentialTestRule::power},
      {"--negligible", &SequentialTestRule::negligible}};
  for (const auto& [name, member] : rules)
    if (request.rule.*member != rule_of_checks.*member)
      text += option(name, fmt::format("{}", request.rule.*member));
  if (request.frames > 0) text += option("-n", std::to_string(request.frames));
  if (request.golden) text += " --golden";
  return text + scenario_options(request.options);
}

/// Throws for a file that a clone of the repository does not have.
void refuse_outside(const fs::path& path) {
  if (path.is_absolute() || path.lexically_normal().string().starts_with(".."))
    throw bad_input("--init with " + path.string(), "it is not in this repository",
                    "copy it here, and name it from here");
}

ExitCode write_gate(const CheckRequest& request) {
  std::string check = "cosys-sim check";
  for (const fs::path& scenario : request.scenarios) {
    refuse_outside(scenario);
    check += " " + shell_word(scenario.string());
  }
  refuse_outside(request.baseline);
  const std::vector<WholeFile> files =
      gate_files({check + repeated_options(request), build_command("."), request.program}, ".");
  for (const WholeFile& file : files)
    refuse_to_lose(file.place, {is_gate_file, "a workflow of cosys-sim check --init"});
  write_files(files);
  for (const WholeFile& file : files) print(file.place.string() + "\n");
  print(gate_hint(files));
  return ExitCode::done;
}

ExitCode exit_code(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return ExitCode::done;
    case Verdict::inconclusive:
      return ExitCode::inconclusive;
    case Verdict::worse:
    case Verdict::broken:
      break;
  }
  return ExitCode::check_failed;
}

std::vector<const BaselinePoint*> counterparts_of(const CheckRequest& request,
                                                  const Baseline& baseline,
                                                  const std::vector<JudgedPoint>& points) {
  std::vector<const BaselinePoint*> counterparts;
  for (const JudgedPoint& point : points)
    counterparts.push_back(&counterpart(baseline, point, request.baseline));
  return counterparts;
}

/// Fewer after an interrupt.
std::vector<PointCheck> check_points(const CheckRequest& request, const CheckSetup& setup,
                                     const std::vector<JudgedPoint>& points,
                                     const std::vector<const BaselinePoint*>& counterparts,
                                     const Workers& workers) {
  std::vector<PointCheck> checks;
  for (std::size_t i = 0; i < points.size() && !workers.interrupted(); ++i) {
    checks.push_back(check_point(setup, points[i], *counterparts[i], workers));
    show_progress(request.quiet, "check", i + 1, points.size());
  }
  return checks;
}

/// The one point that a frame is of.
const JudgedPoint& only_point(const std::vector<JudgedPoint>& points) {
  if (points.size() == 1) return points.front();
  throw bad_input("--explain and --minimise", "they are of one frame of one point",
                  "say which by --point");
}

/// The least of a frame's light that breaks the candidate, or why none is said.
std::string least_text(const OneFrame& frame, const Decoder& candidate, const Decoder& other) {
  if (const auto least = minimise(frame, candidate, other))
    return disturbed_text(*least, candidate, other) +
           fmt::format("as a test vector in C: --minimise {} in place of --explain\n",
                       frame.trial());
  const FrameOutcome outcome = outcome_of(candidate, frame);
  if (candidate.name() == other.name() || outcome.unknown) return "";
  if (outcome.undetected_error) return fmt::format("{} accepts it too\n", other.name());
  return outcome.lost() ? fmt::format("{} loses the frame too\n", other.name()) : "";
}

ExitCode look_at_frame(const CheckRequest& request, const JudgedPoint& point,
                       const CheckSetup& setup) {
  const std::atomic<bool>& stopping = heed_stop_signals();
  const OneFrame frame = hear_frame(point, request.explain ? *request.explain : *request.minimise);
  const Decoder& candidate = setup.candidate;
  std::vector<const Decoder*> decoders{&candidate};
  if (setup.baseline != nullptr && setup.baseline->name() != candidate.name())
    decoders.insert(decoders.begin(), setup.baseline);
  // A baseline that is a program only its user may run.
  const std::unique_ptr<Decoder> reference = make_built_in_decoder(reference_decoder);
  const Decoder& other = setup.baseline != nullptr ? *setup.baseline : *reference;
  if (request.explain) {
    const std::string trace = frame_trace(frame, decoders) + least_text(frame, candidate, other);
    if (stopping) return end_interrupted();
    print(point.name + ", " + trace);
    return ExitCode::done;
  }
  const auto least = minimise(frame, candidate, other);
  if (stopping) return end_interrupted();
  if (!least)
    throw bad_input(fmt::format("--minimise {}", *request.minimise),
                    fmt::format("it is no frame that {} loses, or accepts wrongly, and {} does not",
                                candidate.name(), other.name()),
                    "take one that the check lists as one of the candidate alone");
  print(disturbed_text(*least, candidate, other) + "\n" + test_vector(*least));
  return ExitCode::done;
}

}  // namespace

ExitCode check_command(const CheckRequest& request) {
  const Baseline baseline = read_baseline(request.baseline);
  const std::vector<JudgedPoint> points = points_of(request);
  const auto counterparts = counterparts_of(request, baseline, points);
  const auto candidate = make_decoder(
      request.decoder.empty() ? own_decoder(baseline) : request.decoder, request.program_settings);
  const auto again = make_built_in_decoder(baseline.decoder);
  if (request.init) return write_gate(request);
  if (request.summary)
    check_place(*request.summary, {is_check_summary, "a summary of cosys-sim check"});
  if (request.junit) check_place(*request.junit, {is_check_junit, "a report of cosys-sim check"});
  if (request.output)
    check_row_table(*request.output, {is_check_table, "a table of cosys-sim check"});
  const CheckSetup setup{.rule = request.rule,
                         .frames = request.frames,
                         .candidate = *candidate,
                         .baseline = again.get(),
                         .points = points.size(),
                         .golden = request.golden};
  if (request.explain || request.minimise) return look_at_frame(request, only_point(points), setup);
  const Workers workers{.threads = threads_for(request.threads), .interrupt = &heed_stop_signals()};
  std::vector<PointCheck> checks = check_points(request, setup, points, counterparts, workers);
  if (workers.interrupted()) return end_interrupted();
  judge(checks, setup);
  const CheckReport report{.checks = checks,
                           .setup = setup,
                           .baseline = baseline,
                           .baseline_file = request.baseline,
                           .options = repeated_options(request),
                           .scenario_options = scenario_options(request.options)};
  const auto answer = [&] { return request.json ? check_json(report) : check_text(report); };
  const auto keep = [&](const fs::path& place, const std::string& text) {
    keep_finished(
        place, [&](const fs::path& where) { write_file(where, text); }, answer);
  };
  if (request.junit) keep(*request.junit, check_junit(report));
  if (request.summary) keep(*request.summary, check_summary(report));
  if (request.output) keep(*request.output, check_table(*request.output, report));
  request.json ? print_json(answer()) : print(answer());
  return exit_code(verdict_of(checks));
}

}  // namespace sim
