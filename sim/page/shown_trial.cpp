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

/// Enough of them to show a bit: the integrator is much slower than the samples.
std::vector<float> thinned(const std::vector<float>& samples, std::size_t step) {
  std::vector<float> kept;
  for (std::size_t i = 0; i < samples.size(); i += step) kept.push_back(samples[i]);
  return kept;
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
  ShownTrial shown{trace_trial(scenario, number), make_link(scenario).module};
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

std::string eye_as_svg(const ShownTrial& shown) {
  constexpr double width = 720, height = 320, left = 80, right = 700, top = 50, bottom = 260;
  const TracedTrial& trial = shown.trial;
  const TracedMessage message = message_of(trial);
  const double bit_s = message.character_s / protocol::bits_per_byte;
  constexpr double steps_a_bit = 64;
  const auto step =
      static_cast<std::size_t>(std::max(1.0, bit_s * trial.sample_rate.value / steps_a_bit));
  const std::vector<float> integrator = thinned(trial.taps.integrator, step);
  const double sample_s = 1 / trial.sample_rate.value;
  const Scale level{0, std::max(1.0F, std::ranges::max(trial.taps.integrator)), bottom, top};
  SvgDrawing drawing(width, height, "Eye diagram",
                     "The integrator over two bits, all bits of the message over each other");
  drawing.text({20, 20}, "Eye diagram of the integrator", "heading");
  for (const double bits : {0.0, 0.5, 1.0, 1.5, 2.0}) {
    const double x = left + (right - left) * bits / 2;
    drawing.line({x, top}, {x, bottom}, "grid");
    drawing.text({x, bottom + 18}, fmt::format("{:g}", bits), "middle small");
  }
  for (const double samples : {level.from, level.to})
    drawing.text({left - 8, level(samples) + 4}, fmt::format("{:.3g}", samples), "end small");
  drawing.text({20, top - 12}, "integrator [samples]", "");
  drawing.text({(left + right) / 2, bottom + 42}, "bits since the sender's bit began", "middle");
  for (const protocol::UartByte& byte : message.sent)
    for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
      const double from_s = byte.start.value + slot * bit_s;
      drawing.path(sampled_path({integrator, sample_s, sample_s * static_cast<double>(step)},
                                {from_s, from_s + 2 * bit_s, left, right}, level),
                   "eye");
    }
  return drawing.finished();
}

}  // namespace sim
