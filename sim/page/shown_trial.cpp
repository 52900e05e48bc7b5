#include "sim/page/shown_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "dsp/spectrum.hpp"
#include "sim/link/link.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/page/omissions.hpp"
#include "sim/picture/svg.hpp"
#include "sim/picture/waveform.hpp"
#include "sim/trace/traced_message.hpp"

namespace sim {
namespace {

constexpr int trials_looked_at = 20;

TracedTrial numbered_trial(const StoredResult& stored, const Scenario& scenario,
                           std::uint64_t point, std::uint32_t number) {
  TracedTrial trial = trace_trial(scenario, number);
  trial.origin = {.program = stored.origin.program,
                  .scenario_toml = stored.origin.scenario_toml,
                  .seed = stored.origin.seed,
                  .point = point,
                  .trial = number};
  return trial;
}

/// How much later than `at` the nearest flip to that level is, in seconds.
std::optional<double> delay_of(const dsp::LogicTrace& pin, double at_s, bool level, double most_s) {
  const auto flips = pin.flips();
  const auto from = std::ranges::lower_bound(flips, at_s - most_s, {}, &dsp::Seconds::value);
  std::optional<double> nearest;
  for (auto flip = from; flip != flips.end() && flip->value < at_s + most_s; ++flip) {
    const double delay = flip->value - at_s;
    if (pin.level_at(*flip) == level && (!nearest || std::abs(delay) < std::abs(*nearest)))
      nearest = delay;
  }
  return nearest;
}

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

/// A frequency polygon: how many are in each step, at its middle.
ChartCurve histogram(const std::string& name, const std::vector<double>& delays_us,
                     double step_us) {
  std::map<long, int> counts;
  for (const double delay : delays_us) ++counts[std::lround(std::floor(delay / step_us))];
  ChartCurve curve{.name = name, .points = {}, .kind = CurveKind::continuous};
  if (counts.empty()) return curve;
  for (long bin = counts.begin()->first - 1; bin <= counts.rbegin()->first + 1; ++bin) {
    const auto found = counts.find(bin);
    const double count = found == counts.end() ? 0 : found->second;
    curve.points.push_back({(static_cast<double>(bin) + 0.5) * step_us, count, count, count});
  }
  return curve;
}

/// Of as many microseconds that there are some tens of them, but for those far out.
double step_for(const EdgeDelays& delays) {
  std::vector<double> all = delays.falling_us;
  all.insert(all.end(), delays.rising_us.begin(), delays.rising_us.end());
  if (all.empty()) return 1;
  std::ranges::sort(all);
  constexpr double steps = 40;
  const std::size_t far_out = all.size() / 50;
  return std::max(1.0, std::ceil((all[all.size() - 1 - far_out] - all[far_out]) / steps));
}

/// Enough of them to show a bit: the integrator is much slower than the samples.
std::vector<float> thinned(const std::vector<float>& samples, std::size_t step) {
  std::vector<float> kept;
  for (std::size_t i = 0; i < samples.size(); i += step) kept.push_back(samples[i]);
  return kept;
}

}  // namespace

void add_delays(EdgeDelays& delays, const TracedTrial& trial) {
  const TracedMessage message = message_of(trial);
  if (message.sent.empty()) return;
  const double half_bit_s = message.character_s / protocol::bits_per_byte / 2;
  for (const dsp::Seconds flip : trial.tx.flips()) {
    if (flip.value < message.start_s(0) - half_bit_s || flip.value > message.end_s()) continue;
    const bool level = trial.tx.level_at(flip);
    if (const auto delay = delay_of(trial.rx, flip.value, level, half_bit_s))
      (level ? delays.rising_us : delays.falling_us).push_back(*delay * 1e6);
  }
}

void add_wrong_bits(WrongBits& wrong, const TracedTrial& trial, dsp::Seconds delay) {
  const TracedMessage message = message_of(trial);
  const double bit_s = message.character_s / protocol::bits_per_byte;
  if (wrong.counts.empty()) wrong.counts.resize(message.sent.size());
  wrong.characters.clear();
  std::size_t burst = 0;
  const auto end_burst = [&] {
    if (burst == 0) return;
    if (wrong.bursts.size() < burst) wrong.bursts.resize(burst);
    ++wrong.bursts[burst - 1];
    burst = 0;
  };
  for (std::size_t i = 0; i < std::min(message.sent.size(), wrong.counts.size()); ++i) {
    wrong.characters.push_back(shown(message.sent[i]));
    for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
      const double middle_s = message.start_s(i) + (slot + 0.5) * bit_s + delay.value;
      if (trial.rx.level_at(dsp::Seconds(middle_s)) ==
          protocol::line_bit(message.sent[i].value, slot)) {
        end_burst();
      } else {
        ++burst;
        ++wrong.counts[i][static_cast<std::size_t>(slot)];
      }
    }
  }
  end_burst();
}

