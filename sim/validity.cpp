#include "sim/validity.hpp"

#include <array>
#include <cmath>
#include <cstddef>

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

bool too_bright(const Scenario& s, double) { return s.ambient.irradiance_w_per_m2 > 100; }

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
  return beyond(s.module.emin_against_ripple, s.receiver.supply_ripple_mv, 0);
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
