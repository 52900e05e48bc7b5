#include "sim/guard/guard_tally.hpp"

#include <algorithm>

namespace sim {

RelayTally& RelayTally::operator+=(const RelayTally& other) {
  n_replaced += other.n_replaced;
  n_lost += other.n_lost;
  n_known += other.n_known;
  age += other.age;
  return *this;
}

GuardTally& GuardTally::operator+=(const GuardTally& other) {
  relays.resize(std::max(relays.size(), other.relays.size()));
  for (std::size_t i = 0; i < other.relays.size(); ++i) relays[i] += other.relays[i];
  n_sent += other.n_sent;
  n_accepted += other.n_accepted;
  n_asked += other.n_asked;
  n_answered += other.n_answered;
  n_timed_out += other.n_timed_out;
  return *this;
}

}  // namespace sim
