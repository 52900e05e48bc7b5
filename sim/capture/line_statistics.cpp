#include "sim/capture/line_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sim {
namespace {

using dsp::Seconds;
using protocol::line_bit;

struct Point {
  double slot, rising, excess_s;
};

Point mean_of(std::span<const Point> points) {
  Point mean{};
  for (const Point& p : points) {
    mean.slot += p.slot;
    mean.rising += p.rising;
    mean.excess_s += p.excess_s;
  }
  const auto n = static_cast<double>(points.size());
  return {mean.slot / n, mean.rising / n, mean.excess_s / n};
}

}  // namespace

void LineStatistics::add(std::span<const Seconds> edges,
                         std::span<const protocol::UartByte> bytes) {
  for (const Seconds edge : edges) {
    level_ = !level_;
    edges_.push_back({edge, level_});
  }
  for (const protocol::UartByte& byte : bytes) add_byte(byte);
  const Seconds character = protocol::bits_per_byte * dsp::period(baud_);
  if (!edges_.empty()) forget_before(edges_.back().at - 2 * character);
}

void LineStatistics::forget_before(Seconds start) {
  while (!edges_.empty() && edges_.front().at < start) edges_.pop_front();
}

void LineStatistics::add_byte(const protocol::UartByte& byte) {
  ++characters_;
  framing_errors_ += byte.framing_error ? 1 : 0;
  if (!byte.framing_error) add_edges(byte);
}

/// From the last fall up to where the receiver saw the start: one that samples sees it late.
void LineStatistics::add_edges(const protocol::UartByte& byte) {
  const auto after = std::ranges::upper_bound(edges_, byte.start, {}, &Edge::at);
  const auto fall = std::find_if(std::reverse_iterator(after), edges_.rend(),
                                 [](const Edge& edge) { return !edge.rising; });
  if (fall == edges_.rend()) return;
  auto edge = std::prev(fall.base());
  const Seconds start = edge->at, bit = dsp::period(baud_);
  std::array<Point, protocol::bits_per_byte> points;
  std::size_t count = 0;
  for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
    const bool level = line_bit(byte.value, slot);
    if (level == (slot == 0 || line_bit(byte.value, slot - 1))) continue;
    if (edge == edges_.end() || edge->rising != level) return;
    const double excess = (edge->at - start - slot * bit).value;
    if (std::abs(excess) > 0.5 * bit.value) return;
    points[count++] = {static_cast<double>(slot), level ? 1.0 : 0.0, excess};
    ++edge;
  }
  if (edge != edges_.end() && edge->at < start + protocol::stop_slot * bit) return;
  const std::span all(points.data(), count);
  const Point mean = mean_of(all);
  for (const Point& p : all) {
    const double k = p.slot - mean.slot, r = p.rising - mean.rising, x = p.excess_s - mean.excess_s;
    kk_ += k * k;
    kr_ += k * r;
    rr_ += r * r;
    kx_ += k * x;
    rx_ += r * x;
    xx_ += x * x;
  }
  edge_count_ += static_cast<double>(count);
  ++fitted_;
}

std::optional<LineFit> LineStatistics::fit() const {
  const double freedom = edge_count_ - fitted_ - 2, determinant = kk_ * rr_ - kr_ * kr_;
  if (freedom < 4 || determinant < 1e-6 * kk_ * rr_) return std::nullopt;
  const double slope = (kx_ * rr_ - rx_ * kr_) / determinant;
  const double step = (rx_ * kk_ - kx_ * kr_) / determinant;
  const double squares = std::max(0.0, xx_ - slope * kx_ - step * rx_);
  return LineFit{dsp::Hertz(1 / (dsp::period(baud_).value + slope)), Seconds(step),
                 Seconds(std::sqrt(squares / freedom))};
}

}  // namespace sim
