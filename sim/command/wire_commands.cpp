#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "protocol/uart_receivers.hpp"
#include "sim/command/commands.hpp"
#include "sim/failure.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/method.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/text_file.hpp"
#include "sim/trace/trace_file.hpp"
#include "sim/trace/vcd.hpp"
#include "sim/trial/trial.hpp"
#include "sim/trial/wire_protocols.hpp"

namespace sim {
namespace {

void print_frame(const WireFrame& frame, bool json) {
  const std::string message = escaped(frame.message);
  if (!json) {
    const std::string time = frame.start ? fmt::format("{:11.6f} s", frame.start->value) : "end";
    return print(fmt::format("{:>13}  {:14}  {}\n", time, frame.outcome, message));
  }
  nlohmann::json line = {{"outcome", frame.outcome}, {"message", message}};
  if (frame.start) line["time_s"] = frame.start->value;
  print(line.dump() + "\n");
}

const dsp::LogicTrace& wire_of(const std::vector<VcdTrace>& wires, const DecodeRequest& request) {
  const std::string wanted = request.wire.empty() ? "rx" : request.wire;
  for (const VcdTrace& wire : wires)
    if (wire.name == wanted) return wire.trace;
  if (wires.empty())
    throw bad_input(request.capture.string() + " holds no one-bit wire",
                    "there is nothing to decode", "give a capture of the receiver's output");
  if (request.wire.empty()) return wires.front().trace;
  std::vector<std::string> names;
  for (const VcdTrace& wire : wires) names.push_back(wire.name);
  throw bad_input(fmt::format("--wire {} is not in {}", wanted, request.capture.string()),
                  "the capture has no such wire", "use " + nearest(wanted, names));
}

constexpr std::size_t longest_capture = 256 * mebibyte;

std::vector<VcdTrace> read_capture(const std::filesystem::path& path) {
  if (path.extension() != ".vcd")
    throw bad_input("cannot decode " + path.string(), "its ending names no capture format",
                    "give a .vcd file");
  std::istringstream text(read_text_file(path, "capture", longest_capture));
  return read_vcd(text, path.string());
}

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
  check_traceable(request.output, point);
  refuse_without_memory(point, request.trial);
  TracedTrial traced = trace_trial(point, request.trial);
  traced.origin = {.program = request.program,
                   .scenario_toml = scenario.text,
                   .seed = static_cast<std::uint64_t>(point.simulation.seed),
                   .point = request.point,
                   .trial = request.trial};
  write_trace(request.output, traced);
  return ExitCode::done;
}

ExitCode encode_command(const EncodeRequest& request) {
  const protocol::Bytes bytes = wire_protocol(request.protocol).encode(request.message);
  print(std::string(bytes.begin(), bytes.end()));
  return ExitCode::done;
}

ExitCode decode_command(const DecodeRequest& request) {
  const std::vector<VcdTrace> wires = read_capture(request.capture);
  const dsp::LogicTrace& wire = wire_of(wires, request);
  const auto* uart = protocol::find_uart_receiver(request.uart);
  const auto bytes = uart->receive(wire, dsp::Hertz(request.baud), 0);
  const std::vector<WireFrame> frames = wire_protocol(request.protocol).decode(bytes);
  for (const WireFrame& frame : frames) print_frame(frame, request.json);
  if (frames.empty())
    say(fmt::format("cosys-sim: no {} message in {} characters\n", request.protocol, bytes.size()));
  return ExitCode::done;
}

}  // namespace sim
