#include "sim/scenario/figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "channel/conditions.hpp"
#include "channel/data_sheet_bench.hpp"
#include "channel/geometry.hpp"
#include "dsp/units.hpp"

namespace sim {
namespace {

using channel::Bench;
using channel::EmitterData;
using channel::ModuleData;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Vishay plots pulse widths and repetition times of the 38 kHz part of a family.
constexpr double plotted_hz = 38e3;
constexpr double plotted_mw_per_m2 = 2;  // irradiance of Fig. 8

Bench plotted_bench(const ModuleData& module) {
  Bench bench{.module = module};
  bench.module.centre_hz = plotted_hz;
  return bench;
}

double stretch(const ModuleData& module, double e_mw_per_m2) {
  return channel::mean_stretch_cycles(plotted_bench(module), channel::test_signal(plotted_hz),
                                      e_mw_per_m2);
}

/// 600 us on, 600 us off for 60 ms.
channel::OnOffTimes square(const ModuleData& module, double e_mw_per_m2) {
  const channel::BurstTrain train{
      .carrier_hz = plotted_hz, .burst_s = 600e-6, .period_s = 1200e-6, .bursts = 50};
  return channel::on_off_times(plotted_bench(module), train, e_mw_per_m2);
}

double emin(const ModuleData& module) {
  return channel::measured_emin({.module = module}, channel::test_signal(module.centre_hz));
}

double emin_under(const ModuleData& module, const channel::Conditions& conditions) {
  return emin(channel::under(conditions, module));
}

double emin_in_light(const ModuleData& module, double ambient_w_per_m2) {
  const Bench bench{
      .module = module, .ambient_w_per_m2 = ambient_w_per_m2, .noise_scale = 1, .trials = 8};
  return channel::measured_emin(bench, channel::test_signal(module.centre_hz, 8));
}

double gain(const ModuleData& module, double f_over_f0) {
  return channel::carrier_gain({.module = module}, f_over_f0 * module.centre_hz);
}

/// NaN where no gap is long enough.
double least_period_s(const Bench& bench, double burst_s, double longest_s) {
  const double period =
      channel::shortest_period(bench, burst_s, plotted_mw_per_m2, 1.01 * burst_s, longest_s);
  return period > 0 ? period : unknown;
}

/// In cycles of the part's own f0: its limits in ms come from this figure's cycles.
double max_duty(const ModuleData& module, double cycles) {
  const double burst = cycles / module.centre_hz;
  return burst / least_period_s({.module = module}, burst, 50 * burst);
}

double min_repetition_ms(const ModuleData& module, double cycles) {
  const double burst = cycles / plotted_hz;
  return 1e3 * least_period_s(plotted_bench(module), burst, burst + 50e-3);
}

double spectral(const ModuleData& module, double nm) {
  const auto& y = module.spectral.y;
  if (y.empty()) return 1;
  const auto peak = static_cast<std::size_t>(std::ranges::max_element(y) - y.begin());
  return channel::spectral_response(module, nm) /
         channel::spectral_response(module, module.spectral.x[peak]);
}

double relative_distance(const ModuleData& module, double degrees) {
  const channel::Directivity response{.relative_distance = module.directivity};
  return std::sqrt(response(dsp::degrees(std::abs(degrees))));
}

/// As plotted, relative to the largest, which need not be on axis.
double relative_distance_above(const ModuleData& module, double degrees) {
  const channel::Curve& vertical = module.directivity_vertical;
  return vertical.empty() ? relative_distance(module, degrees) : vertical(degrees);
}

double intensity_mw_per_sr(const EmitterData& led, double ma) {
  return 1e3 * channel::axial_intensity(led, dsp::Amperes(ma * 1e-3)).value;
}

double warm_intensity(const EmitterData& led, double celsius) {
  const dsp::Amperes current(0.1);
  return channel::axial_intensity(led, current, celsius) / channel::axial_intensity(led, current);
}

const FigureAxis irradiance{"irradiance", "mW/m2", true};
const FigureAxis threshold{"threshold", "mW/m2", true};
const FigureAxis burst_length{"burst", "cycle"};

/// Emin against something: all of them plot the threshold on a logarithmic scale.
Figure<ModuleData> emin_figure(std::string name, FigureAxis x,
                               std::function<double(const ModuleData&, double)> model) {
  const std::string title = "threshold irradiance against " + x.name;
  return {{std::move(name), title, std::move(x), threshold}, std::move(model)};
}

Figure<ModuleData> emin_ripple_figure(std::string name, channel::RippleFrequency at) {
  return emin_figure(std::move(name), {"supply ripple at " + std::string(at.name), "mV", true},
                     [=](const ModuleData& m, double mv) {
                       return emin_under(m, {.ripple_mv_rms = mv, .ripple_at = at});
                     });
}

}  // namespace

const std::vector<Figure<ModuleData>>& module_figures() {
  static const std::vector<Figure<ModuleData>> figures{
      {{"pulse_width",
        "output less input width, 30 cycles every 10 ms",
        irradiance,
        {"width", "cycle"}},
       stretch},
      {{"on_time", "low time of the output, 600 us on and 600 us off", irradiance, {"on", "ms"}},
       [](const ModuleData& m, double e) { return 1e3 * square(m, e).on; }},
      {{"off_time", "high time of the output, 600 us on and 600 us off", irradiance, {"off", "ms"}},
       [](const ModuleData& m, double e) { return 1e3 * square(m, e).off; }},
      {{"frequency_response", "response to a steady carrier", {"f/f0", "1"}, {"response", "1"}},
       gain},
      emin_figure("ambient", {"ambient light", "W/m2", true}, emin_in_light),
      emin_ripple_figure("ripple", channel::ripple_frequencies()[0]),
      emin_ripple_figure("ripple_10_khz", channel::ripple_frequencies()[1]),
      emin_ripple_figure("ripple_100_khz", channel::ripple_frequencies()[2]),
      {{"max_duty", "largest envelope duty that the AGC lets pass", burst_length, {"duty", "1"}},
       max_duty},
      {{"min_repetition",
        "shortest repetition time that the AGC lets pass",
        burst_length,
        {"repetition", "ms"}},
       min_repetition_ms},
      emin_figure("temperature", {"temperature", "degree_C"},
                  [](const ModuleData& m, double c) { return emin_under(m, {.celsius = c}); }),
      {{"spectral", "response against wavelength", {"wavelength", "nm"}, {"response", "1"}},
       spectral},
      {{"directivity",
        "relative distance of detection off axis",
        {"angle", "degree"},
        {"distance", "1"}},
       relative_distance},
      {{"directivity_vertical",
        "relative distance of detection below and above the axis",
        {"angle", "degree"},
        {"distance", "1"}},
       relative_distance_above},
      emin_figure("supply", {"supply voltage", "V"},
                  [](const ModuleData& m, double v) { return emin_under(m, {.supply_v = v}); }),
  };
  return figures;
}

const std::vector<Figure<EmitterData>>& led_figures() {
  static const std::vector<Figure<EmitterData>> figures{
      {{"intensity",
        "radiant intensity on axis",
        {"current", "mA", true},
        {"intensity", "mW/sr", true}},
       intensity_mw_per_sr},
      {{"temperature",
        "radiant intensity relative to 25 degrees C",
        {"temperature", "degree_C"},
        {"intensity", "1"}},
       warm_intensity},
      {{"pattern", "relative intensity off axis", {"angle", "degree"}, {"intensity", "1"}},
       [](const EmitterData& led, double degrees) {
         return channel::relative_intensity(led, dsp::degrees(std::abs(degrees)));
       }},
  };
  return figures;
}

}  // namespace sim
