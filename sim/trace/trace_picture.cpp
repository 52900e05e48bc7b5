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
#include "sim/text/letters.hpp"
#include "sim/trace/close_up.hpp"
#include "sim/trace/trace_lanes.hpp"
#include "sim/trace/traced_message.hpp"

namespace sim {
namespace {

using protocol::UartByte;

constexpr const char* title = "Light and decoded line of one trial by cosys-sim";

// Pixels.
constexpr double width = 1200, left = 180, right = 1180, first_panel = 40;
constexpr double marks_end = left - 6, names_end = left - 50;
constexpr double letter_width = 8, letter_gap = 2;  // of a character's 13 pixels of monospace
constexpr std::size_t most_letters = 125;           // of a line across, even of capitals
constexpr double first_lane = 50, lane_height = 70, lane_pitch = 95, wire_height = 35;

/// What is drawn: lanes and the pin, what was sent and what is read at the pin.
struct Signals {
  const TracedTrial& trial;
  TracedMessage message;
  std::vector<Lane> lanes;  // the light first
};

/// A part of the trial, on a time axis of its own.
struct Panel {
  Scale x;  // seconds
  double top, wire_top;

  double lane_top(std::size_t lane) const {
    return top + first_lane + lane_pitch * static_cast<double>(lane);
  }
  double wire_bottom() const { return wire_top + wire_height; }
};

double panel_height(const Signals& signals) {
  return first_lane + lane_pitch * static_cast<double>(signals.lanes.size() + 1);
}

Panel panel_of(const Signals& signals, int number, double from_s, double to_s) {
  const double top = first_panel + number * panel_height(signals);
  return {{from_s, to_s, left, right}, top, top + panel_height(signals) - lane_pitch};
}

void draw_times(SvgDrawing& drawing, const Panel& panel, double zero_s) {
  const bool in_ms = panel.x.to - panel.x.from > 2e-3;
  const double unit = in_ms ? 1e-3 : 1e-6, text_y = panel.wire_bottom() + 40;
  const double from = (panel.x.from - zero_s) / unit, to = (panel.x.to - zero_s) / unit;
  for (const double value : round_values(from, to, 12)) {
    const double x = panel.x(zero_s + value * unit);
    drawing.line({x, panel.lane_top(0)}, {x, panel.wire_bottom() + 25}, "grid");
    drawing.text({x, text_y}, fmt::format("{:g}", value), "middle small");
  }
  drawing.text({marks_end, text_y}, in_ms ? "ms" : "\u00b5s", "end small");
}

/// One below the other; the first by itself, the others are about it.
void draw_names(SvgDrawing& drawing, const std::vector<std::string>& names, double top) {
  double y = top;
  for (const std::string& name : names) {
    drawing.text({names_end, y}, name, y > top ? "end small" : "end");
    y += 16;
  }
}

void draw_lane(SvgDrawing& drawing, const Panel& panel, const Lane& lane, double top) {
  const Scale y{lane.least, lane.greatest, top + lane_height, top};
  draw_names(drawing, lane.names, top + 20);
  if (lane.is_measured)
    for (const double value : round_values(lane.least, lane.greatest, 4)) {
      drawing.line({left, y(value)}, {right, y(value)}, "grid");
      drawing.text({marks_end, y(value) + 4}, fmt::format("{:g}", value), "end small");
    }
  for (const LaneCurve& curve : lane.curves)
    drawing.path(sampled_path(curve.wave, panel.x, y), curve.style);
}

void draw_waves(SvgDrawing& drawing, const Panel& panel, const Signals& signals) {
  for (std::size_t i = 0; i < signals.lanes.size(); ++i)
    draw_lane(drawing, panel, signals.lanes[i], panel.lane_top(i));
  drawing.path(wire_path(signals.trial.rx, panel.x, {0, 1, panel.wire_bottom(), panel.wire_top}),
               "wire");
  draw_names(drawing, {"receiver's pin", "1 is dark"}, panel.wire_top + 14);
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

/// A character at its middle.
struct Label {
  double x;
  std::string text;
  bool is_wrong;
};

std::vector<Label> labels_of(const std::vector<UartByte>& bytes, const Panel& panel,
                             const TracedMessage& message, bool are_read) {
  std::vector<Label> labels;
  for (const UartByte& byte : bytes) {
    const double middle_s = byte.start.value + message.character_s / 2;
    if (is_within(panel, middle_s))
      labels.push_back({panel.x(middle_s), shown(byte), are_read && !message.is_as_sent(byte)});
  }
  return labels;
}

bool stand_clear(const Label& a, const Label& b) {
  const auto letters = static_cast<double>(letters_in(a.text) + letters_in(b.text));
  return std::abs(a.x - b.x) >= letter_width * letters / 2 + letter_gap;
}

/// Those that stand clear of each other; misread ones come first.
std::vector<Label> with_room(std::vector<Label> labels) {
  std::stable_partition(labels.begin(), labels.end(),
                        [](const Label& label) { return label.is_wrong; });
  std::vector<Label> kept;
  for (const Label& label : labels)
    if (std::ranges::all_of(kept, [&](const Label& other) { return stand_clear(label, other); }))
      kept.push_back(label);
  return kept;
}

/// What was sent above the light, what is read of the pin under it.
struct CharacterLabels {
  std::vector<Label> sent, read;
  bool are_all;
};

CharacterLabels characters_on(const Panel& panel, const TracedMessage& message) {
  const std::vector<Label> sent = labels_of(message.sent, panel, message, false);
  const std::vector<Label> read = labels_of(message.received, panel, message, true);
  CharacterLabels labels{with_room(sent), with_room(read), true};
  labels.are_all = labels.sent.size() == sent.size() && labels.read.size() == read.size();
  return labels;
}

void draw_labels(SvgDrawing& drawing, const std::vector<Label>& labels, double y) {
  for (const Label& label : labels)
    drawing.text({label.x, y}, label.text, label.is_wrong ? "wrong" : "character");
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
    drawing.text({panel.x(sent_s), panel.lane_top(0) - 8}, fmt::format("{}{:d}", role, sent),
                 "character");
    const double read_s = begun_s + (slot + 0.5) * bit_s;
    const bool level = signals.message.line.level_at(dsp::Seconds(read_s));
    drawing.text({panel.x(read_s), panel.wire_bottom() + 20}, fmt::format("{:d}", level),
                 level == sent ? "character" : "wrong");
  }
}

void draw_message(SvgDrawing& drawing, const Signals& signals) {
  const double from = signals.message.start_s(0) - signals.message.character_s / 2;
  const double to =
      signals.message.start_s(signals.message.sent.size() - 1) + 1.5 * signals.message.character_s;
  const Panel panel = panel_of(signals, 0, from, to);
  const CharacterLabels labels = characters_on(panel, signals.message);
  const std::string note = labels.are_all ? "" : "; characters are left out that have no room";
  draw_panel(drawing, panel, signals, "The message, as sent and as read at the pin" + note,
             signals.message.start_s(0));
  draw_labels(drawing, labels.sent, panel.lane_top(0) - 8);
  draw_labels(drawing, labels.read, panel.wire_bottom() + 20);
}

void draw_character(SvgDrawing& drawing, const Signals& signals, std::size_t character) {
  const double start = signals.message.start_s(character), bit = 1 / signals.trial.baud.value;
  const Panel panel = panel_of(signals, 1, start - bit, start + signals.message.character_s + bit);
  draw_panel(drawing, panel, signals,
             fmt::format("Its character {}, \"{}\", bit by bit", character + 1,
                         shown(signals.message.sent[character])),
             signals.message.start_s(0));
  draw_bits(drawing, panel, signals, character);
}

void draw_edge(SvgDrawing& drawing, const Signals& signals) {
  const CloseUp close = close_up_of(signals.trial, signals.message);
  const Panel panel = panel_of(signals, 2, close.from_s, close.to_s);
  draw_panel(drawing, panel, signals,
             fmt::format("{}, light of {:.1f} kHz", close.edge, signals.trial.carrier.value / 1e3),
             close.edge_s);
}

/// What the picture is of.
struct Caption {
  std::string sent, read;

