// What decode says of a capture, in words and as JSON.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "sim/command/decoded_capture.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/json_answer.hpp"

namespace sim {
namespace {

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
  return escaped_name(facts.channels[channel].name);
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

nlohmann::json reading_json(const DecodedCapture& decoded) {
  const CaptureFacts& facts = decoded.read;
  nlohmann::json channels = nlohmann::json::array();
  for (const CaptureFacts::Channel& channel : facts.channels) {
    nlohmann::json row = {{"name", channel.name}};
    if (channel.edges) row["edges"] = *channel.edges;
    channels.push_back(std::move(row));
  }
  nlohmann::json json = {{"file", decoded.file},
                         {"format", facts.format},
                         {"channel", facts.channels[*facts.taken].name},
                         {"channels", channels},
                         {"is_whole", facts.is_whole},
                         {"polarity_by", basis_words(decoded.line.polarity_by)},
                         {"baud_by", basis_words(decoded.line.baud_by)},
                         {"assumed", facts.assumed}};
  if (!facts.time.empty()) json["time"] = facts.time;
  return json;
}

nlohmann::json line_json(const DecodedCapture& decoded) {
  nlohmann::json line = {{"polarity", decoded.line.inverted ? "idle-low" : "idle-high"},
                         {"characters", decoded.characters},
                         {"framing_errors", decoded.framing_errors},
                         {"baud", decoded.line.baud.value}};
  if (decoded.carrier.value != 0) line["carrier_hz"] = decoded.carrier.value;
  if (decoded.fit) {
    line["baud_error_ppm"] = baud_error_ppm(decoded);
    line["pulse_width_distortion_us"] = decoded.fit->distortion.value * 1e6;
    line["jitter_us_rms"] = decoded.fit->jitter.value * 1e6;
  }
  line["capture"] = reading_json(decoded);
  return line;
}

}  // namespace

double baud_error_ppm(const DecodedCapture& decoded) {
  return (decoded.fit->baud / decoded.line.baud - 1) * 1e6;
}

std::string reading_line(const DecodedCapture& decoded) {
  const CaptureFacts& facts = decoded.read;
  const LineFacts& line = decoded.line;
  std::string text = fmt::format("read {} as {}: {}", escaped_name(decoded.file), facts.format,
                                 channel_text(facts));
  if (!facts.time.empty()) text += "; " + facts.time;
  text += fmt::format("; idle-{} {}; {:.6g} Bd {}", line.inverted ? "low" : "high",
                      basis_words(line.polarity_by), line.baud.value, basis_words(line.baud_by));
  if (!facts.assumed.empty()) text += fmt::format("; assumed: {}", fmt::join(facts.assumed, ", "));
  return text + "\n";
}

namespace {

/// Where times have no unit and another one would make the rate a standard one.
std::optional<std::string> doubt_about_tick(const DecodedCapture& decoded) {
  const dsp::Hertz baud = decoded.line.baud;
  if (!decoded.read.is_tick_assumed || decoded.line.reading.characters == 0 ||
      is_standard_rate(baud))
    return std::nullopt;
  for (const auto& [unit, factor] : {std::pair{"ms", 1e3}, {"us", 1e6}, {"ns", 1e9}})
    if (is_standard_rate(factor * baud))
      return fmt::format("its times may be in {} (the rate would be {:.6g} Bd) say --time-unit",
                         unit, factor * baud.value);
  return std::nullopt;
}

}  // namespace

std::optional<std::string> doubt_about(const DecodedCapture& decoded) {
  const CaptureFacts& facts = decoded.read;
  const LineFacts& line = decoded.line;
  if (facts.doubt) return facts.doubt;
  if (const auto why = why_no_line(line))
    return fmt::format("no line is found ({}) say --baud or --channel", *why);
  if (facts.rival)
    return fmt::format("channel {} reads as well as {} (nothing sets them apart) say --channel",
                       channel_name(facts, *facts.rival), channel_name(facts, *facts.taken));
  if (auto tick = doubt_about_tick(decoded)) return tick;
  if (!line.rival) return std::nullopt;
  return fmt::format("{} reads as well as {} (nothing sets them apart) say --{}",
                     reading_text(*line.rival), reading_text(line.reading),
                     line.rival->inverted != line.reading.inverted ? "polarity" : "baud");
}

std::string line_as_json(const DecodedCapture& decoded) {
  return json_line({{"line", line_json(decoded)}});
}

std::string outcome_as_json(const CaptureOutcome& outcome) {
  const DecodedCapture& decoded = outcome.decoded;
  nlohmann::json json = {{"file", decoded.file}, {"exit_code", static_cast<int>(outcome.code)}};
  if (!outcome.problem.empty()) json["problem"] = outcome.problem;
  if (outcome.was_read()) {
    json["line"] = line_json(decoded);
    json["messages"] = {{"accepted", decoded.accepted}, {"refused", decoded.refused}};
  }
  return json_line(json);
}

}  // namespace sim
