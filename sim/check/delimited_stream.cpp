#include "sim/check/delimited_stream.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "sim/text/digest.hpp"
#include "sim/trial/heard_trials.hpp"

namespace sim {
namespace {

constexpr dsp::Seconds longest_pause(0.1);          // heard before a message
constexpr std::string_view marker_word = "MARK #";  // no number that could be a checksum
constexpr int idle_characters = 2;                  // whatever a UART is at is over then

/// Appends piece after piece to a wire.
class LineMaker {
 public:
  explicit LineMaker(dsp::Hertz baud) : baud_(baud) { be_idle(idle_characters); }

  void add_marker(std::uint32_t number) {
    add_byte('\n');
    for (const std::uint8_t byte : protocol::cosys_encode(marker(number))) add_byte(byte);
    be_idle(idle_characters);
  }

  /// `pin` from then until its end, its times that many times as long.
  void add_pin(const dsp::LogicTrace& pin, dsp::Seconds from, double scale) {
    wire_.set_at(at_, pin.level_at(from));
    const auto edges = pin.edges();
    for (auto edge = std::ranges::upper_bound(edges, from); edge != edges.end(); ++edge)
      wire_.add_edge(at_ + (*edge - from) * scale);
    at_ += (pin.end() - from) * scale;
    wire_.set_at(at_, true);
  }

  dsp::Seconds now() const { return at_; }

  void be_idle(double characters) {
    at_ += characters * protocol::bits_per_byte * dsp::period(baud_);
    wire_.observe_until(at_);
  }

  dsp::LogicTrace take() { return std::move(wire_); }

 private:
  void add_byte(std::uint8_t byte) { at_ = protocol::send_byte(wire_, byte, at_, baud_); }

