#pragma once
// The counters of a tally, one after the other, for tests that none of them is forgotten.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "sim/counting/tally.hpp"

namespace sim {

using CounterWords = std::array<std::uint64_t, offsetof(Tally, weighted) / sizeof(std::uint64_t)>;
using WeightWords = std::array<double, sizeof(Weighted) / sizeof(double)>;

using AllWords = std::array<std::uint64_t, sizeof(Tally) / sizeof(std::uint64_t)>;

inline Tally tally_of(const CounterWords& words) {
  AllWords all{};  // weights are 0
  std::ranges::copy(words, all.begin());
  return std::bit_cast<Tally>(all);
}

inline CounterWords words_of(const Tally& tally) {
  const auto all = std::bit_cast<AllWords>(tally);
  CounterWords words{};
  std::copy_n(all.begin(), words.size(), words.begin());
  return words;
}

}  // namespace sim
