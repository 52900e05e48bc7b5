// `cosys-sim baseline`: what a decoder makes of scenarios, kept to judge others by.
#include <fmt/format.h>

#include <algorithm>

#include "sim/check/baseline.hpp"
#include "sim/check/baseline_sight.hpp"
#include "sim/check/decoded_frames.hpp"
#include "sim/check/program_decoder.hpp"
#include "sim/command/commands.hpp"
#include "sim/command/judging.hpp"
#include "sim/failure.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/loading/parsed_scenario.hpp"
#include "sim/report/experiment_run.hpp"
#include "sim/report/finished_result.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/threads/stop_signals.hpp"
#include "sim/threads/worker_threads.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

std::optional<Baseline> baseline_there(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error) || fs::file_size(path, error) == 0) return std::nullopt;
  return read_baseline(path);
}

/// The scenarios that a baseline carries, by the names of its points.
std::vector<LoadedScenario> scenarios_of(const Baseline& baseline,
                                         const std::vector<std::string>& overrides) {
  std::vector<LoadedScenario> scenarios;
  for (std::size_t i = 0; i < baseline.scenarios.size(); ++i) {
    const auto point = std::ranges::find(baseline.points, i, &BaselinePoint::scenario);
    const std::string name = point->name.substr(0, point->name.find(", "));
    scenarios.push_back(
        parse_scenario(baseline.scenarios[i], fs::path(name + ".toml"), overrides, {}));
  }
  return scenarios;
}

std::vector<LoadedScenario> wanted_scenarios(const BaselineRequest& request,
                                             const std::optional<Baseline>& old) {
  if (!request.scenarios.empty()) return load_links(request.scenarios, request.options, "baseline");
  if (!old)
    throw bad_input("no scenario", request.output.string() + " is no baseline to renew",
                    "give one: cosys-sim baseline scenarios/quickstart.toml -o B.h5");
  return scenarios_of(*old, request.options.overrides);
}

std::string wanted_decoder(const BaselineRequest& request, const std::optional<Baseline>& old,
                           const std::vector<LoadedScenario>& scenarios) {
  if (!request.decoder.empty()) return request.decoder;
  if (old) return own_decoder(*old);
  const std::string& uart = scenarios.front().base.uart.receiver;
  for (const LoadedScenario& scenario : scenarios)
    if (scenario.base.uart.receiver != uart)
      throw bad_input(uart + " and " + scenario.base.uart.receiver,
                      "the scenarios have different UART receivers", "give one by --decoder");
  return uart;
}

/// What is other than before; empty where there was no such point.
std::string change_of(const std::optional<Baseline>& old, const BaselinePoint& point) {
  if (!old) return "";
  const auto before = std::ranges::find(old->points, point.name, &BaselinePoint::name);
  if (before == old->points.end()) return "; new";
  if (before->physics != point.physics) return "; of another scenario before";
  const std::size_t frames = std::min(before->frames.size(), point.frames.size());
  std::size_t flipped = 0, light = 0;
  for (std::size_t i = 0; i < frames; ++i) {
    flipped += before->frames[i].outcome != point.frames[i].outcome;
    light += before->frames[i].light != point.frames[i].light;
  }
  return fmt::format("; {} before, {} of {} frames came out otherwise{}", lost_frames(*before),
                     flipped, frames, light > 0 ? fmt::format(", {} of other light", light) : "");
}

/// The frames of a point that are not there yet, up to `frames`. A capture that ended early is
/// played again: what a decoder remembers of its frames is then as in a check. Throws where the
/// decoder fails: there is nothing to judge others by.
void play_to(std::uint64_t frames, const JudgedPoint& point, const Decoder& decoder,
             const Workers& workers, std::vector<FrameRecord>& have) {
  have.resize(have.size() / frames_per_capture * frames_per_capture);
  const auto first = static_cast<std::uint32_t>(have.size());
  const auto n = static_cast<std::uint32_t>(frames) - first;
  const DecodedFrames decoded =
      std::move(decode_frames(judged_link(point), {&decoder}, first, n, workers).front());
  if (decoded.fault)
    throw Failure(ExitCode::environment,
                  fmt::format("{} failed at {} ({}: {}) mend it first", decoder.name(), point.name,
                              decoded.fault->what, last_line_of(decoded.fault->words)));
  have.insert(have.end(), decoded.frames.begin(), decoded.frames.end());
}

/// Of a baseline that is renewed as many as it has, unless the user says how many.
std::uint64_t least_frames(const BaselineRequest& request, const std::optional<Baseline>& old,
                           const JudgedPoint& point) {
  const bool are_said = std::ranges::any_of(
      request.options.overrides,
      [](const std::string& change) { return change.starts_with(amount_option); });
  if (!old || !request.scenarios.empty() || are_said) return point.frames;
  const auto before = std::ranges::find(old->points, point.name, &BaselinePoint::name);
  return before == old->points.end() ? point.frames : before->frames.size();
}

BaselinePoint measure(const JudgedPoint& point, std::uint64_t least, const Decoder& decoder,
                      const BaselineSight& sight, const Workers& workers) {
  BaselinePoint measured{
      .name = point.name, .scenario = 0, .physics = physics_hash(point), .frames = {}};
  play_to(least, point, decoder, workers, measured.frames);
  constexpr int most_rounds = 4;  // the loss of more frames may ask for still more
  for (int round = 0; round < most_rounds && !workers.interrupted(); ++round) {
    const std::uint64_t frames = sight.frames_for(measured);
    if (frames <= measured.frames.size()) break;
    play_to(frames, point, decoder, workers, measured.frames);
  }
  return measured;
}

std::string row_of(const BaselinePoint& point, const std::optional<Baseline>& old) {
  return fmt::format("{}: {} of {} frames lost{}", point.name, lost_frames(point),
                     point.frames.size(), change_of(old, point));
}

}  // namespace

ExitCode baseline_command(const BaselineRequest& request) {
  check_baseline_place(request.output);
  const std::optional<Baseline> old = baseline_there(request.output);
  const std::vector<LoadedScenario> scenarios = wanted_scenarios(request, old);
  const std::string name = wanted_decoder(request, old, scenarios);
  const std::size_t points = judged_points(scenarios).size();
  const auto decoder = make_decoder(name, request.program_settings);
  const Workers workers{.threads = threads_for(request.threads), .interrupt = &heed_stop_signals()};
  Baseline baseline{.program = request.program,
                    .command = request.command,
                    .decoder = name,
                    .scenarios = {},
                    .points = {}};
  BaselineSight sight(request.detect, request.power, points);
  Rows rows(false);
  for (const LoadedScenario& scenario : scenarios) {
    for (const JudgedPoint& point : judged_points(scenario)) {
      baseline.points.push_back(
          measure(point, least_frames(request, old, point), *decoder, sight, workers));
      baseline.points.back().scenario = baseline.scenarios.size();
      if (workers.interrupted()) return end_interrupted();
      const BaselinePoint& measured = baseline.points.back();
      rows.print(row_of(measured, old) + sight.of_point(measured) + "\n");
      show_progress(request.quiet, "baseline", baseline.points.size(), points);
    }
    baseline.scenarios.push_back(scenario.text);
  }
  keep_finished(request.output,
                [&](const std::filesystem::path& place) { write_baseline(place, baseline); });
  rows.check();
  print(sight.of_all());
  print(fmt::format("{} -> {}\n", name, request.output.string()));
  return ExitCode::done;
}

}  // namespace sim
