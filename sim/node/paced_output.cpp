#include "sim/node/paced_output.hpp"

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

constexpr dsp::Seconds try_again_after(0.02);

}  // namespace

PacedOutput::PacedOutput(dsp::Hertz baud)
    : byte_time_(protocol::bits_per_byte * dsp::period(baud)) {}

void PacedOutput::push(const protocol::Bytes& messages, dsp::Seconds now) {
  if (is_empty()) free_at_ = std::max(free_at_, now);
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(at_));
  at_ = 0;
  bytes_.insert(bytes_.end(), messages.begin(), messages.end());
}

std::span<const std::uint8_t> PacedOutput::due(dsp::Seconds now) const {
  if (is_empty() || now < free_at_) return {};
  const double room = 1 + std::floor((now - free_at_) / byte_time_);
  const auto left = static_cast<double>(bytes_.size() - at_);
  return std::span(bytes_).subspan(at_, static_cast<std::size_t>(std::min(room, left)));
}

void PacedOutput::take(std::size_t bytes, dsp::Seconds now) {
  stuck_ = bytes < due(now).size();
  at_ += bytes;
  if (bytes > 0) begun_ = bytes_[at_ - 1] != '\n';
  free_at_ = stuck_ ? now + try_again_after : free_at_ + static_cast<double>(bytes) * byte_time_;
}

std::size_t PacedOutput::drop_unbegun() {
  const auto next = bytes_.begin() + static_cast<std::ptrdiff_t>(at_);
  const auto end = begun_ ? std::find(next, bytes_.end(), '\n') + 1 : next;
  const auto dropped = std::count(end, bytes_.end(), '\n');
  bytes_.erase(end, bytes_.end());
  return static_cast<std::size_t>(dropped);
}

}  // namespace sim
