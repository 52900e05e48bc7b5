#pragma once
// Which channel of a capture is read, be it a wire or an analogue one: the one that was asked for,
// else by what is on them. A channel without an edge is never preferred. One that is called rx (in
// any case, at the end of its name too) comes before others, then one with whole messages (of
// several one that is not called tx), then the one whose characters make most sense.
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/capture/autobaud.hpp"
#include "sim/capture/logic_capture.hpp"

namespace sim {

/// What the user says of the line.
struct LineHints {
  std::optional<bool> inverted;
  std::optional<dsp::Hertz> baud, carrier;
};

/// A channel, as far as it was looked at.
struct ChannelSurvey {
  std::string name;
  std::uint64_t n_edges = 0;
  LineFacts facts{};
  std::vector<dsp::Seconds> edges{};  // by which channels that are one and the same are known
  bool is_surveyed = false;           // else edges alone are known
};

/// "rx", "D1 RX", "top.uart.rxd", but not "proxy".
bool is_called_rx(const std::string& name);

/// Of a channel's line, up to its first 32768 edges.
ChannelSurvey survey_of(std::string name, EdgeSource& line, const LineHints& hints);

struct ChannelChoice {
  std::size_t channel = 0;
  std::optional<std::size_t> rival;  // another line that reads as well
};

/// By what is on them; there is at least one.
ChannelChoice choice_of_channel(std::span<const ChannelSurvey> channels);

/// A channel that is called rx and has no edge, where the one that is taken is called otherwise:
/// of a receiver that hears nothing, what was sent is no answer. Else null.
const ChannelSurvey* dead_receiver(std::span<const ChannelSurvey> channels, std::size_t taken);

struct WireSurveys {
  std::vector<ChannelSurvey> wires;
  bool is_whole = false;  // all of the capture was looked at
};

/// Of each wire of a capture, by the first fifty million levels at most: its line, by the first
/// 400 000 edges of its own, however many a clock beside it has (fewer where many wires have as
/// many). Of more than a hundred wires that have edges those are looked at that are called rx, then
/// those of most edges.
WireSurveys surveys_of(LogicCapture& capture, const LineHints& hints);

/// The channel of this name, in any case and without the range of one bit ("rx" for "rx[0:0]")
/// where no other is so called, or of this number, the first being 1, where no name is a number.
/// Throws bad_input, naming all, or the nearest of many.
std::size_t named_channel(const std::vector<std::string>& channels, const std::string& wanted,
                          const std::string& file);

/// A capture whose beginning is looked at before it is read from the start on: the first half
/// million levels, in bounded memory.
class SurveyedCapture : public LogicCapture {
 public:
  explicit SurveyedCapture(std::unique_ptr<LogicCapture> capture);

  const std::vector<std::string>& wires() const override { return capture_->wires(); }
  std::optional<WireLevel> next() override;
  dsp::Seconds now() const override;
  dsp::Seconds resolution() const override { return capture_->resolution(); }

  /// Of each wire, its changes.
  std::vector<std::uint64_t> edges() const;
  /// Of each wire, as surveys_of() has it.
  std::vector<ChannelSurvey> surveys(const LineHints& hints) const;
  /// Whether all of the capture was looked at.
  bool is_whole() const { return whole_; }

 private:
  void read_ahead();

  std::unique_ptr<LogicCapture> capture_;
  std::deque<WireLevel> ahead_;
  dsp::Seconds now_, end_;
  bool whole_ = false, is_played_ = false;  // read to its end; played back to where reading stopped
};

}  // namespace sim
