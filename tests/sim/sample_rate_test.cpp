// The sample rate of a scenario that gives none.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/loading/load_scenario.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

std::vector<double> rates_of(const std::string& text) {
  const LoadedScenario loaded = parse_scenario(text, "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"});
  std::vector<double> rates;
  for (std::size_t i = 0; i < count_points(loaded.sweep); ++i)
    rates.push_back(numbered_point(loaded, i).simulation.sample_rate_hz);
  return rates;
}

using Rates = std::vector<double>;

TEST(SampleRate, IsTheDefaultWhereThatTakesBitsAndCarrier) {
  EXPECT_EQ(rates_of(""), Rates{6e5});
  EXPECT_EQ(rates_of("device.baud = 6000\ndevice.carrier_hz = 150000\n"), Rates{6e5});
}

TEST(SampleRate, IsRaisedByFastBitsAndCarriers) {
  EXPECT_EQ(rates_of("device.baud = 9600\n"), Rates{1.2e6});
  EXPECT_EQ(rates_of("device.carrier_hz = 455000\nmodule.centre_hz = 455000\n"), Rates{2.4e6});
  EXPECT_EQ(rates_of("disturbance.x.kind = \"cosys\"\ndisturbance.x.baud = 6100\n"), Rates{1.2e6});
}

TEST(SampleRate, IsThatOfEachPoint) {
  EXPECT_EQ(rates_of("[sweep]\ndevice.baud = [9600, 600]\n"), (Rates{1.2e6, 6e5}));
}

TEST(SampleRate, ThatIsGivenHolds) {
  EXPECT_EQ(rates_of("device.baud = 9600\nsimulation.sample_rate_hz = 1e6\n"), Rates{1e6});
  EXPECT_EQ(rates_of("[sweep]\nsimulation.sample_rate_hz = [1e6, 2e6]\n"), (Rates{1e6, 2e6}));
}

}  // namespace
}  // namespace sim
