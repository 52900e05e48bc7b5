#include <unistd.h>

#include <memory>

#include "sim/command/commands.hpp"
#include "sim/node/node_file.hpp"
#include "sim/node/node_session.hpp"
#include "sim/serial/pseudo_terminal.hpp"
#include "sim/serial/raw_mode.hpp"
#include "sim/serial/serial_port.hpp"
#include "sim/text/text_file.hpp"
#include "sim/threads/stop_signals.hpp"

namespace sim {
namespace {

NodeFile read_node_file(const NodeRequest& request) {
  NodeFile file = parse_node_file(read_text_file(request.lists, "node's lists"), request.lists);
  if (request.baud) file.baud = dsp::Hertz(*request.baud);
  check_speed(file.baud.value, request.baud ? "in --baud" : "in " + request.lists.string());
  return file;
}

std::unique_ptr<Port> open_port(const NodeRequest& request, double baud) {
  if (request.device) return std::make_unique<SerialPort>(*request.device, baud);
  if (request.pseudo_terminal)
    return std::make_unique<PseudoTerminal>(*request.pseudo_terminal, baud);
  throw bad_input("no port is named", "a node talks through one",
                  "add --device /dev/ttyUSB0, or --pty LINK for one that other programs open");
}

/// The port is as it was before when this returns or throws, whatever becomes of the events.
ExitCode run_node(const NodeRequest& request, LineOutput& events) {
  const NodeFile file = read_node_file(request);
  const std::atomic<bool>& stopping = heed_stop_signals();
  const std::unique_ptr<Port> port = open_port(request, file.baud.value);
  return NodeSession(file, *port, events).run(dsp::Seconds(request.duration_s), stopping);
}

}  // namespace

ExitCode node_command(const NodeRequest& request) {
  LineOutput events(STDOUT_FILENO);
  const ExitCode code = run_node(request, events);
  events.finish();
  return code;
}

}  // namespace sim
