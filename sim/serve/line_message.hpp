#pragma once
// A device's messages one after the other on the receiver's line, as `cosys-sim serve` plays them.
//
// Message k is the counted message of trial k of the point that the scenario then is, from the end
// of the message before it (the trial's last warm-up message) to its own end; these stretches, each
// a pause and a message, follow one another without a gap. So its random numbers are those of
// `cosys-sim trace --trial k` and of the k-th frame of a run: RandomAddress (seed, hash of the
// point, trial k, purpose), see sim/trial/trial.hpp. They depend on no other message, no clock and
// no processor; where a key is changed between messages, the point's hash changes with it.
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "dsp/units.hpp"
#include "sim/link/link.hpp"

namespace sim {

/// A byte of a UART at its pin; `at` is the middle of its stop bit, when a UART has it.
struct LineByte {
  dsp::Seconds at;
  std::uint8_t value = 0;
  bool framing_error = false;

  bool operator==(const LineByte&) const = default;
};

/// All times from the end of the message before.
struct LineMessage {
  std::uint32_t number = 0;
  std::string sent;             // the device message
  dsp::Seconds start;           // of its first character
  dsp::Seconds end;             // of its last character; the next message's time 0
  std::vector<LineByte> bytes;  // in the order of time: those whose start bit is heard before `end`
};

/// The link has warm-up messages. Worth nothing once `stop` is true: it then gives up soon.
LineMessage make_line_message(const Link& link, std::uint32_t number,
                              const std::atomic<bool>& stop);

}  // namespace sim
