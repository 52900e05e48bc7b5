#pragma once
// A decoder of COSYS messages that uses what is known of them: all characters of a sending have one
// bit period, start, stop and eighth bits their level, lines their checksum, and devices say the
// same again. Plain receivers decide bit by bit; this one decides for the line whose light differs
// least from what was seen, if that is little and any other line's much more (SoftJudge).
#include <span>
#include <vector>

#include "dsp/logic_trace.hpp"
#include "protocol/light_pulses.hpp"
#include "protocol/soft_line_finder.hpp"

namespace protocol {

/// Messages come once the wire was idle behind them for two and a half characters. Memory is that
/// of the longest line, and of no more than some thousand pulses without such a pause.
class SoftDecoder {
 public:
  SoftDecoder(dsp::Hertz baud, SoftMemory memory, bool initial = true);

  /// A wire that goes on: its edges since the last call and until when it is known now.
  std::vector<SoftMessage> take(std::span<const dsp::Seconds> edges, dsp::Seconds known_until);
  /// What is left at the wire's end, as if it were idle from there on.
  std::vector<SoftMessage> finish();

 private:
  void fall(dsp::Seconds t);
  void end_burst();
  void give_up_pause();
  void take_characters(const std::vector<SoftCharacter>& characters);
  bool is_paused(dsp::Seconds until, double bits) const;

  dsp::Seconds bit_;
  bool level_;
  bool after_long_pause_ = true;   // the burst is
  std::vector<LightPulse> burst_;  // since a pause; the last has no rise yet while there is light
  dsp::Seconds last_rise_;
  SoftLineFinder finder_;
  std::vector<SoftMessage> accepted_;
};

/// Of a whole wire.
std::vector<SoftMessage> decode_soft(const dsp::LogicTrace& line, dsp::Hertz baud,
                                     SoftMemory memory);

}  // namespace protocol
