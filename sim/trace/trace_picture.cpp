#include "sim/trace/trace_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "protocol/uart.hpp"
#include "sim/picture/scale.hpp"
#include "sim/picture/svg.hpp"
#include "sim/picture/waveform.hpp"
#include "sim/trace/traced_message.hpp"

namespace sim {
namespace {

using protocol::UartByte;

constexpr const char* title = "Light and decoded line of one trial by cosys-sim";

// Pixels.
constexpr double width = 1200, left = 120, right = 1180;
constexpr double panel_height = 240, first_panel = 40;
constexpr double light_top = 50, light_bottom = 120, wire_top = 145, wire_bottom = 180;
constexpr double time_labels = 230;

constexpr double cycles_before_edge = 5,
                 cycles_after_edge = 25;  // the module answers after 7 to 15

/// What is drawn: the wires, the light as samples, what was sent and what is read at the pin.
struct Signals {
  const TracedTrial& trial;
  TracedMessage message;
  std::vector<float> light{};
  double light_first_s = 0, light_period_s = 0, light_from = 0, light_to = 0;
  bool is_keyed = false;  // no light was sampled
};

/// Light as it was keyed, for trials without samples: eight values to a cycle.
void key_light(Signals& signals) {
  const TracedTrial& trial = signals.trial;
  constexpr int values_a_cycle = 8;
  signals.is_keyed = true;
  signals.light_period_s = 1 / (trial.carrier.value * values_a_cycle);
  const auto count = static_cast<std::size_t>(trial.tx.end().value / signals.light_period_s);
  dsp::TraceReader tx(trial.tx);
  for (std::size_t i = 0; i < count; ++i) {
    const bool dark = tx.level_at(dsp::Seconds(static_cast<double>(i) * signals.light_period_s));
    signals.light.push_back(!dark && i % values_a_cycle < values_a_cycle / 2 ? 1 : 0);
  }
}

void take_light(Signals& signals) {
  if (signals.trial.taps.irradiance.empty()) {
    key_light(signals);
  } else {
    signals.light = signals.trial.taps.irradiance;
    signals.light_period_s = 1 / signals.trial.sample_rate.value;
    signals.light_first_s = signals.light_period_s / 2;  // each is the mean of its period
  }
  const auto [least, greatest] = std::ranges::minmax(signals.light);
  signals.light_from = std::min(0.0, double{least});
  signals.light_to = std::max(double{greatest}, signals.light_from + 1e-12);
}

Signals signals_of(const TracedTrial& trial) {
  Signals signals{.trial = trial, .message = message_of(trial)};
  take_light(signals);
  return signals;
}

/// A part of the trial, on a time axis of its own.
struct Panel {
  Scale x;  // seconds
  double top;
};

Panel panel_of(int number, double from_s, double to_s) {
  return {{from_s, to_s, left, right}, first_panel + number * panel_height};
}

void draw_times(SvgDrawing& drawing, const Panel& panel, double zero_s) {
  const bool in_ms = panel.x.to - panel.x.from > 2e-3;
  const double unit = in_ms ? 1e-3 : 1e-6;
  const double from = (panel.x.from - zero_s) / unit, to = (panel.x.to - zero_s) / unit;
  for (const double value : round_values(from, to, 12)) {
    const double x = panel.x(zero_s + value * unit);
    drawing.line({x, panel.top + light_top}, {x, panel.top + wire_bottom + 25}, "grid");
    drawing.text({x, panel.top + time_labels - 10}, fmt::format("{:g}", value), "middle small");
  }
  drawing.text({left - 10, panel.top + time_labels - 10}, in_ms ? "ms" : "us", "end small");
}

void draw_waves(SvgDrawing& drawing, const Panel& panel, const Signals& signals) {
  const Scale light{signals.light_from, signals.light_to, panel.top + light_bottom,
                    panel.top + light_top};
  drawing.path(
      sampled_path({signals.light, signals.light_first_s, signals.light_period_s}, panel.x, light),
      "light");
  drawing.text({left - 10, panel.top + light_top + 20}, "light", "end");
  drawing.text(
      {left - 10, panel.top + light_top + 36},
      signals.is_keyed ? "as keyed" : fmt::format("to {:.3g} mW/m\u00b2", signals.light_to),
      "end small");
  const Scale level{0, 1, panel.top + wire_bottom, panel.top + wire_top};
  drawing.path(wire_path(signals.trial.rx, panel.x, level), "wire");
  drawing.text({left - 10, panel.top + wire_top + 14}, "receiver's pin", "end");
  drawing.text({left - 10, panel.top + wire_top + 30}, "1 is dark", "end small");
}

void draw_panel(SvgDrawing& drawing, const Panel& panel, const Signals& signals,
                const std::string& heading, double zero_s) {
  drawing.text({left, panel.top + 20}, heading, "heading");
  draw_times(drawing, panel, zero_s);
  draw_waves(drawing, panel, signals);
}

bool is_within(const Panel& panel, double time_s) {
  return panel.x.from <= time_s && time_s < panel.x.to;
}

/// What was sent above the light, what is read of the pin under it.
void draw_characters(SvgDrawing& drawing, const Panel& panel, const Signals& signals) {
  for (const UartByte& byte : signals.message.sent) {
    const double middle_s = byte.start.value + signals.message.character_s / 2;
    if (is_within(panel, middle_s))
      drawing.text({panel.x(middle_s), panel.top + light_top - 8}, shown(byte), "character");
  }
  for (const UartByte& byte : signals.message.received) {
    const double middle_s = byte.start.value + signals.message.character_s / 2;
    if (is_within(panel, middle_s))
      drawing.text({panel.x(middle_s), panel.top + wire_bottom + 20}, shown(byte),
                   signals.message.is_as_sent(byte) ? "character" : "wrong");
  }
}

/// Each bit as sent, and the level at the middle of each as the pin has it, in the order of
/// sending.
void draw_bits(SvgDrawing& drawing, const Panel& panel, const Signals& signals,
               std::size_t character) {
  const double bit_s = signals.message.character_s / protocol::bits_per_byte;
  const auto read = std::ranges::find_if(signals.message.received, [&](const UartByte& byte) {
    return signals.message.place_of(byte) == character;
  });
  const double begun_s = read == signals.message.received.end() ? signals.message.start_s(character)
                                                                : read->start.value;
  for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
    const bool sent = protocol::line_bit(signals.message.sent[character].value, slot);
    const char* role = slot == 0 ? "start " : slot == protocol::stop_slot ? "stop " : "";
    const double sent_s = signals.message.start_s(character) + (slot + 0.5) * bit_s;
    drawing.text({panel.x(sent_s), panel.top + light_top - 8}, fmt::format("{}{:d}", role, sent),
                 "character");
    const double read_s = begun_s + (slot + 0.5) * bit_s;
    const bool level = signals.trial.rx.level_at(dsp::Seconds(read_s));
    drawing.text({panel.x(read_s), panel.top + wire_bottom + 20}, fmt::format("{:d}", level),
                 level == sent ? "character" : "wrong");
  }
}

void draw_message(SvgDrawing& drawing, const Signals& signals) {
  const double from = signals.message.start_s(0) - signals.message.character_s / 2;
  const double to =
      signals.message.start_s(signals.message.sent.size() - 1) + 1.5 * signals.message.character_s;
  const Panel panel = panel_of(0, from, to);
  draw_panel(drawing, panel, signals, "The message, as sent and as read at the pin",
             signals.message.start_s(0));
  draw_characters(drawing, panel, signals);
}

void draw_character(SvgDrawing& drawing, const Signals& signals, std::size_t character) {
  const double start = signals.message.start_s(character), bit = 1 / signals.trial.baud.value;
  const Panel panel = panel_of(1, start - bit, start + signals.message.character_s + bit);
  draw_panel(drawing, panel, signals,
             fmt::format("Its character {}, \"{}\", bit by bit", character + 1,
                         shown(signals.message.sent[character])),
             signals.message.start_s(0));
  draw_bits(drawing, panel, signals, character);
}

void draw_edge(SvgDrawing& drawing, const Signals& signals, std::size_t character) {
  const double start = signals.message.start_s(character), cycle = 1 / signals.trial.carrier.value;
  const Panel panel =
      panel_of(2, start - cycles_before_edge * cycle, start + cycles_after_edge * cycle);
  draw_panel(drawing, panel, signals,
             fmt::format("The beginning of its start bit, light of {:.1f} kHz",
                         signals.trial.carrier.value / 1e3),
             start);
}

std::string description_of(const Signals& signals) {
  std::string sent, received;
  for (const UartByte& byte : signals.message.sent) sent += shown(byte);
  for (const UartByte& byte : signals.message.received)
    if (signals.message.place_of(byte)) received += shown(byte);
  const TraceOrigin& origin = signals.trial.origin;
  return fmt::format("Point {}, trial {}, seed {}. Sent: {} ; read at the receiver's pin: {}",
                     origin.point, origin.trial, origin.seed, sent,
                     received.empty() ? "nothing" : received);
}

}  // namespace

std::string trace_as_picture(const TracedTrial& trial) {
  const Signals signals = signals_of(trial);
  const std::string description = description_of(signals);
  SvgDrawing drawing(width, first_panel + 3 * panel_height, title, description);
  drawing.text({left, 24}, description, "small");
  if (signals.message.sent.empty()) return drawing.finished();
  const std::size_t character = signals.message.first_wrong().value_or(0);
  draw_message(drawing, signals);
  draw_character(drawing, signals, character);
  draw_edge(drawing, signals, character);
  return drawing.finished();
}

}  // namespace sim
