#include "sim/shared_link/shared_link_tally.hpp"

#include <algorithm>

namespace sim {
namespace {

constexpr double ci_level = 0.95;

}  // namespace

AgeCounts DirectionTally::age() const {
  AgeCounts sum;
  for (const AgeCounts& age : variable_ages) sum += age;
  return sum;
}

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
  losses += other.losses;
  variable_ages.resize(std::max(variable_ages.size(), other.variable_ages.size()));
  for (std::size_t i = 0; i < other.variable_ages.size(); ++i)
    variable_ages[i] += other.variable_ages[i];
  return *this;
}

SharedLinkTally& SharedLinkTally::operator+=(const SharedLinkTally& other) {
  for (std::size_t i = 0; i < direction.size(); ++i) direction[i] += other.direction[i];
  losses += other.losses;
  n_runs += other.n_runs;
  return *this;
}

DirectionTally together(const SharedLinkTally& tally) {
  DirectionTally sum = tally.direction[0];
  sum += tally.direction[1];
  sum.losses = tally.losses;
  return sum;
}

Estimate message_loss(const DirectionTally& tally) {
  return clustered_ratio(tally.losses, ci_level);
}

double bit_error_ratio(const DirectionTally& tally) {
  return ratio(tally.n_bit_errors, tally.n_bits);
}

}  // namespace sim
