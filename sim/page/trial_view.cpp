#include "sim/page/trial_view.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>

#include "sim/trace/close_up.hpp"
#include "sim/trace/traced_message.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr double before_s = 0.01, after_s = 0.03;  // the message

std::size_t shown_first(const TracedMessage& message) { return message.first_wrong().value_or(0); }

/// A stretch of samples, and how many stand for two values.
struct Stretch {
  std::size_t from, to, step;
};

std::size_t sample_at(const TracedTrial& trial, double time_s) {
  return static_cast<std::size_t>(std::clamp(time_s * trial.sample_rate.value, 0.0,
                                             static_cast<double>(trial.taps.irradiance.size())));
}

Stretch stretch_of(const TracedTrial& trial, const TracedMessage& message, std::size_t most) {
  const std::size_t from = sample_at(trial, message.start_s(0) - before_s);
  const std::size_t to = sample_at(trial, message.end_s() + after_s);
  const std::size_t count = to - from;
  return {from, to, count <= most ? 1 : 2 * ((count + most - 1) / most)};
}

/// Every sample of a character and a little about it, unless these are too many; where `whole` has
/// every sample, none.
Stretch detail_of(const TracedTrial& trial, const TracedMessage& message, const Stretch& whole,
                  std::size_t most) {
  if (whole.step == 1) return {whole.from, whole.from, 1};
  const double start_s = message.start_s(shown_first(message)), margin_s = message.character_s / 5;
  const std::size_t from = sample_at(trial, start_s - margin_s);
  const std::size_t to = sample_at(trial, start_s + message.character_s + margin_s);
  return {from, std::min(to, from + most / 2), 1};
}

std::vector<float> values_of(std::span<const float> samples, const Stretch& stretch) {
  const auto within = samples.subspan(stretch.from, stretch.to - stretch.from);
  if (stretch.step == 1) return {within.begin(), within.end()};
  std::vector<float> values;
  for (std::size_t i = 0; i < within.size(); i += stretch.step) {
    const auto [least, greatest] =
        std::ranges::minmax(within.subspan(i, std::min(stretch.step, within.size() - i)));
    values.push_back(least);
    values.push_back(greatest);
  }
  return values;
}

std::string quantised(const std::vector<float>& values, float least, float greatest) {
  constexpr float steps = 65535;
  std::vector<unsigned char> bytes;
  bytes.reserve(2 * values.size());
  const float scale = greatest > least ? steps / (greatest - least) : 0;
  for (const float value : values) {
    const float within = std::clamp(value, least, greatest);  // a detail may reach beyond the whole
    const auto step = static_cast<std::uint16_t>(std::lround((within - least) * scale));
    bytes.push_back(static_cast<unsigned char>(step & 0xff));
    bytes.push_back(static_cast<unsigned char>(step >> 8));
  }
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(),
                                     static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

void add_wire(TrialView& view, const dsp::LogicTrace& rx, double zero_s, double from_s,
              double to_s) {
  view.wire_begins = rx.level_at(dsp::Seconds(from_s));
  for (const dsp::Seconds edge : rx.edges())
    if (edge.value > from_s && edge.value < to_s) view.wire_edges_s.push_back(edge.value - zero_s);
}

void add_characters(TrialView& view, const TracedMessage& message) {
  const double zero_s = message.start_s(0), middle_s = message.character_s / 2;
  for (const protocol::UartByte& byte : message.sent)
    view.sent.push_back({byte.start.value - zero_s + middle_s, shown(byte), false});
  for (const protocol::UartByte& byte : message.received)
    if (message.place_of(byte))
      view.read.push_back(
          {byte.start.value - zero_s + middle_s, shown(byte), !message.is_as_sent(byte)});
}

void add_bits(TrialView& view, const TracedTrial& trial, const TracedMessage& message) {
  const double bit_s = message.character_s / protocol::bits_per_byte;
  for (const protocol::UartByte& byte : message.sent)
    for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
      const double at_s = byte.start.value + (slot + 0.5) * bit_s;
      const bool level = message.line.level_at(dsp::Seconds(at_s) + trial.delay);
      view.bits.push_back({at_s - message.start_s(0), level ? "1" : "0",
                           level != protocol::line_bit(byte.value, slot)});
    }
}

