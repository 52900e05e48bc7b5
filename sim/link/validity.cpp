#include "sim/link/validity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "channel/conditions.hpp"
#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/link/theory.hpp"
#include "sim/scenario/disturbance_keys.hpp"
#include "sim/scenario/fidelity.hpp"

namespace sim {
namespace {

bool beyond(const channel::Curve& curve, double at, double typical) {
  if (curve.empty()) return at != typical;
  return at < curve.x.front() || at > curve.x.back();
}

bool too_near(const Scenario& s, const OperatingPoint&) { return s.receiver.range_m < 0.05; }

/// Light of the floor's mirror image meets the direct one within their coherence length (29 um of
/// an LED 30 nm wide), and a fringe of the two is wider than the module's lens.
bool fringes(const Scenario& s, const OperatingPoint&) {
  if (s.floor.refractive_index == 1 && s.floor.metal_reflectance == 0) return false;
  const double heights = (s.led.height_mm + s.receiver.height_mm) * 1e-3;
  const double difference =
      2e-6 * s.led.height_mm * s.receiver.height_mm / s.receiver.range_m;  // of the paths, m
  const double fringe = s.emitter.wavelength_nm * 1e-9 * s.receiver.range_m / heights;
  const double lens = 2e-3 * std::sqrt(s.module.aperture_mm2 / std::numbers::pi);
  return difference < 29e-6 && fringe > lens;
}

/// The peaks of all carriers together.
bool above_emax(const Scenario& s, const OperatingPoint& at) {
  double peak = at.irradiance_mw_per_m2 * 1e-3;
  for (const auto& [name, disturbance] : s.disturbances)
    if (is_keyed(disturbance)) peak += disturbance.irradiance_w_per_m2;
  return peak > s.module.emax_w_per_m2;
}

bool too_bright(const Scenario& s, const OperatingPoint&) { return ambient_of(s).value > 100; }

bool is_far_from_f0(const Scenario& s, double hertz) {
  return std::abs(hertz / s.module.centre_hz - 1) > 0.2;
}

double true_carrier_hz(const Scenario& s) {
  return s.device.carrier_hz * (1 + s.device.carrier_error_ppm * 1e-6);
}

bool carrier_far_from_f0(const Scenario& s, const OperatingPoint&) {
  return is_far_from_f0(s, true_carrier_hz(s));
}

/// The cycles of a bit do not reach all places between two samples, and there are few samples in
/// one. From 16 a cycle on the threshold moves by less than 2 % (channel.Chain, CarrierPhase...).
bool on_the_grid(const Scenario& s, const OperatingPoint&) {
  const double a_cycle = s.simulation.sample_rate_hz / true_carrier_hz(s);
  const double drift = std::abs(a_cycle - std::round(a_cycle));
  return a_cycle < 16 && drift * true_carrier_hz(s) / s.device.baud < 1;
}

/// Normals end at 6.5 deviations: at 5.7 from the threshold 2 % of the errors are missing.
bool beyond_tail(const Scenario& s, const OperatingPoint& at) {
  if (fidelity_of(s.simulation) != Fidelity::decision) return false;
  const double lit = lit_amplitude(std::pow(10, at.ebn0_db / 10));
  const double share = s.module.detector_threshold > 0 ? s.module.detector_threshold : 0.5;
  return std::min(share, 1 - share) * lit > 5.7;
}

/// How far down the module's skirts are. Slow lamps are what it is made to reject.
bool disturbed_far_from_f0(const Scenario& s, const OperatingPoint&) {
  return std::ranges::any_of(s.disturbances, [&](const auto& named) {
    const DisturbanceSettings& d = named.second;
    return is_keyed(d)
               ? is_far_from_f0(s, d.carrier_hz)
               : kind_of(d).wave == LightWave::fluorescent && is_far_from_f0(s, 2 * d.ballast_hz);
  });
}

bool beyond_temperature(const Scenario& s, const OperatingPoint&) {
  return beyond(s.module.emin_against_temperature, s.receiver.temperature_c, 25);
}

bool beyond_supply(const Scenario& s, const OperatingPoint&) {
  const double volt = s.receiver.supply_v;
  if (std::isnan(volt)) return false;
  const channel::Curve& curve = s.module.emin_against_supply;
  const double least = curve.empty() ? s.module.supply_min_v : curve.x.front();
  return volt < least || volt > s.module.supply_max_v;
}

bool without_spread(const Scenario& s, const OperatingPoint&) {
  return s.receiver.population != 0 && s.module.emin_max_mw_per_m2 <= s.module.emin_mw_per_m2;
}

bool beyond_ripple(const Scenario& s, const OperatingPoint&) {
  const auto& at = channel::ripple_frequency(s.receiver.supply_ripple_at);
  return beyond(s.module.*at.emin, s.receiver.supply_ripple_mv, 0);
}

/// Without a curve a module is known at 940 nm only; within 15 nm of it no sheet shows more than a
/// few percent of change.
bool beyond_colour(const Scenario& s, const OperatingPoint&) {
  const double nm = channel::wavelength(s.emitter, s.led.temperature_c).value * 1e9;
  if (s.module.spectral.empty()) return std::abs(nm - channel::emin_nm) > 15;
  return beyond(s.module.spectral, nm, channel::emin_nm);
}

/// The longest light of a message, in cycles: bits that are 0 in a row, or a pulse.
double longest_burst_cycles(const Scenario& s) {
  if (s.device.pulse_us > 0) return s.device.pulse_us * 1e-6 * s.device.carrier_hz;
  int longest = 0, run = 0;
  for (const bool level : protocol::line_bits(protocol::cosys_encode(s.device.message))) {
    run = level ? 0 : run + 1;
    longest = std::max(longest, run);
  }
  return longest * s.device.carrier_hz / s.device.baud;
}

bool beyond_agc_figure(const Scenario& s, const OperatingPoint&) {
  const double pinned = s.module.agc_pinned_cycles;
  return s.module.agc_attack_db_per_ms > 0 && pinned > 0 && longest_burst_cycles(s) > pinned;
}

bool unbearable_current(const Scenario& s, const OperatingPoint&) {
  return s.led.current_ma < s.emitter.intensity_mw_per_sr.x.front() ||
         s.led.current_ma * s.device.carrier_duty > s.emitter.continuous_ma;
}

/// What the geometry has to do with it: nothing, where Eb/N0 sets the light.
template <bool (*left)(const Scenario&, const OperatingPoint&)>
bool unless_ebn0(const Scenario& s, const OperatingPoint& at) {
  return std::isnan(s.receiver.ebn0_db) && left(s, at);
}

/// A matched receiver has no threshold, band-pass, AGC or supply.
template <bool (*left)(const Scenario&, const OperatingPoint&)>
bool of_module(const Scenario& s, const OperatingPoint& at) {
  return !channel::is_matched(s.module) && left(s, at);
}

constexpr std::array limits{
    ValidityLimit{"near", "nearer than 5 cm LED and module are no points to each other",
                  unless_ebn0<too_near>},
    ValidityLimit{"fringes", "direct and mirrored light interfere that far out",
                  unless_ebn0<fringes>},
    ValidityLimit{"emax", "more light than the module's sheet allows", of_module<above_emax>},
    ValidityLimit{"ambient", "more ambient light than data sheets plot (100 W/m2)",
                  of_module<too_bright>},
    ValidityLimit{"carrier", "more than 20 % off f0, where data sheets plot no response",
                  of_module<carrier_far_from_f0>},
    ValidityLimit{"rejection",
                  "another light more than 20 % off f0, where data sheets plot no response",
                  of_module<disturbed_far_from_f0>},
    ValidityLimit{"temperature",
                  "not in the module's sheet: taken as without influence, or as at its curve's end",
                  of_module<beyond_temperature>},
    ValidityLimit{"supply", "a supply that the module's sheet does not allow for, taken as typical",
                  of_module<beyond_supply>},
    ValidityLimit{"spread", "no largest Emin is printed: all units have the typical one",
                  of_module<without_spread>},
    ValidityLimit{"ripple",
                  "not in the module's sheet: taken as without influence, or as at its curve's end",
                  of_module<beyond_ripple>},
    ValidityLimit{
        "colour",
        "not in the module's sheet: taken as the colour of Emin, or as at its curve's end",
        beyond_colour},
    ValidityLimit{"agc", "bursts longer than the module's sheet shows its gain control for",
                  of_module<beyond_agc_figure>},
    ValidityLimit{"current", "a current that the LED's sheet does not show or that it cannot bear",
                  unless_ebn0<unbearable_current>},
    ValidityLimit{
        "grid",
        "the sample rate is about a whole multiple of the carrier: the threshold moves by "
        "up to 7 % with the carrier's phase",
        of_module<on_the_grid>},
    ValidityLimit{"tail",
                  "decisions are drawn without noise beyond 6.5 deviations: errors are missing",
                  beyond_tail},
};

}  // namespace

std::span<const ValidityLimit> validity_limits() { return limits; }

std::uint64_t validity_flags_of(const Scenario& scenario, const OperatingPoint& at) {
  std::uint64_t mask = 0;
  for (std::size_t i = 0; i < limits.size(); ++i)
    if (limits[i].left(scenario, at)) mask |= std::uint64_t{1} << i;
  return mask;
}

}  // namespace sim