  std::string whole() const { return sent + " ; " + read; }
};

Caption caption_of(const Signals& signals) {
  std::string sent, received;
  for (const UartByte& byte : signals.message.sent) sent += shown(byte);
  for (const UartByte& byte : signals.message.received)
    if (signals.message.place_of(byte)) received += shown(byte);
  const TraceOrigin& origin = signals.trial.origin;
  return {fmt::format("Point {}, trial {}, seed {}. Sent: {}", origin.point, origin.trial,
                      origin.seed, sent),
          "read at the receiver's pin: " + (received.empty() ? "nothing" : received)};
}

/// In one line where it fits, else in two that are cut where they end.
void draw_caption(SvgDrawing& drawing, const Caption& caption) {
  if (letters_in(caption.whole()) <= most_letters)
    return drawing.text({left, 24}, caption.whole(), "small");
  drawing.text({left, 18}, shortened(caption.sent, most_letters), "small");
  drawing.text({left, 36}, shortened(caption.read, most_letters), "small");
}

std::string picture_of(const Signals& signals) {
  const Caption caption = caption_of(signals);
  SvgDrawing drawing(width, first_panel + 3 * panel_height(signals), title, caption.whole());
  draw_caption(drawing, caption);
  if (signals.message.sent.empty()) return drawing.finished();
  const std::size_t character = signals.message.first_wrong().value_or(0);
  draw_message(drawing, signals);
  draw_character(drawing, signals, character);
  draw_edge(drawing, signals);
  return drawing.finished();
}

}  // namespace

std::string trace_as_picture(const TracedTrial& trial) {
  const std::vector<float> light = keyed_light(trial);
  return picture_of({trial, message_of(trial), {light_lane(trial, light)}});
}

std::string taps_as_picture(const TracedTrial& trial) {
  const std::vector<float> light = keyed_light(trial);
  std::vector<Lane> lanes = tap_lanes(trial);
  lanes.insert(lanes.begin(), light_lane(trial, light));
  return picture_of({trial, message_of(trial), std::move(lanes)});
}

}  // namespace sim
