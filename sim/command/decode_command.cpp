#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "protocol/uart_receivers.hpp"
#include "protocol/uart_stream.hpp"
#include "sim/capture/capture_file.hpp"
#include "sim/capture/keyed_wire.hpp"
#include "sim/capture/line_statistics.hpp"
#include "sim/capture/line_survey.hpp"
#include "sim/capture/sampled_line.hpp"
#include "sim/command/commands.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/trial/wire_protocols.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::Seconds;

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

constexpr std::size_t batch = 32768;  // flips

/// The next flips of a line; fewer than a batch at its end alone.
std::vector<Seconds> next_flips(FlipSource& line) {
  std::vector<Seconds> flips;
  while (flips.size() < batch) {
    const auto flip = line.next();
    if (!flip) break;
    flips.push_back(*flip);
  }
  return flips;
}

/// A line's characters and frames as it goes on.
class CapturedLineDecoder {
 public:
  CapturedLineDecoder(const DecodeRequest& request, const LineFacts& facts, bool initial)
      : json_(request.json),
        uart_(*protocol::find_uart_receiver(request.uart), facts.baud, 0, initial),
        statistics_(facts.baud, initial),
        frames_(wire_protocol(request.protocol).decoder()) {}

  void take(std::span<const Seconds> flips, Seconds known_until) {
    const auto bytes = uart_.take(flips, known_until);
    statistics_.add(flips, bytes);
    for (const protocol::UartByte& byte : bytes) show(frames_->push(byte));
  }

  void end() { show(frames_->rest()); }

  bool any_frame() const { return any_frame_; }
  const LineStatistics& statistics() const { return statistics_; }

 private:
  void show(const std::optional<WireFrame>& frame) {
    if (!frame) return;
    any_frame_ = true;
    print_frame(*frame, json_);
  }

  bool json_, any_frame_ = false;
  protocol::UartStream uart_;
  LineStatistics statistics_;
  std::unique_ptr<WireDecoder> frames_;
};

std::optional<bool> told_inverted(const DecodeRequest& request) {
  if (request.polarity == "auto") return std::nullopt;
  return request.polarity == "idle-low";
}

std::optional<Hertz> hertz(const std::optional<double>& rate) {
  return rate ? std::optional(Hertz(*rate)) : std::nullopt;
}

double in_us(Seconds time) { return time.value * 1e6; }
double in_ppm(Hertz measured, Hertz nominal) { return (measured / nominal - 1) * 1e6; }

struct LineReport {
  LineFacts facts;
  Hertz carrier;  // 0: none
  std::optional<LineFit> fit;
};

void print_line_table(const LineReport& report, const LineStatistics& statistics) {
  const auto& [facts, carrier, fit] = report;
  const auto row = [](const char* name, const std::string& value) {
    print(fmt::format("{:24}{}\n", name, value));
  };
  print("\n");
  if (carrier.value != 0) row("carrier", fmt::format("{:.6g} Hz", carrier.value));
  row("polarity", facts.inverted ? "idle-low" : "idle-high");
  row("characters", std::to_string(statistics.characters()));
  row("framing errors", std::to_string(statistics.framing_errors()));
  row("baud", fmt::format("{:.6g}", facts.baud.value));
  if (!fit) return;
  row("baud error", fmt::format("{:+.0f} ppm", in_ppm(fit->baud, facts.baud)));
  row("pulse-width distortion", fmt::format("{:+.2f} us", in_us(fit->distortion)));
  row("jitter", fmt::format("{:.2f} us rms", in_us(fit->jitter)));
}

void print_line_json(const LineReport& report, const LineStatistics& statistics) {
  const auto& [facts, carrier, fit] = report;
  nlohmann::json line = {{"polarity", facts.inverted ? "idle-low" : "idle-high"},
                         {"characters", statistics.characters()},
                         {"framing_errors", statistics.framing_errors()},
                         {"baud", facts.baud.value}};
  if (carrier.value != 0) line["carrier_hz"] = carrier.value;
  if (fit) {
    line["baud_error_ppm"] = in_ppm(fit->baud, facts.baud);
    line["pulse_width_distortion_us"] = in_us(fit->distortion);
    line["jitter_us_rms"] = in_us(fit->jitter);
  }
  print(nlohmann::json{{"line", line}}.dump() + "\n");
}

void decode_line(FlipSource& line, Hertz carrier, const DecodeRequest& request) {
  std::vector<Seconds> flips = next_flips(line);
  const LineFacts facts = survey_line({line.initial(), flips, line.known_until()},
                                      told_inverted(request), hertz(request.baud));
  CapturedLineDecoder decoder(request, facts, line.initial() != facts.inverted);
  for (; flips.size() == batch; flips = next_flips(line)) decoder.take(flips, flips.back());
  decoder.take(flips, line.known_until());
  decoder.end();
  const LineStatistics& statistics = decoder.statistics();
  if (!decoder.any_frame())
    say(fmt::format("cosys-sim: no {} message in {} characters\n", request.protocol,
                    statistics.characters()));
  (request.json ? print_line_json : print_line_table)({facts, carrier, statistics.fit()},
                                                      statistics);
}

}  // namespace

ExitCode decode_command(const DecodeRequest& request) {
  const Capture capture = open_capture(
      request.capture,
      {request.wire, hertz(request.sample_rate_hz), request.format, request.sample_bytes});
  if (capture.logic) {
    WireFlips wire(*capture.logic,
                   wanted_wire(capture.logic->wires(), request.wire, request.capture.string()));
    KeyedWire line(wire, hertz(request.carrier_hz));
    decode_line(line, line.carrier(), request);
  } else {
    SampledLine line(*capture.samples, {hertz(request.carrier_hz), hertz(request.baud)});
    decode_line(line, line.carrier(), request);
  }
  return ExitCode::done;
}

}  // namespace sim
