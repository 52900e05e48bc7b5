#include <fmt/format.h>
#include <fmt/ranges.h>

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

constexpr std::size_t batch = most_surveyed_flips;

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

std::string basis_words(LineFacts::Basis basis) {
  switch (basis) {
    case LineFacts::Basis::told:
      return "as told";
    case LineFacts::Basis::characters:
      return "by the characters";
    case LineFacts::Basis::pauses:
      return "by the pauses";
    case LineFacts::Basis::assumed:
      return "assumed";
  }
  return "";
}

constexpr std::size_t few_channels = 4;    // all are named
constexpr std::size_t most_channels = 12;  // are named of those with edges

std::string channel_name(const CaptureFacts& facts, std::size_t channel) {
  return escaped(facts.channels[channel].name);
}

/// "channel rx (34 edges), not tx (0)".
std::string channel_text(const CaptureFacts& facts) {
  const auto named = [&](std::size_t channel, const char* words) {
    const auto& edges = facts.channels[channel].edges;
    if (!edges) return channel_name(facts, channel);
    return fmt::format("{} ({}{}{})", channel_name(facts, channel), *edges,
                       facts.is_whole ? "" : "+", words);
  };
  std::vector<std::string> others;
  std::size_t dead = 0, more = 0;
  for (std::size_t i = 0; i < facts.channels.size(); ++i) {
    if (i == facts.taken) continue;
    if (facts.channels[i].edges == 0U && facts.channels.size() > few_channels)
      ++dead;
    else if (others.size() == most_channels)
      ++more;
    else
      others.push_back(named(i, ""));
  }
  if (more > 0) others.push_back(fmt::format("{} more", more));
  if (dead > 0) others.push_back(fmt::format("{} without an edge", dead));
  const std::string text = "channel " + named(*facts.taken, " edges");
  return others.empty() ? text : fmt::format("{}, not {}", text, fmt::join(others, ", "));
}

/// What was read, in one line.
std::string reading_line(const std::string& file, const CaptureFacts& facts,
                         const LineFacts& line) {
  std::string text =
      fmt::format("read {} as {}: {}", escaped(file), facts.format, channel_text(facts));
  if (!facts.time.empty()) text += "; " + facts.time;
  text += fmt::format("; idle-{} {}; {:.6g} Bd {}", line.inverted ? "low" : "high",
                      basis_words(line.polarity_by), line.baud.value, basis_words(line.baud_by));
  if (!facts.assumed.empty()) text += fmt::format("; assumed: {}", fmt::join(facts.assumed, ", "));
  return text + "\n";
}

nlohmann::json reading_json(const std::string& file, const CaptureFacts& facts,
                            const LineFacts& line) {
  nlohmann::json channels = nlohmann::json::array();
  for (const CaptureFacts::Channel& channel : facts.channels) {
    nlohmann::json row = {{"name", channel.name}};
    if (channel.edges) row["edges"] = *channel.edges;
    channels.push_back(std::move(row));
  }
  nlohmann::json json = {{"file", file},
                         {"format", facts.format},
                         {"channel", facts.channels[*facts.taken].name},
                         {"channels", channels},
                         {"is_whole", facts.is_whole},
                         {"polarity_by", basis_words(line.polarity_by)},
                         {"baud_by", basis_words(line.baud_by)},
                         {"assumed", facts.assumed}};
  if (!facts.time.empty()) json["time"] = facts.time;
  return json;
}

/// Where another reading is about as good: what it is, and how to ask for it.
std::optional<std::string> doubt_about(const CaptureFacts& facts, const LineFacts& line) {
  if (facts.doubt) return facts.doubt;
  if (facts.rival)
    return fmt::format("channel {} reads as well as {} (nothing sets them apart) say --channel",
                       channel_name(facts, *facts.rival), channel_name(facts, *facts.taken));
  if (!line.rival) return std::nullopt;
  return fmt::format("{} reads as well as {} (nothing sets them apart) say --{}",
                     reading_text(*line.rival), reading_text(line.reading),
                     line.rival->inverted != line.reading.inverted ? "polarity" : "baud");
}

/// Bytes of a file that are no UTF-8 are replaced.
std::string json_line(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

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

nlohmann::json line_json(const LineReport& report, const LineStatistics& statistics) {
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
  return line;
}

ExitCode decode_line(FlipSource& line, Hertz carrier, const CaptureFacts& read,
                     const DecodeRequest& request) {
  std::vector<Seconds> flips = next_flips(line);
  const LineFacts facts = survey_line({line.initial(), flips, line.known_until()},
                                      told_inverted(request), hertz(request.baud));
  const std::string file = request.capture.string();
  if (!request.json) print(reading_line(file, read, facts));
  CapturedLineDecoder decoder(request, facts, line.initial() != facts.inverted);
  std::optional<Seconds> last;
  for (; flips.size() == batch; flips = next_flips(line)) {
    last = flips.back();
    decoder.take(flips, *last);
  }
  if (!flips.empty()) last = flips.back();
  decoder.take(flips, end_of_line(last, line.known_until(), facts.baud));
  decoder.end();
  const LineStatistics& statistics = decoder.statistics();
  if (!decoder.any_frame())
    say(fmt::format("cosys-sim: no {} message in {} characters\n", request.protocol,
                    statistics.characters()));
  const LineReport report{facts, carrier, statistics.fit()};
  if (request.json) {
    nlohmann::json json = line_json(report, statistics);
    json["capture"] = reading_json(file, read, facts);
    print(json_line({{"line", json}}));
  } else {
    print_line_table(report, statistics);
  }
  const auto doubt = doubt_about(read, facts);
  if (doubt) say("cosys-sim: " + *doubt + "\n");
  return doubt ? ExitCode::inconclusive : ExitCode::done;
}

}  // namespace

ExitCode decode_command(const DecodeRequest& request) {
  const LineHints hints{told_inverted(request), hertz(request.baud), hertz(request.carrier_hz)};
  const Capture capture =
      open_capture(request.capture, {request.wire, hertz(request.sample_rate_hz), request.format,
                                     request.sample_bytes, request.tick, request.skip_rows, hints});
  if (capture.logic) {
    WireFlips wire(*capture.logic, capture.wire);
    KeyedWire line(wire, hints.carrier);
    return decode_line(line, line.carrier(), capture.facts, request);
  }
  SampledLine line(*capture.samples, {hints.carrier, hints.baud});
  return decode_line(line, line.carrier(), capture.facts, request);
}

}  // namespace sim