  dsp::Hertz baud_;
  dsp::LogicTrace wire_;
  dsp::Seconds at_{0};
};

/// From when on a trial's pin is in the line.
dsp::Seconds beginning_of_frame(const Link& link, const Transmission& sent) {
  const auto& messages = sent.messages;
  const dsp::Seconds start = messages.back().byte_start.front();
  const dsp::Seconds before =
      messages.size() < 2 ? dsp::Seconds(0) : messages[messages.size() - 2].end + link.delay;
  return std::min(start, std::max(before, start - longest_pause));
}

std::uint64_t light_of_frame(const dsp::LogicTrace& pin, dsp::Seconds from) {
  const auto edges = pin.edges();
  const auto first = std::ranges::upper_bound(edges, from);
  std::string bytes(1, pin.level_at(from) ? '1' : '0');
  for (auto edge = first; edge != edges.end(); ++edge) {
    const double at = edge->value;
    bytes.append(reinterpret_cast<const char*>(&at), sizeof at);
  }
  return hash_of(bytes);
}

/// UARTs run on clocks of their own: messages come at any phase of theirs.
double idle_before(const Link& link, std::uint32_t trial) {
  return address(link, trial, Purpose::uart_phase).uniform(0);
}

/// `scale`: of true times on the receiver's clock; `from`: when the pin's piece begins, `at` on the
/// wire.
FrameOnLine frame_on_line(const Link& link, const SentMessage& sent, dsp::Seconds from,
                          dsp::Seconds at, double scale) {
  FrameOnLine frame{.from = at, .to = at, .byte_start = {}, .bit = {}};
  frame.bit = dsp::period(link.device_baud) * scale;
  for (const dsp::Seconds start : sent.byte_start)
    frame.byte_start.push_back(at + (start + link.delay - from) * scale);
  return frame;
}

void add_trials(LineMaker& maker, DelimitedStream& line, const JudgedLink& judged,
                std::uint32_t first, const HeardTrials& heard) {
  const Link& link = judged.link;
  const double scale = link.receiver_baud.value / judged.baud.value;
  for (std::size_t i = 0; i < heard.sent.size(); ++i) {
    const auto trial = first + static_cast<std::uint32_t>(i);
    const dsp::Seconds from = beginning_of_frame(link, heard.sent[i]);
    maker.add_marker(trial);
    maker.be_idle(idle_before(link, trial));
    line.frames.push_back(
        frame_on_line(link, heard.sent[i].messages.back(), from, maker.now(), scale));
    maker.add_pin(heard.pins[i], from, scale);
    line.frames.back().to = maker.now();
    line.frames.back().light = light_of_frame(heard.pins[i], from);
    maker.be_idle(idle_characters);
  }
}

std::optional<std::uint32_t> number_of_marker(std::string_view message) {
  if (!message.starts_with(marker_word)) return std::nullopt;
  message.remove_prefix(marker_word.size());
  std::uint32_t number = 0;
  const char* end = message.data() + message.size();
  const auto [stopped, error] = std::from_chars(message.data(), end, number);
  if (error != std::errc{} || stopped != end) return std::nullopt;
  return number;
}

}  // namespace

DelimitedStream hear_delimited(const JudgedLink& judged, std::uint32_t first, int n,
                               const std::atomic<bool>* stop) {
  constexpr int at_once = 64;
  DelimitedStream line{.wire = dsp::LogicTrace(),
                       .baud = judged.baud,
                       .first = first,
                       .frames = {},
                       .uart = judged.link.uart};
  LineMaker maker(judged.baud);
  for (int done = 0; done < n; done += at_once) {
    const auto from = first + static_cast<std::uint32_t>(done);
    add_trials(maker, line, judged, from,
               hear_trials(judged.link, from, std::min(at_once, n - done), stop));
  }
  maker.add_marker(first + static_cast<std::uint32_t>(n));
  line.wire = maker.take();
  return line;
}

DelimitedStream mark(const JudgedLink& judged, std::uint32_t trial, const dsp::LogicTrace& pin) {
  LineMaker maker(judged.baud);
  maker.add_marker(trial);
  maker.be_idle(idle_before(judged.link, trial));
  const dsp::Seconds from = maker.now();
  maker.add_pin(pin, dsp::Seconds(0), judged.link.receiver_baud.value / judged.baud.value);
  const FrameOnLine whole{.from = from, .to = maker.now(), .byte_start = {}, .bit = {}};
  maker.be_idle(idle_characters);
  maker.add_marker(trial + 1);
  return {.wire = maker.take(),
          .baud = judged.baud,
          .first = trial,
          .frames = {whole},
          .uart = judged.link.uart};
}

std::string marker(std::uint32_t number) {
  return std::string(marker_word) + std::to_string(number);
}

bool is_like_marker(const std::string& message) { return number_of_marker(message).has_value(); }

std::vector<FrameOutcome> outcomes_between_markers(const std::vector<std::string>& accepted,
                                                   const std::string& message, std::uint32_t first,
                                                   std::size_t n) {
  std::vector<FrameOutcome> outcomes(n, {.unknown = true});
  std::optional<std::size_t> frame;  // that the last marker opened
  FrameOutcome outcome;
  for (const std::string& text : accepted) {
    const auto number = number_of_marker(text);
    if (!number) {
      const bool is_first = text == message && !outcome.delivered;
      (is_first ? outcome.delivered : outcome.undetected_error) = true;
      continue;
    }
    const std::size_t opened = std::size_t{*number} - first;
    if (*number < first || opened > n || (frame && opened <= *frame)) continue;
    if (frame && opened == *frame + 1) outcomes[*frame] = outcome;
    frame = opened;
    outcome = {};
  }
  return outcomes;
}

std::optional<std::vector<std::string>> accepted_between_markers(
    const std::vector<std::string>& accepted, std::uint32_t trial) {
  const auto opened = std::ranges::find(accepted, marker(trial));
  const auto closed = std::find(opened, accepted.end(), marker(trial + 1));
  if (closed == accepted.end()) return std::nullopt;
  return std::vector<std::string>(opened + 1, closed);
}

}  // namespace sim
