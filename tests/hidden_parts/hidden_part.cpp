#include "hidden_part.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "dsp/philox.hpp"

namespace hidden {
namespace {

using channel::ModuleData;

constexpr std::array nominal_carriers{30e3, 33e3, 36e3, 38e3, 40e3, 56e3};

enum Purpose : std::uint32_t { part_numbers = 1, bench_errors, noise_seeds };

/// Numbers drawn one behind the other.
class Draws {
 public:
  Draws(const PartDraw& draw, std::uint32_t which, Purpose purpose)
      : address_{.seed = draw.seed, .point = 0, .trial = which, .purpose = purpose} {}

  double uniform(double low, double high) {
    return low + (high - low) * address_.uniform(index_++);
  }
  double log_uniform(double low, double high) { return low * std::pow(high / low, uniform(0, 1)); }
  /// In one of so many parts a number, else 0. Draws as often in either case.
  double sometimes(int of, double low, double high) {
    const bool is_it = uniform(0, 1) * of < 1;
    const double value = uniform(low, high);
    return is_it ? value : 0;
  }

 private:
  dsp::RandomAddress address_;
  std::uint32_t index_ = 0;
};

void draw_demodulator(Draws& draws, ModuleData& m) {
  m.q = draws.uniform(6, 14);
  m.emin_mw_per_m2 = draws.log_uniform(0.08, 0.4);
  m.emin_width_cycles = draws.uniform(-7, -3);
  m.comparator_hold_cycles = draws.uniform(1.1, 1.6);
  m.integrator_cycles = draws.uniform(4, 10);
  m.atc_fraction = draws.uniform(0.3, 0.6);
  m.atc_release_ms = draws.log_uniform(4, 25);
}

void draw_agc(Draws& draws, ModuleData& m) {
  m.agc_attack_db_per_ms = draws.log_uniform(0.05, 1);
  m.agc_max_duty = draws.uniform(0.08, 0.45);
  m.agc_long_burst_cycles = draws.uniform(40, 120);
  m.agc_free_cycles = draws.sometimes(5, 10, 30);
  m.agc_min_gap_cycles = draws.uniform(8, 35);
  m.agc_hold_ms = draws.sometimes(3, 5, 25);
  m.agc_margin_db = draws.uniform(0, 6);
  m.agc_range_db = draws.uniform(45, 110);
}

ModuleData draw_module(const PartDraw& draw, std::uint32_t which) {
  Draws draws(draw, which, part_numbers);
  ModuleData m;
  m.name = "hidden";
  m.centre_hz = draw.nominal_hz * (1 + draws.uniform(-draw.centre_share, draw.centre_share));
  draw_demodulator(draws, m);
  draw_agc(draws, m);
  return m;
}

void draw_errors(const PartDraw& draw, std::uint32_t which, const sim::Plan& plan,
                 HiddenPart& part) {
  Draws draws(draw, which, bench_errors);
  part.clock_error = draws.uniform(-draw.clock_share, draw.clock_share);
  part.start_s = draws.uniform(0.3, 3);
  part.tail_s = draws.uniform(0.2, 1);
  for (const sim::PlanStep& step : plan.steps) part.level_factor[level_key(step.level_db)] = 1;
  for (auto& [key, factor] : part.level_factor)
    factor = 1 + draws.uniform(-draw.level_share, draw.level_share);
}

}  // namespace

long level_key(double level_db) { return std::lround(100 * level_db); }

double level_factor(const HiddenPart& part, double level_db) {
  const auto found = part.level_factor.find(level_key(level_db));
  return found == part.level_factor.end() ? 1 : found->second;
}

double nominal_of(const sim::Plan& plan) {
  const double carrier = plan.steps.front().carrier_hz;
  return *std::ranges::min_element(nominal_carriers, {},
                                   [&](double f) { return std::abs(std::log(f / carrier)); });
}

HiddenPart draw_part(const PartDraw& draw, std::uint32_t which, const sim::Plan& plan) {
  HiddenPart part;
  part.module = draw_module(draw, which);
  part.broken = draw.broken;
  draw_errors(draw, which, plan, part);
  part.noise_seed =
      dsp::RandomAddress{.seed = draw.seed, .trial = which, .purpose = noise_seeds}.block(0);
  return part;
}

std::span<const ModuleNumber> module_numbers() {
  using M = ModuleData;
  static constexpr ModuleNumber all[] = {{"centre_hz", &M::centre_hz},
                                         {"centre_tolerance", &M::centre_tolerance},
                                         {"q", &M::q},
                                         {"emin_mw_per_m2", &M::emin_mw_per_m2},
                                         {"emin_width_cycles", &M::emin_width_cycles},
                                         {"emin_max_mw_per_m2", &M::emin_max_mw_per_m2},
                                         {"supply_min_v", &M::supply_min_v},
                                         {"supply_max_v", &M::supply_max_v},
                                         {"emax_w_per_m2", &M::emax_w_per_m2},
                                         {"comparator_hold_cycles", &M::comparator_hold_cycles},
                                         {"integrator_cycles", &M::integrator_cycles},
                                         {"atc_fraction", &M::atc_fraction},
                                         {"atc_release_ms", &M::atc_release_ms},
                                         {"agc_attack_db_per_ms", &M::agc_attack_db_per_ms},
                                         {"agc_max_duty", &M::agc_max_duty},
                                         {"agc_long_burst_cycles", &M::agc_long_burst_cycles},
                                         {"agc_long_burst_ms", &M::agc_long_burst_ms},
                                         {"agc_free_cycles", &M::agc_free_cycles},
                                         {"agc_min_gap_cycles", &M::agc_min_gap_cycles},
                                         {"agc_hold_ms", &M::agc_hold_ms},
                                         {"agc_pinned_cycles", &M::agc_pinned_cycles},
                                         {"agc_margin_db", &M::agc_margin_db},
                                         {"agc_range_db", &M::agc_range_db},
                                         {"aperture_mm2", &M::aperture_mm2},
                                         {"responsivity_a_per_w", &M::responsivity_a_per_w},
                                         {"feedback_ohm", &M::feedback_ohm},
                                         {"front_end_hz", &M::front_end_hz},
                                         {"detector_threshold", &M::detector_threshold},
                                         {"ambient_k", &M::ambient_k},
                                         {"ambient_es_w_per_m2", &M::ambient_es_w_per_m2}};
  return all;
}

}  // namespace hidden