std::optional<ShownTrial> trial_to_show(const StoredResult& stored,
                                        const std::atomic<bool>& interrupt) {
  const std::vector<PointResult>& points = stored.result.points;
  const PointResult* failing = failing_point(stored.result);
  const auto number = static_cast<std::uint64_t>(failing == nullptr ? 0 : failing - points.data());
  const Scenario scenario = numbered_point(stored.scenario, number);
  if (scenario.simulation.fidelity != "waveform" || is_weighted(stored.result)) return std::nullopt;
  const Link link = make_link(scenario);
  ShownTrial shown{numbered_trial(stored, scenario, number, 0), link.module};
  if (message_of(shown.trial).sent.empty()) return std::nullopt;
  bool is_misread = message_of(shown.trial).first_wrong().has_value();
  for (; shown.trials < trials_looked_at && !interrupt; ++shown.trials) {
    TracedTrial trial =
        numbered_trial(stored, scenario, number, static_cast<std::uint32_t>(shown.trials));
    add_delays(shown.delays, trial);
    add_wrong_bits(shown.wrong, trial, link.delay);
    if (is_misread || !message_of(trial).first_wrong()) continue;
    is_misread = true;
    shown.trial = std::move(trial);
  }
  return shown;
}

Chart spectrum_chart(const ShownTrial& shown) {
  constexpr std::size_t segment = 1 << 12;
  const TracedTrial& trial = shown.trial;
  Chart chart{.title = "Spectrum",
              .description =
                  "Power spectral density before and behind the band-pass of the trial "
                  "(Welch, Hann windows of 4096 samples), and the module's response from the "
                  "highest point down",
              .x = {"frequency [kHz]", false},
              .y = {"density [(mW/m2)2/Hz]", true},
              .curves = {}};
  chart.curves.push_back(density_curve(
      "light and noise", dsp::welch(trial.taps.irradiance, trial.sample_rate, segment)));
  if (channel::is_matched(shown.module)) return chart;
  chart.curves.push_back(density_curve(
      "behind the band-pass", dsp::welch(trial.taps.band_pass, trial.sample_rate, segment)));
  chart.curves.push_back(response_curve(shown.module, chart.curves.front()));
  return chart;
}

HeatMap wrong_bits_map(const ShownTrial& shown) {
  HeatMap map{
      .title = "Wrong bits",
      .description = fmt::format("share of {} trials in which a bit is wrong at the pin, by its "
                                 "character, from the first above, and its place in it",
                                 shown.trials),
      .x_label = "bit, in the order of sending",
      .y_label = "character",
      .columns = {"start", "0", "1", "2", "3", "4", "5", "6", "7", "stop"},
      .rows = {},
      .values = {}};
  for (std::size_t i = shown.wrong.characters.size(); i-- > 0;) {
    map.rows.push_back(fmt::format("{}: {}", i + 1, shown.wrong.characters[i]));
    std::vector<double>& shares = map.values.emplace_back();
    for (const int count : shown.wrong.counts[i])
      shares.push_back(static_cast<double>(count) / std::max(1, shown.trials));
  }
  return map;
}

Chart burst_chart(const ShownTrial& shown) {
  ChartCurve curve{.name = "bursts", .points = {}, .kind = CurveKind::continuous};
  const std::vector<int>& bursts = shown.wrong.bursts;
  for (std::size_t n = 0; n <= bursts.size() + 1; ++n) {  // from nothing to nothing
    const double count = n == 0 || n > bursts.size() ? 0 : bursts[n - 1];
    curve.points.push_back({static_cast<double>(n), count, count, count});
  }
  return {.title = "Bursts of wrong bits",
          .description = fmt::format(
              "How often so many wrong bits followed each other in {} trials", shown.trials),
          .x = {"wrong bits in a row", false},
          .y = {"bursts", false},
          .curves = {curve}};
}

Chart jitter_chart(const ShownTrial& shown) {
  const double step_us = step_for(shown.delays);
  return {.title = "Delay of edges",
          .description =
              fmt::format("Histogram of how much later than the light's the edges of the pin "
                          "are, in steps of {:g} us, of {} trials",
                          step_us, shown.trials),
          .x = {"delay [us]", false},
          .y = {"edges", false},
          .curves = {histogram("falling: light begins", shown.delays.falling_us, step_us),
                     histogram("rising: light ends", shown.delays.rising_us, step_us)}};
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
