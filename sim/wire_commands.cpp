#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "sim/commands.hpp"
#include "sim/failure.hpp"
#include "sim/method.hpp"
#include "sim/point_scenario.hpp"
#include "sim/standard_output.hpp"
#include "sim/sweep.hpp"
#include "sim/text_file.hpp"
#include "sim/trace_file.hpp"
#include "sim/trial.hpp"
#include "sim/vcd.hpp"

namespace sim {
namespace {

/// Bytes that a terminal cannot show, as \\xNN; a backslash as two.
std::string escaped(const std::string& text) {
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\\') {
      shown += "\\\\";
    } else if (byte >= 0x20 && byte <= 0x7E) {
      shown += c;
    } else {
      shown += fmt::format("\\x{:02x}", byte);
    }
  }
  return shown;
}

void print_frame(const protocol::CosysFrame& frame, bool json) {
  if (!json) {
    print(fmt::format("{:11.6f} s  {:14}  {}\n", frame.start.value, name(frame.outcome),
                      escaped(frame.message)));
    return;
  }
  const nlohmann::json line = {{"time_s", frame.start.value},
                               {"outcome", name(frame.outcome)},
                               {"message", escaped(frame.message)}};
  print(line.dump() + "\n");
}

/// What was heard behind the last newline: a damaged newline would otherwise hide a whole message.
void print_unfinished(const std::string& line, bool json) {
  if (!json) {
    print(fmt::format("{:>13}  {:14}  {}\n", "end", "no newline", escaped(line)));
    return;
  }
  const nlohmann::json object = {{"outcome", "no newline"}, {"message", escaped(line)}};
  print(object.dump() + "\n");
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
  const std::size_t points = count_points(scenario.sweep);
  if (request.point >= points)
    throw bad_input(fmt::format("--point {}", request.point),
                    fmt::format("the sweep has {} points, counted from 0", points),
                    fmt::format("use one from 0 to {}", points - 1));
  check_trace_path(request.output);
  const Scenario point = point_scenario(scenario, point_coordinates(scenario.sweep, request.point));
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

ExitCode encode_command(const std::string& message) {
  if (const auto problem = protocol::problem_in_message(message))
    throw bad_input(
        "the message cannot be sent", *problem,
        fmt::format("use printable ASCII, at most {} characters", protocol::longest_message));
  const protocol::Bytes bytes = protocol::cosys_encode(message);
  print(std::string(bytes.begin(), bytes.end()));
  return ExitCode::done;
}

ExitCode decode_command(const DecodeRequest& request) {
  const std::vector<VcdTrace> wires = read_capture(request.capture);
  const dsp::LogicTrace& wire = wire_of(wires, request);
  const auto* uart = protocol::find_uart_receiver(request.uart);
  protocol::CosysDecoder decoder;
  for (const protocol::UartByte& byte : uart->receive(wire, dsp::Hertz(request.baud), 0))
    if (const auto frame = decoder.push(byte)) print_frame(*frame, request.json);
  if (!decoder.pending().empty()) print_unfinished(decoder.pending(), request.json);
  return ExitCode::done;
}

}  // namespace sim
