#include "sim/serve/line_decoder.hpp"

#include <algorithm>
#include <vector>

#include "sim/text/escaped_text.hpp"

namespace sim {
namespace {

using protocol::CosysFrame, protocol::CosysOutcome;

std::string outcome_of(const std::vector<CosysFrame>& frames, const LineMessage& message) {
  const auto passed = [](const CosysFrame& frame) { return frame.outcome == CosysOutcome::ok; };
  const auto as_sent = [&](const CosysFrame& frame) {
    return passed(frame) && frame.message == message.sent;
  };
  if (std::ranges::any_of(frames, as_sent)) return "ok";
  if (std::ranges::any_of(frames, passed)) return "undetected";
  if (!frames.empty()) return std::string(name(frames.front().outcome));
  return message.bytes.empty() ? "nothing" : "no newline";
}

}  // namespace

LineVerdict LineDecoder::hear(const LineMessage& message) {
  std::string heard;
  std::vector<CosysFrame> frames;
  for (const LineByte& byte : message.bytes) {
    heard += static_cast<char>(byte.value);
    if (auto frame = decoder_.push({byte.at, byte.value, byte.framing_error}))
      frames.push_back(std::move(*frame));
  }
  return {escaped(heard), outcome_of(frames, message)};
}

}  // namespace sim
