// Cosine and sine of a phase word against the library's, in all quadrants; lanes equal float.
#include "dsp/whole_turn.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace {

dsp::Phasor<float> turn(std::uint32_t phase) { return dsp::whole_turn<float>(phase); }

TEST(WholeTurn, AgreesWithTheLibrary) {
  std::mt19937 random(3);
  for (int i = 0; i < 100000; ++i) {
    const auto phase = static_cast<std::uint32_t>(random());
    const double angle = 2 * std::numbers::pi * 0x1p-32 * phase;
    ASSERT_NEAR(turn(phase).cosine, std::cos(angle), 5e-7) << phase;
    ASSERT_NEAR(turn(phase).sine, std::sin(angle), 5e-7) << phase;
  }
}

TEST(WholeTurn, MeetsTheAxes) {
  EXPECT_NEAR(turn(0).cosine, 1, 1e-7);
  EXPECT_NEAR(turn(1u << 30).sine, 1, 1e-7);
  EXPECT_NEAR(turn(1u << 31).cosine, -1, 1e-7);
  EXPECT_NEAR(turn(3u << 30).sine, -1, 1e-7);
  for (const std::uint32_t quadrant : {0u, 1u, 2u, 3u}) {
    const auto [cosine, sine] = turn(quadrant << 30);
    EXPECT_NEAR(std::fabs(cosine * sine), 0, 1e-7) << quadrant;
  }
}

TEST(WholeTurn, LanesAreEachAlone) {
  std::mt19937 random(4);
  for (int i = 0; i < 1000; ++i) {
    dsp::Words8 phase(0u);
    for (int lane = 0; lane < 8; ++lane)
      dsp::set_lane(phase, lane, static_cast<std::uint32_t>(random()));
    const auto all = dsp::whole_turn<dsp::Lanes8>(phase);
    for (int lane = 0; lane < 8; ++lane) {
      const auto one = turn(dsp::lane(phase, lane));
      ASSERT_EQ(dsp::lane(all.cosine, lane), one.cosine);
      ASSERT_EQ(dsp::lane(all.sine, lane), one.sine);
    }
  }
}

}  // namespace
