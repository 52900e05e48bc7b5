#include "sim/threads/random_spells.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sim {
namespace {

using dsp::Seconds;

constexpr SpellTimes times{Seconds(3), Seconds(1)};

TEST(RandomSpells, AreThereAtTheFirstLookAsOftenAsLater) {
  constexpr std::uint32_t trials = 20000;
  int at_once = 0, later = 0;
  for (std::uint32_t i = 0; i < trials; ++i) {
    RandomSpells spells(times, {.seed = 1, .trial = i}, Seconds(-2));
    at_once += spells.has(Seconds(-2)) ? 1 : 0;
    later += spells.has(Seconds(0.5)) ? 1 : 0;
  }
  constexpr double share = 0.25;
  const double five_deviations = 5 * std::sqrt(share * (1 - share) / trials);
  EXPECT_NEAR(at_once / double{trials}, share, five_deviations);
  EXPECT_NEAR(later / double{trials}, share, five_deviations);
}

TEST(RandomSpells, LastAsLongAsTheyShould) {
  constexpr int steps = 4'000'000;
  constexpr Seconds step(0.01);
  RandomSpells spells(times, {.seed = 2}, Seconds(0));
  int begun = 0, within = 0;
  bool before = true;  // of the first only the rest is seen
  for (int i = 0; i < steps; ++i) {
    const bool now = spells.has(i * step);
    begun += now && !before ? 1 : 0;
    within += now ? 1 : 0;
    before = now;
  }
  const double five_deviations = 5 / std::sqrt(begun);
  EXPECT_NEAR(within * step.value / begun, 1, five_deviations);
  EXPECT_NEAR(begun, steps * step.value / 4, 5 * std::sqrt(begun));
}

TEST(RandomSpells, NeverComeWhereThereAreNone) {
  RandomSpells spells({Seconds(0), Seconds(1)}, {.seed = 3}, Seconds(0));
  EXPECT_FALSE(spells.has(Seconds(0)));
  EXPECT_FALSE(spells.has(Seconds(1e9)));
  EXPECT_EQ(time_between_spells({Seconds(0), Seconds(1)}), 1);
  EXPECT_EQ(time_between_spells(times), 0.75);
}

}  // namespace
}  // namespace sim
