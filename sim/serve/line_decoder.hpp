#pragma once
// LineDecoder: what a COSYS decoder at the port makes of the bytes that are played, message by
// message. It goes on from one to the next, as the reader's does: where a newline got lost, the
// next line begins with what is left of that message.
#include <string>

#include "protocol/cosys.hpp"
#include "sim/serve/line_message.hpp"

namespace sim {

struct LineVerdict {
  std::string heard;    // all bytes since the end of the message before, as escaped() shows them
  std::string outcome;  // "ok"; "undetected": a wrong one passed; else why not, as of `decode`
};

class LineDecoder {
 public:
  /// Of several lines the one that was sent counts, then one that passed, then the first. "no
  /// newline" where none has ended, "nothing" where no byte came.
  LineVerdict hear(const LineMessage& message);

 private:
  protocol::CosysDecoder decoder_;
};

}  // namespace sim
