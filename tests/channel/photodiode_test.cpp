#include "channel/photodiode.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bpw34.hpp"

namespace channel {
namespace {

TEST(Photodiode, Bpw34GivesTheSheetsCurrent) {  // A1: 1 mW/cm2 is 10 W/m2
  EXPECT_NEAR(photocurrent(bpw34, dsp::WattsPerSquareMetre(10)).value, 50e-6, 0.05e-6);
}

TEST(Photodiode,
     Bpw34HasTheSheetsNoise) {  // A1: printed 4e-14 W/sqrt(Hz); dark shot noise: 3.8e-14
  EXPECT_NEAR(noise_equivalent_power(bpw34), 3.8e-14, 0.05e-14);
}

TEST(Photodiode, ShotNoiseOfAMicroampere) {  // sqrt(2 q 1 uA) = 0.566 pA/sqrt(Hz)
  PhotodiodeData dark = bpw34;
  dark.dark_current_na = 0;
  EXPECT_NEAR(std::sqrt(shot_noise_density(dark, dsp::Amperes(1e-6))), 0.566e-12, 5e-16);
  EXPECT_NEAR(
      shot_noise_density(bpw34, dsp::Amperes(1e-6)) / shot_noise_density(dark, dsp::Amperes(1e-6)),
      1.002, 1e-9);
}

TEST(Photodiode, SeesHalfAtTheHalfAngleAndNothingBehind) {
  EXPECT_EQ(relative_sensitivity(bpw34, {}), 1);
  EXPECT_NEAR(relative_sensitivity(bpw34, dsp::degrees(65)), .5, 1e-12);
  EXPECT_EQ(relative_sensitivity(bpw34, dsp::degrees(90.1)), 0);
}

}  // namespace
}  // namespace channel
