// What the files of modules may say: numbers and curves, each with its unit and bounds.
#include <algorithm>
#include <utility>

#include "sim/scenario/figures.hpp"
#include "sim/scenario/keys.hpp"

namespace sim {
namespace {

PartNumber<channel::ModuleData> module_number(std::string name, std::string unit, Range range,
                                              double channel::ModuleData::*member,
                                              std::string long_name, std::string note = "") {
  return {{std::move(name), std::move(unit), range, std::move(long_name), std::move(note)},
          member,
          false};
}

template <class... Rest>
PartNumber<channel::ModuleData> printed(Rest&&... rest) {
  auto row = module_number(std::forward<Rest>(rest)...);
  row.required = true;
  return row;
}

std::vector<PartNumber<channel::ModuleData>> threshold_numbers() {
  using M = channel::ModuleData;
  return {
      printed("centre_hz", "Hz", from(1e3, 1e6), &M::centre_hz, "centre of the band-pass"),
      module_number("centre_tolerance", "1", from(0, 0.5), &M::centre_tolerance,
                    "largest error of a unit's centre", "as a share of it"),
      module_number("q", "1", above(0.5, 100), &M::q, "quality factor of the band-pass",
                    "centre over 3 dB width"),
      printed("emin_mw_per_m2", "mW/m2", from(1e-3, 1e4), &M::emin_mw_per_m2,
              "threshold irradiance in the dark", "typical, 30-cycle burst at the centre"),
      module_number("emin_width_cycles", "cycle", from(-20, 20), &M::emin_width_cycles,
                    "output less input width at the threshold"),
      module_number("emin_max_mw_per_m2", "mW/m2", from(0, 1e4), &M::emin_max_mw_per_m2,
                    "threshold irradiance of the least sensitive unit",
                    "printed maximum; 0, or the typical one: no spread"),
      module_number("supply_min_v", "V", from(0, 30), &M::supply_min_v, "least supply voltage"),
      module_number("supply_max_v", "V", from(0, 30), &M::supply_max_v, "largest supply voltage",
                    "0: the sheet does not say"),
      printed("emax_w_per_m2", "W/m2", from(1e-6, 1e4), &M::emax_w_per_m2,
              "irradiance at which the input clips"),
      module_number("comparator_hold_cycles", "cycle", from(0, 20), &M::comparator_hold_cycles,
                    "time that the comparator holds a cycle's peak"),
      module_number("integrator_cycles", "cycle", from(1, 100), &M::integrator_cycles,
                    "length of the integrator"),
      module_number("atc_fraction", "1", from(0, 0.95), &M::atc_fraction,
                    "threshold as a fraction of the signal's peak", "0: a fixed threshold"),
      module_number("atc_release_ms", "ms", from(0.01, 1e4), &M::atc_release_ms,
                    "time constant with which that threshold falls"),
  };
}

std::vector<PartNumber<channel::ModuleData>> agc_numbers() {
  using M = channel::ModuleData;
  return {
      module_number("agc_attack_db_per_ms", "dB/ms", from(0, 10), &M::agc_attack_db_per_ms,
                    "rate at which the gain falls", "0: a part without AGC"),
      printed("agc_max_duty", "1", from(0.01, 1), &M::agc_max_duty,
              "largest lit fraction of long bursts that the AGC tolerates"),
      module_number("agc_long_burst_cycles", "cycle", from(1, 1e4), &M::agc_long_burst_cycles,
                    "length from which a burst is a long one"),
      module_number("agc_long_burst_ms", "ms", from(0, 1e3), &M::agc_long_burst_ms,
                    "the same as a time", "instead of the limit in cycles; 0: that one holds"),
      module_number("agc_free_cycles", "cycle", from(0, 1e4), &M::agc_free_cycles,
                    "part of a long burst that is not charged"),
      printed("agc_min_gap_cycles", "cycle", from(0, 1e4), &M::agc_min_gap_cycles,
              "shortest gap after a short burst"),
      module_number("agc_hold_ms", "ms", from(0, 1e3), &M::agc_hold_ms,
                    "dark time before the gain recovers", "AGC5, AGC6: one gap for all bursts"),
      module_number("agc_pinned_cycles", "cycle", from(0, 1e5), &M::agc_pinned_cycles,
                    "longest burst for which a figure shows the rule",
                    "longer ones are flagged; 0: the rule has no end"),
      module_number("agc_margin_db", "dB", from(0, 40), &M::agc_margin_db,
                    "signal over threshold that the AGC aims at"),
      module_number("agc_range_db", "dB", from(0, 200), &M::agc_range_db,
                    "largest fall of the gain"),
  };
}

std::vector<PartNumber<channel::ModuleData>> front_end_numbers() {
  using M = channel::ModuleData;
  return {
      module_number("aperture_mm2", "mm2", from(0.01, 1e4), &M::aperture_mm2,
                    "effective area, lens included"),
      module_number("responsivity_a_per_w", "A/W", from(0.01, 1), &M::responsivity_a_per_w,
                    "responsivity of the photodiode at 940 nm"),
      module_number("feedback_ohm", "Ohm", from(100, 1e9), &M::feedback_ohm,
                    "feedback resistance of the first amplifier"),
      module_number("front_end_hz", "Hz", from(2e4, 1e8), &M::front_end_hz,
                    "bandwidth ahead of the band-pass", "one pole; not in data sheets"),
      module_number("detector_threshold", "1", from(0, 2), &M::detector_threshold,
                    "threshold of a matched receiver over the amplitude of light",
                    "0: the optimum for bits that are light as often as dark"),
      module_number("ambient_k", "1", from(0, 100), &M::ambient_k,
                    "growth of the threshold with ambient light",
                    "Emin^2 + k E (1 + E/Es), Emin in mW/m2, E in W/m2"),
      module_number("ambient_es_w_per_m2", "W/m2", from(0.01, 1e6), &M::ambient_es_w_per_m2,
                    "ambient irradiance Es of that law"),
  };
}

/// Emin against something that surrounds the part.
PartCurve<channel::ModuleData> emin_against(const std::string& what, KeyFacts x,
                                            channel::Curve channel::ModuleData::*member) {
  return {"emin_against_" + what,
          "threshold irradiance against " + x.long_name,
          std::move(x),
          {"emin_mw_per_m2", "mW/m2", from(1e-4, 1e4), "threshold irradiance", ""},
          member,
          false};
}

PartCurve<channel::ModuleData> emin_against_ripple(const std::string& suffix,
                                                   const std::string& frequency,
                                                   channel::Curve channel::ModuleData::*member) {
  return emin_against("ripple" + suffix,
                      {"mv_rms", "mV", from(0, 1e4), "supply ripple at " + frequency, ""}, member);
}

std::vector<PartCurve<channel::ModuleData>> module_curves() {
  using M = channel::ModuleData;
  return {
      {"directivity",
       "relative distance of detection off axis; its square is the response",
       {"degrees", "degree", from(0, 90), "angle off axis", ""},
       {"relative_distance", "1", from(0, 1.5), "relative distance", ""},
       &M::directivity,
       false},
      {"directivity_vertical",
       "the same from below the axis to above it",
       {"degrees", "degree", from(-90, 90), "angle above the axis", ""},
       {"relative_distance", "1", from(0, 1.5), "relative distance", ""},
       &M::directivity_vertical,
       false},
      {"spectral",
       "response against the wavelength",
       {"nm", "nm", from(300, 2000), "wavelength", ""},
       {"relative_response", "1", from(0, 1.5), "relative response", ""},
       &M::spectral,
       false},
      emin_against("temperature", {"celsius", "degree_C", from(-60, 150), "temperature", ""},
                   &M::emin_against_temperature),
      emin_against("supply", {"volt", "V", from(0, 30), "supply voltage", ""},
                   &M::emin_against_supply),
      emin_against_ripple("", "f0", &M::emin_against_ripple),
      emin_against_ripple("_10_khz", "10 kHz", &M::emin_against_ripple_10_khz),
      emin_against_ripple("_100_khz", "100 kHz", &M::emin_against_ripple_100_khz),
  };
}

/// Other values are taken relative to these.
const char* flaw_of(const channel::ModuleData& part) {
  if (!part.spectral.empty() && part.spectral(channel::emin_nm) <= 0)
    return "its spectral response is 0 at 940 nm, where Emin is taken";
  if (!part.directivity.empty() && part.directivity(0) <= 0)
    return "its directivity is 0 on axis, where Emin is taken";
  if (!part.directivity_vertical.empty() && part.directivity_vertical(0) <= 0)
    return "its vertical directivity is 0 on axis, where Emin is taken";
  if (part.emin_max_mw_per_m2 > 0 && part.emin_max_mw_per_m2 < part.emin_mw_per_m2)
    return "its emin_max_mw_per_m2 is below its emin_mw_per_m2";
  if (part.supply_max_v > 0 && part.supply_max_v < part.supply_min_v)
    return "its largest supply voltage is below its least";
  return nullptr;
}

/// Where a part lies whose file is silent of a number that no sheet prints. All bounds, here and in
/// the files, are judgement: a number that was taken from a sibling has half to twice of it (Emin,
/// Emax, ambient light) or a fifth more and less (cycles); a limit that a sheet guarantees lies at
/// one end of its bounds.
std::vector<UnsaidBounds> bounds_of_silence() {
  using enum channel::Distribution;
  return {
      {{"q", 7, 13}, "10 where a sheet prints the width; 5 is a part for data"},
      {{"comparator_hold_cycles", 1.1, 2}, "judgement: one carrier cycle to two"},
      {{"integrator_cycles", 5, 10}, "of the catalogue's parts, but for those for data"},
      {{"atc_fraction", 0.3, 0.6}, "0.4 and 0.5 are fitted to figures of TSOP48 and TSOP382"},
      {{"atc_release_ms", 3, 30, log_uniform}, "judgement; not published"},
      {{"agc_attack_db_per_ms", 0.05, 0.4, log_uniform},
       "least: 35 m at 1200 bit/s (Vishay, application note on TSDP modules); most: no faster than "
       "an IC that tells 52 dB of level in 120 ms (Vishay 82480 p. 5)"},
      {{"agc_margin_db", 0, 6}, "judgement; not published"},
      {{"agc_range_db", 50, 120},
       "least: Vishay's circuit description of its modules; most: a strong carrier is suppressed"},
      {{"responsivity_a_per_w", 0.5, 0.7}, "of silicon photodiodes at 940 nm"},
      {{"feedback_ohm", 3e5, 3e6, log_uniform}, "judgement; not published"},
      {{"front_end_hz", 1e5, 2e5, log_uniform}, "judgement; not published"},
  };
}

void set_bounds_of_silence(std::vector<PartNumber<channel::ModuleData>>& numbers) {
  for (const UnsaidBounds& unsaid : bounds_of_silence())
    std::ranges::find(numbers, unsaid.bounds.number, [](const auto& n) {
      return n.facts.name;
    })->unsaid = unsaid;
}

PartKeys<channel::ModuleData> make_module_keys() {
  PartKeys<channel::ModuleData> keys{"module", "modules", {}, module_curves()};
  for (const auto& group : {threshold_numbers(), agc_numbers(), front_end_numbers()})
    keys.numbers.insert(keys.numbers.end(), group.begin(), group.end());
  set_bounds_of_silence(keys.numbers);
  keys.either = {{"agc_long_burst_cycles", "agc_long_burst_ms"}};
  keys.figures = figure_names(module_figures());
  keys.choices = {{{"detector",
                    "",
                    {},
                    "what kind of receiver the part is",
                    "a module; or a matched receiver, for validation, which needs no other number"},
                   &channel::ModuleData::detector,
                   {"module", "coherent", "noncoherent"}}};
  keys.flaw = flaw_of;
  keys.needs_numbers = [](const channel::ModuleData& part) { return !channel::is_matched(part); };
  return keys;
}

}  // namespace

const PartKeys<channel::ModuleData>& module_keys() {
  static const auto keys = make_module_keys();
  return keys;
}

}  // namespace sim
