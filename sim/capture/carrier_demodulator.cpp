#include "sim/capture/carrier_demodulator.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace sim {
namespace {

using dsp::Hertz;
using dsp::Seconds;

constexpr std::size_t edges_ahead = 32768, fewest_periods = 64;
constexpr Hertz lowest_keyed{20e3}, highest_keyed{500e3};
constexpr double tolerance = 0.3, least_share_of_periods = 0.75;
constexpr double cycles_a_gap = 3;   // a bit has many more
constexpr double most_alone = 0.01;  // of all edges

std::vector<double> periods_of(const std::deque<Seconds>& edges) {
  std::vector<double> periods;
  for (std::size_t i = 2; i < edges.size(); ++i) periods.push_back((edges[i] - edges[i - 2]).value);
  return periods;
}

/// Of edges that are in no burst.
double share_alone(const std::deque<Seconds>& edges, Hertz carrier) {
  const Seconds gap = cycles_a_gap * dsp::period(carrier);
  std::size_t alone = 0;
  for (std::size_t i = 1; i + 1 < edges.size(); ++i)
    alone += edges[i] - edges[i - 1] > gap && edges[i + 1] - edges[i] > gap ? 1 : 0;
  return static_cast<double>(alone) / static_cast<double>(edges.size());
}

/// The mean of the periods that are near their median, which rounding does not move.
Hertz carrier_on(const std::deque<Seconds>& edges) {
  std::vector<double> periods = periods_of(edges);
  if (periods.size() < fewest_periods) return Hertz(0);
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::ranges::nth_element(periods, middle);
  const double median = *middle;
  double sum = 0, count = 0;
  for (const double period : periods) {
    if (period < (1 - tolerance) * median || period > (1 + tolerance) * median) continue;
    sum += period;
    ++count;
  }
  if (sum <= 0 || count < least_share_of_periods * static_cast<double>(periods.size()))
    return Hertz(0);
  const Hertz carrier(count / sum);
  const bool is_keyed = carrier >= lowest_keyed && carrier <= highest_keyed &&
                        share_alone(edges, carrier) <= most_alone;
  return is_keyed ? carrier : Hertz(0);
}

}  // namespace

CarrierDemodulator::CarrierDemodulator(EdgeSource& wire, std::optional<Hertz> carrier)
    : wire_(wire) {
  if (carrier) {
    carrier_ = *carrier;
    return;
  }
  while (ahead_.size() < edges_ahead) {
    const auto edge = wire_.next();
    if (!edge) break;
    ahead_.push_back(*edge);
  }
  carrier_ = carrier_on(ahead_);
}

std::optional<Seconds> CarrierDemodulator::next_edge() {
  if (ahead_.empty()) return wire_.next();
  const Seconds edge = ahead_.front();
  ahead_.pop_front();
  return edge;
}

std::optional<Seconds> CarrierDemodulator::next() {
  if (carrier_.value == 0) return next_edge();
  if (!last_) {
    last_ = following_ ? std::exchange(following_, std::nullopt) : next_edge();
    return last_;  // a burst begins
  }
  while (const auto edge = next_edge()) {
    if (*edge - *last_ > cycles_a_gap * dsp::period(carrier_)) {
      following_ = edge;
      break;
    }
    last_ = edge;
  }
  return std::exchange(last_, std::nullopt);
}

/// A burst may go on behind its last edge so far; behind its end nothing was read but the next.
Seconds CarrierDemodulator::known_until() const {
  if (!ahead_.empty()) return ahead_.front();
  return last_ ? *last_ : following_.value_or(wire_.known_until());
}

}  // namespace sim
