#include <unistd.h>

#include <optional>
#include <utility>

#include "sim/command/commands.hpp"
#include "sim/serial/pseudo_terminal.hpp"
#include "sim/serve/live_scenario.hpp"
#include "sim/serve/serve_session.hpp"
#include "sim/text/text_file.hpp"
#include "sim/threads/stop_signals.hpp"

namespace sim {
namespace {

LiveScenario live_scenario(const ServeRequest& request) {
  load_link(request.options, request.scenario, "serve");  // which refuses other experiments
  return LiveScenario({read_text_file(request.scenario, "scenario"), request.scenario,
                       request.options.overrides, part_roots(request.options, request.scenario)});
}

/// The link is gone when this returns or throws, whatever becomes of the messages.
ExitCode run_serving(const ServeRequest& request, LineOutput* messages) {
  LiveScenario scenario = live_scenario(request);
  const std::atomic<bool>& stopping = heed_stop_signals();
  PseudoTerminal port(request.link, scenario.link()->receiver_baud.value);
  return ServeSession(std::move(scenario), port, messages, request.settings).run(stopping);
}

}  // namespace

ExitCode serve_command(const ServeRequest& request) {
  std::optional<LineOutput> messages;
  if (request.json) messages.emplace(STDOUT_FILENO);
  const ExitCode code = run_serving(request, messages ? &*messages : nullptr);
  if (messages) messages->finish();
  return code;
}

}  // namespace sim
