#include "sim/page/shown_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dsp/spectrum.hpp"
#include "sim/link/link.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/picture/svg.hpp"
#include "sim/picture/waveform.hpp"
#include "sim/trace/traced_message.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

ChartCurve density_curve(const std::string& name, const dsp::Spectrum& spectrum) {
  constexpr double highest_hz = 120e3;
  ChartCurve curve{.name = name, .points = {}, .kind = CurveKind::continuous};
  for (std::size_t i = 1;
       i < spectrum.frequency_hz.size() && spectrum.frequency_hz[i] <= highest_hz; ++i) {
    const double density = spectrum.density[i];
    curve.points.push_back({spectrum.frequency_hz[i] / 1e3, density, density, density});
  }
  return curve;
}

/// channel/band_pass.hpp, in power, from the highest point of what goes into it.
ChartCurve response_curve(const channel::ModuleData& module, const ChartCurve& before) {
  const double top = std::ranges::max(before.points, {}, &ChartPoint::y).y;
  const double f0 = module.centre_hz / 1e3;
  ChartCurve curve{
      .name = fmt::format("response of the band-pass (f0 = {:g} kHz, Q = {:g})", f0, module.q),
      .points = {},
      .kind = CurveKind::theory};
  for (const ChartPoint& point : before.points) {
    const double detuning = module.q * (point.x / f0 - f0 / point.x);
    const double density = top / (1 + detuning * detuning);
    curve.points.push_back({point.x, density, density, density});
  }
  return curve;
}

std::string spectrum_description(bool is_matched) {
  return fmt::format(
      "Power spectral density of the trial{} (Welch, Hann windows of 4096 samples){}. Harmonics of "
      "the carrier above half of the sample rate are folded back",
      is_matched ? "'s light and noise" : " before and behind the band-pass",
      is_matched ? "" : ", and the module's response from the highest point down");
}

}  // namespace

std::string why_no_trial(const Scenario& scenario) {
  const std::string& fidelity = scenario.simulation.fidelity;
  return fidelity == "waveform"
             ? ""
             : fmt::format(
                   "A trial of fidelity = \"{}\" has no waveform to show; `cosys-sim trace` "
                   "draws its pin (-o x.svg).\n",
                   fidelity);
}

std::optional<ShownTrial> trial_to_show(const StoredResult& stored, std::uint64_t point,
                                        std::uint32_t number) {
  const Scenario scenario = numbered_point(stored.scenario, point);
  if (scenario.simulation.fidelity != "waveform") return std::nullopt;
  ShownTrial shown{trace_trial(scenario, number), drawn_module(make_link(scenario), number)};
  if (message_of(shown.trial).sent.empty()) return std::nullopt;
  shown.trial.origin = {.program = stored.origin.program,
                        .scenario_toml = stored.origin.scenario_toml,
                        .seed = stored.origin.seed,
                        .point = point,
                        .trial = number};
  return shown;
}

Chart spectrum_chart(const ShownTrial& shown) {
  constexpr std::size_t segment = 1 << 12;
  const TracedTrial& trial = shown.trial;
  const bool is_matched = channel::is_matched(shown.module);
  Chart chart{.title = "Spectrum",
              .description = spectrum_description(is_matched),
              .x = {"frequency [kHz]", false},
              .y = {"density [(mW/m2)^2/Hz]", true},
              .curves = {}};
  chart.curves.push_back(density_curve(
      "light and noise", dsp::welch(trial.taps.irradiance, trial.sample_rate, segment)));
  if (is_matched) return chart;
  chart.curves.push_back(density_curve(
      "behind the band-pass", dsp::welch(trial.taps.band_pass, trial.sample_rate, segment)));
  chart.curves.push_back(response_curve(shown.module, chart.curves.front()));
  return chart;
}

}  // namespace sim
