#include <fmt/format.h>
#include <unistd.h>

#include <utility>

#include "sim/command/commands.hpp"
#include "sim/failure.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/method.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/trace/trace_file.hpp"
#include "sim/trial/trial.hpp"
#include "sim/trial/wire_protocols.hpp"

namespace sim {
namespace {

/// A trace is made in memory: one without room there would end in a killed process.
void refuse_without_memory(const Scenario& scenario, std::uint32_t trial) {
  constexpr double bytes_a_sample = 100;  // taps, instants and the file's text
  const Link link = make_link(scenario);
  const double need =
      bytes_a_sample * link.chain.sample_rate.value * transmit(link, trial).line.end().value;
  const double have =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  if (need <= have) return;
  throw Failure(ExitCode::environment,
                fmt::format("the trace would take {:.0f} GB (this machine has {:.0f} GB of memory) "
                            "raise device.baud or lower simulation.warmup_messages",
                            need / 1e9, have / 1e9));
}

}  // namespace

ExitCode trace_command(const TraceRequest& request) {
  const LoadedScenario scenario = load_link(request.options, request.scenario, "trace");
  const Scenario point = numbered_point(scenario, request.point);
  check_trace_path(request.output);
  refuse_weighted(point, "trace shows trials as they come");
  check_traceable(request.output, point, request.wishes);
  refuse_without_memory(point, request.trial);
  TracedTrial traced = trace_trial(point, request.trial);
  traced.origin = {.program = request.program,
                   .scenario_toml = scenario.text,
                   .seed = static_cast<std::uint64_t>(point.simulation.seed),
                   .point = request.point,
                   .trial = request.trial};
  write_trace(request.output, std::move(traced), request.wishes);
  return ExitCode::done;
}

ExitCode encode_command(const EncodeRequest& request) {
  const protocol::Bytes bytes = wire_protocol(request.protocol).encode(request.message);
  print_bytes(std::string(bytes.begin(), bytes.end()));
  return ExitCode::done;
}

}  // namespace sim
