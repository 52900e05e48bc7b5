#include "sim/serve/line_player.hpp"

namespace sim {

void LinePlayer::push(const LineMessage& message, dsp::Seconds origin) {
  for (LineByte byte : message.bytes) {
    byte.at += origin;
    waiting_.push_back(byte);
  }
}

dsp::Seconds LinePlayer::next() const {
  if (waiting_.empty()) return dsp::Seconds(std::numeric_limits<double>::infinity());
  return waiting_.front().at;
}

protocol::Bytes LinePlayer::take_due(dsp::Seconds now) {
  protocol::Bytes due;
  for (; !waiting_.empty() && waiting_.front().at <= now; waiting_.pop_front())
    due.push_back(waiting_.front().value);
  return due;
}

}  // namespace sim
