#include "sim/validity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "channel/conditions.hpp"
#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "sim/disturbance.hpp"

namespace sim {
namespace {

bool beyond(const channel::Curve& curve, double at, double typical) {
  if (curve.empty()) return at != typical;
  return at < curve.x.front() || at > curve.x.back();
}

bool too_near(const Scenario& s, double) { return s.receiver.range_m < 0.05; }

bool above_emax(const Scenario& s, double irradiance) {
  return irradiance > s.module.emax_w_per_m2 * 1e3;
}

bool too_bright(const Scenario& s, double) { return ambient_of(s).value > 100; }

bool far_from_f0(const Scenario& s, double) {
  const double carrier = s.device.carrier_hz * (1 + s.device.carrier_error_ppm * 1e-6);
  return std::abs(carrier / s.module.centre_hz - 1) > 0.2;
}

bool beyond_temperature(const Scenario& s, double) {
  return beyond(s.module.emin_against_temperature, s.receiver.temperature_c, 25);
}

bool beyond_supply(const Scenario& s, double) {
  return beyond(s.module.emin_against_supply, s.receiver.supply_v, 5);
}

bool beyond_ripple(const Scenario& s, double) {
  const auto& at = channel::ripple_frequency(s.receiver.supply_ripple_at);
  return beyond(s.module.*at.emin, s.receiver.supply_ripple_mv, 0);
}

/// The longest light of a message, in cycles: bits that are 0 in a row.
double longest_burst_cycles(const Scenario& s) {
  int longest = 0, run = 0;
  for (const std::uint8_t byte : protocol::cosys_encode(s.device.message))
    for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
      run = protocol::line_bit(byte, slot) ? 0 : run + 1;
      longest = std::max(longest, run);
    }
  return longest * s.device.carrier_hz / s.device.baud;
}

bool beyond_agc_figure(const Scenario& s, double) {
  const double pinned = s.module.agc_pinned_cycles;
  return s.module.agc_attack_db_per_ms > 0 && pinned > 0 && longest_burst_cycles(s) > pinned;
}

bool continuous_current(const Scenario& s, double) { return s.led.current_ma > 200; }

constexpr std::array limits{
    ValidityLimit{"near", "nearer than 5 cm LED and module are no points to each other", too_near},
    ValidityLimit{"emax", "more light than the module's sheet allows", above_emax},
    ValidityLimit{"ambient", "more ambient light than data sheets plot (100 W/m2)", too_bright},
    ValidityLimit{"carrier", "more than 20 % off f0, where data sheets plot no response",
                  far_from_f0},
    ValidityLimit{"temperature", "the module's sheet does not show Emin there", beyond_temperature},
    ValidityLimit{"supply", "the module's sheet does not show Emin there", beyond_supply},
    ValidityLimit{"ripple", "the module's sheet does not show Emin there", beyond_ripple},
    ValidityLimit{"agc", "bursts longer than the module's sheet shows its gain control for",
                  beyond_agc_figure},
    ValidityLimit{"current", "more than an LED bears in bursts of a message (200 mA)",
                  continuous_current},
};

}  // namespace

std::span<const ValidityLimit> validity_limits() { return limits; }

std::uint64_t outside_validity(const Scenario& scenario, double irradiance_mw_per_m2) {
  std::uint64_t mask = 0;
  for (std::size_t i = 0; i < limits.size(); ++i)
    if (limits[i].left(scenario, irradiance_mw_per_m2)) mask |= std::uint64_t{1} << i;
  return mask;
}

std::string validity_names(std::uint64_t mask) {
  std::string names;
  for (std::size_t i = 0; i < limits.size(); ++i)
    if ((mask >> i & 1U) != 0) names += (names.empty() ? "" : ",") + std::string(limits[i].name);
  return names;
}

}  // namespace sim
