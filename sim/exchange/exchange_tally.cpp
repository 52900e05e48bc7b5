#include "sim/exchange/exchange_tally.hpp"

#include <limits>

namespace sim {
namespace {

constexpr double ci_level = 0.95;
constexpr double unset = std::numeric_limits<double>::quiet_NaN();

}  // namespace

DirectionTally& DirectionTally::operator+=(const DirectionTally& other) {
  n_sent += other.n_sent;
  n_accepted += other.n_accepted;
  n_bits += other.n_bits;
  n_bit_errors += other.n_bit_errors;
  n_asked += other.n_asked;
  n_answered += other.n_answered;
  n_timed_out += other.n_timed_out;
  n_own += other.n_own;
  for (std::size_t i = 0; i < rejected.size(); ++i) {
    own_damaged[i] += other.own_damaged[i];
    rejected[i] += other.rejected[i];
  }
  age += other.age;
  return *this;
}

ExchangeTally& ExchangeTally::operator+=(const ExchangeTally& other) {
  for (std::size_t i = 0; i < direction.size(); ++i) direction[i] += other.direction[i];
  n_runs += other.n_runs;
  return *this;
}

DirectionTally together(const ExchangeTally& tally) {
  DirectionTally sum = tally.direction[0];
  return sum += tally.direction[1];
}

Estimate message_loss(const DirectionTally& tally) {
  if (tally.n_sent == 0) return {unset, unset, unset};
  const auto sent = static_cast<double>(tally.n_sent);
  const double lost = sent - static_cast<double>(tally.n_accepted);
  const Interval interval = clopper_pearson(lost, sent, ci_level);
  return {lost / sent, interval.low, interval.high};
}

double bit_error_ratio(const DirectionTally& tally) {
  return ratio(tally.n_bit_errors, tally.n_bits);
}

}  // namespace sim
