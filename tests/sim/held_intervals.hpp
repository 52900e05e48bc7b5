#pragma once
// How often the intervals that the program prints hold the truth: an experiment is repeated with
// other seeds, and a row of the table of held intervals (DECISIONS.md) is printed. In the gate
// each row has a few seeds, in the weekly run 40 at least, with COSYS_SEEDS=1000 so many
// (tests/held_intervals).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <optional>
#include <string>

#include "sanitized.hpp"
#include "sim/counting/statistics.hpp"

namespace held {

/// An interval as it is printed, and what it should hold.
struct Printed {
  double low = 0, high = 0, truth = 0;
};

struct Row {
  std::string interval;  // "range fitted to a sweep"
  std::string setting;   // what is repeated: "decision, Eb/N0 11:0.05:13 dB, -n 1000"
  int gate_seeds = 20;   // as many as take a second or two; four show what never holds
  double least = 0.93, most = 0.97;
};

/// What an experiment says with a seed; none where it prints no such interval.
using Experiment = std::function<std::optional<Printed>(std::uint64_t seed)>;

struct Count {
  int seeds = 0, printed = 0, held = 0;
  int above = 0, below = 0;  // the truth lay beyond that end

  double share() const { return printed == 0 ? 0 : static_cast<double>(held) / printed; }
};

inline int seeds_of(const Row& row) {
  const char* const wanted = std::getenv("COSYS_SEEDS");
  if (wanted != nullptr) return std::atoi(wanted);
  return sim::test::is_set("COSYS_WEEKLY") ? std::max(row.gate_seeds, 40) : row.gate_seeds;
}

inline Count tried_with_seeds(const Row& row, const Experiment& experiment) {
  Count counted;
  for (counted.seeds = 0; counted.seeds < seeds_of(row); ++counted.seeds) {
    const auto printed = experiment(static_cast<std::uint64_t>(counted.seeds) + 1);
    if (!printed) continue;
    ++counted.printed;
    counted.above += printed->truth > printed->high;
    counted.below += printed->truth < printed->low;
  }
  counted.held = counted.printed - counted.above - counted.below;
  return counted;
}

inline void print(const Row& row, const Count& count) {
  std::cout << fmt::format("| {} | {} | {} of {} | {:.1f} % | {}, {} |\n", row.interval,
                           row.setting, count.held, count.printed, 100 * count.share(), count.below,
                           count.above);
}

/// The share that it held is what chance makes of one between `least` and `most`, but once in ten
/// thousand tries.
inline void expect_to_hold(const Row& row, const Experiment& experiment) {
  const Count counted = tried_with_seeds(row, experiment);
  print(row, counted);
  EXPECT_GT(counted.printed, 0) << row.setting;
  const auto chance = sim::clopper_pearson(counted.held, counted.printed, 0.9999);
  EXPECT_GE(chance.high, row.least) << row.setting;
  EXPECT_LE(chance.low, row.most) << row.setting;
}

}  // namespace held
