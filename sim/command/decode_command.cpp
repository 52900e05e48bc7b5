#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/command/decode_table.hpp"
#include "sim/command/decoded_capture.hpp"
#include "sim/command/reading_progress.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/json_answer.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

void print_message(const WireFrame& frame, bool json) {
  const std::string message = escaped(frame.message);
  if (!json) {
    const std::string time = frame.start ? fmt::format("{:11.6f} s", frame.start->value) : "end";
    return print(fmt::format("{:>13}  {:14}  {}\n", time, frame.outcome, message));
  }
  nlohmann::json line = {{"outcome", frame.outcome}, {"message", message}};
  if (frame.start) line["time_s"] = frame.start->value;
  print_json(json_line(line));
}

void print_line(const DecodedCapture& decoded) {
  const auto row = [](const char* name, const std::string& value) {
    print(fmt::format("{:24}{}\n", name, value));
  };
  print("\n");
  if (decoded.carrier.value != 0) row("carrier", fmt::format("{:.6g} Hz", decoded.carrier.value));
  row("polarity", decoded.line.inverted ? "idle-low" : "idle-high");
  row("characters", std::to_string(decoded.characters));
  row("framing errors", std::to_string(decoded.framing_errors));
  row("baud", fmt::format("{:.6g}", decoded.line.baud.value));
  if (!decoded.fit) return;
  row("baud error", fmt::format("{:+.0f} ppm", baud_error_ppm(decoded)));
  row("pulse-width distortion", fmt::format("{:+.2f} us", decoded.fit->distortion.value * 1e6));
  row("jitter", fmt::format("{:.2f} us rms", decoded.fit->jitter.value * 1e6));
}

ExitCode decode_one(const DecodeRequest& request) {
  ReadingProgress progress("reading " + escaped_name(request.captures.front().string()),
                           !is_terminal());
  DecodeListener listener;
  listener.chosen = [&](const DecodedCapture& decoded) {
    if (!request.json) print(reading_line(decoded));
  };
  listener.message = [&](const WireFrame& frame) { print_message(frame, request.json); };
  listener.reached = [&](dsp::Seconds at) { progress.show(at); };
  const DecodedCapture decoded = decode_capture(request.captures.front(), request, listener);
  progress.clear();
  if (decoded.accepted + decoded.refused == 0)
    say(fmt::format("cosys-sim: no {} message in {} characters\n", request.protocol,
                    decoded.characters));
  if (request.json)
    print_json(line_as_json(decoded));
  else
    print_line(decoded);
  const auto doubt = doubt_about(decoded);
  if (doubt) say("cosys-sim: " + *doubt + "\n");
  return doubt ? ExitCode::inconclusive : ExitCode::done;
}

}  // namespace

ExitCode decode_command(const DecodeRequest& request) {
  return asks_for_many(request) ? decode_table(request) : decode_one(request);
}

}  // namespace sim
