// The operating point that tables and files print, against its own formulae.
#include "sim/link/link.hpp"

#include <cmath>

#include "gtest/gtest.h"
#include "scenarios.hpp"

namespace sim {
namespace {

// T1 through the scenario: TSAL6200 at 100 mA, 1 m, no floor: 72.3 mW/m2 (Vishay 81010 Fig. 5).
TEST(Link, IrradianceOfTheDataSheet) {
  const Link link = link_of({"floor.refractive_index=1", "floor.diffuse_reflectance=0"});
  EXPECT_NEAR(link.operating.irradiance_mw_per_m2, 72.3, 0.2);
}

// With noise of density N0 and a carrier amplitude A: SNR = A^2/2 / (N0 B), Eb/N0 = A^2/2/2 Tb /
// N0.
TEST(Link, SnrAndEbN0AreOneOperatingPoint) {
  const Link link = link_of({"device.carrier_hz=56000"});
  const double processing = 10 * std::log10(link.operating.snr_bandwidth_hz / (2 * 600.0));
  EXPECT_NEAR(link.operating.ebn0_db, link.operating.snr_db + processing, 1e-9);
  EXPECT_NEAR(link.operating.snr_bandwidth_hz, 8796, 1);
}

// 59 kHz on a 56 kHz part: -3.2 dB behind the band-pass (Vishay 82459 Fig. 5: .695).
TEST(Link, DetuningCostsSnr) {
  const double tuned = link_of({"device.carrier_hz=56000"}).operating.snr_db;
  EXPECT_NEAR(link_of({}).operating.snr_db - tuned, 20 * std::log10(0.6916), 0.01);
}

TEST(Link, PointHashFollowsThePhysicsOnly) {
  EXPECT_EQ(link_of({"stop.max_frames=7"}).point, link_of({"simulation.seed=9"}).point);
  EXPECT_NE(link_of({"receiver.range_m=2"}).point, link_of({"receiver.range_m=3"}).point);
}

TEST(Link, ClockErrorsReachTheRates) {
  const Link link = link_of({"device.clock_error_ppm=20000", "uart.clock_error_ppm=-10000"});
  EXPECT_DOUBLE_EQ(link.device_baud.value, 612);
  EXPECT_DOUBLE_EQ(link.receiver_baud.value, 594);
}

}  // namespace
}  // namespace sim