/// As the other sections and data sheets write it: files have "mW m-2" for "mW/m2", and "1" for
/// none.
std::string printed(const std::string& unit) {
  if (unit == "1") return "";
  const std::size_t at = unit.find(" m-2");
  return at == std::string::npos ? unit : unit.substr(0, at) + "/m2";
}

void add_taps(TrialView& view, const TracedTrial& trial, const Stretch& whole,
              const Stretch& detail) {
  for (const Tap& tap : analogue_taps()) {
    const std::vector<float>& samples = trial.taps.*tap.samples;
    if (tells_something(trial, tap.samples))
      view.taps.push_back({tap.name, tap.long_name, printed(tap.unit), values_of(samples, whole),
                           values_of(samples, detail)});
  }
}

Json marks_json(const std::vector<ViewMark>& marks) {
  Json all = Json::array();
  for (const ViewMark& mark : marks) all.push_back({mark.at_s, mark.text, mark.is_wrong});
  return all;
}

}  // namespace

TrialView view_of(const TracedTrial& trial, std::size_t most) {
  const TracedMessage message = message_of(trial);
  const Stretch stretch = stretch_of(trial, message, most);
  const double sample_s = 1 / trial.sample_rate.value, zero_s = message.start_s(0);
  TrialView view;
  view.stretch = stretch.step;
  view.period_s = stretch.step == 1 ? sample_s : sample_s * static_cast<double>(stretch.step) / 2;
  view.first_s = static_cast<double>(stretch.from) * sample_s + view.period_s / 2 - zero_s;
  const Stretch detail = detail_of(trial, message, stretch, most);
  view.detail_first_s = (static_cast<double>(detail.from) + 0.5) * sample_s - zero_s;
  add_taps(view, trial, stretch, detail);
  add_wire(view, trial.rx, zero_s, static_cast<double>(stretch.from) * sample_s,
           static_cast<double>(stretch.to) * sample_s);
  add_characters(view, message);
  add_bits(view, trial, message);
  view.message_s = message.end_s() - zero_s;
  view.byte_from_s = message.start_s(shown_first(message)) - zero_s;
  view.byte_s = message.character_s;
  const CloseUp close = close_up_of(trial, message);
  view.edge_from_s = close.from_s - zero_s;
  view.edge_to_s = close.to_s - zero_s;
  view.delay_s = trial.delay.value;
  return view;
}

std::string view_json(const TrialView& view) {
  Json taps = Json::array();
  for (const TapValues& tap : view.taps) {
    const auto [least, greatest] = std::ranges::minmax(tap.values);
    taps.push_back({{"key", tap.key},
                    {"name", tap.name},
                    {"unit", tap.unit},
                    {"least", least},
                    {"greatest", greatest},
                    {"values", quantised(tap.values, least, greatest)},
                    {"detail", quantised(tap.detail, least, greatest)}});
  }
  const Json json{{"first_s", view.first_s},
                  {"delay_s", view.delay_s},
                  {"period_s", view.period_s},
                  {"stretch", view.stretch},
                  {"detail_first_s", view.detail_first_s},
                  {"taps", taps},
                  {"wire_begins", view.wire_begins},
                  {"wire_edges_s", view.wire_edges_s},
                  {"sent", marks_json(view.sent)},
                  {"read", marks_json(view.read)},
                  {"bits", marks_json(view.bits)},
                  {"message_s", view.message_s},
                  {"byte_from_s", view.byte_from_s},
                  {"byte_s", view.byte_s},
                  {"edge_from_s", view.edge_from_s},
                  {"edge_to_s", view.edge_to_s}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sim
