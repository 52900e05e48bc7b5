#include "hidden_recording.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "broken_agc.hpp"
#include "broken_module.hpp"
#include "channel/disturbance.hpp"
#include "channel/keyed_carrier.hpp"
#include "channel/noise.hpp"
#include "channel/receiver_module.hpp"
#include "dsp/lanes.hpp"
#include "dsp/normal.hpp"

namespace hidden {
namespace {

using dsp::Lanes8;

constexpr int block = 256;
constexpr double duty = 0.5;
// No noise at all would leave the filters to decay into denormal numbers.
constexpr double least_noise_mw_per_m2 = 1e-12;

/// Lane i is of part i, lanes behind the last part of the last one.
const HiddenPart& part_of(std::span<const HiddenPart> parts, int lane) {
  return parts[std::min(static_cast<std::size_t>(lane), parts.size() - 1)];
}

/// Standard deviation of a sample's noise while there is so much light, mW/m2.
float noise_of(const HiddenPart& part, double mw_per_m2, double rate) {
  const channel::ModuleData& module = part.module;
  const dsp::WattsPerSquareMetre ambient(part.ambient_w_per_m2), mean(mw_per_m2 * 1e-3 * duty);
  const double density = channel::noise_density(
      module, channel::photocurrent(module, channel::noisy_light(module, ambient, mean)));
  return static_cast<float>(
      std::max(least_noise_mw_per_m2,
               channel::sample_deviation_mw_per_m2(module, density, dsp::Hertz(rate))));
}

/// A step's bursts, in samples from `from` on.
std::vector<channel::Burst> bursts_of(const sim::PlanStep& step, double start, double cycle) {
  const auto period = static_cast<double>(step.cycles_on + step.cycles_off) * cycle;
  const auto length = static_cast<double>(step.cycles_on) * cycle;
  std::vector<channel::Burst> bursts;
  for (std::uint64_t i = 0; i < step.repeats; ++i) {
    const double on = start + static_cast<double>(i) * period;
    bursts.push_back({channel::edge_at(on), channel::edge_at(on + length)});
  }
  return bursts;
}

/// The light of a block, and how strong its noise is.
struct BlockLight {
  Lanes8 irradiance[block], noise[block];
};

/// One step's light.
class StepLight {
 public:
  /// `before` are the samples of dark before the plan.
  StepLight(const sim::PlanStep& step, std::span<const HiddenPart> parts, double first_mw_per_m2,
            double rate, std::int64_t before) {
    const double start = step.start_ms * 1e-3 * rate + static_cast<double>(before);
    first_ = static_cast<std::int64_t>(std::floor(start));
    const double within = start - static_cast<double>(first_);
    bursts_ = bursts_of(step, within, rate / step.carrier_hz);
    end_ = first_ + static_cast<std::int64_t>(std::ceil(bursts_.back().off));
    const channel::CarrierDesign design = channel::design_carrier(
        dsp::WattsPerSquareMetre(1e-3), dsp::Hertz(step.carrier_hz), duty, dsp::Hertz(rate));
    carrier_.emplace(design);
    const auto phase = static_cast<std::uint32_t>(std::llround(-within * design.step));
    const double said = first_mw_per_m2 * std::pow(10, step.level_db / 20);
    for (int i = 0; i < dsp::lanes<Lanes8>; ++i) {
      const HiddenPart& part = part_of(parts, i);
      const double level = said * level_factor(part, step.level_db);
      carrier_->load(i, bursts_, phase);
      dsp::set_lane(level_, i, static_cast<float>(level));
      dsp::set_lane(noise_, i, noise_of(part, level, rate));
    }
  }

  std::int64_t first() const { return first_; }
  std::int64_t end() const { return end_; }

  /// Adds what it has of the samples [first, first + n); to be called for each block in turn.
  void add(std::int64_t first, int n, BlockLight& light) {
    const std::int64_t from = std::max(first, first_), to = std::min(first + n, end_);
    for (std::int64_t at = from; at < to;) {
      const int length = carrier_->begin_block(at - first_, static_cast<int>(to - at));
      add_block(static_cast<int>(at - first), length, light);
      at += length;
    }
  }

 private:
  void add_block(int place, int length, BlockLight& light) {
    if (carrier_->dark(length)) return carrier_->skip(length);
    for (int i = 0; i < length; ++i) {
      const auto sample = (*carrier_)(i);
      Lanes8& irradiance = light.irradiance[place + i];
      Lanes8& noise = light.noise[place + i];
      irradiance = dsp::fused(level_, sample.irradiance, irradiance);
      noise = dsp::choose(sample.lit, noise_, noise);
    }
  }

  std::int64_t first_ = 0, end_ = 0;
  std::vector<channel::Burst> bursts_;
  std::optional<channel::KeyedCarrier<Lanes8>> carrier_;  // of irradiance 1
  Lanes8 level_, noise_;
};

/// All steps, of which one at a time is on, or two in the sample in which they meet.
class PlanLight {
 public:
  PlanLight(const sim::Plan& plan, std::span<const HiddenPart> parts, double first_mw_per_m2,
            double rate, std::int64_t before) {
    for (int i = 0; i < dsp::lanes<Lanes8>; ++i) {
      const HiddenPart& part = part_of(parts, i);
      dsp::set_lane(dark_noise_, i, noise_of(part, 0, rate));
      noise_.seed(i, part.noise_seed);
    }
    for (const sim::PlanStep& step : plan.steps)
      steps_.emplace_back(step, parts, first_mw_per_m2, rate, before);
  }

  /// The block that begins at sample `first`; to be called for each in turn.
  void fill(std::int64_t first, Lanes8* x) {
    std::fill_n(light_.irradiance, block, Lanes8(0.0f));
    std::fill_n(light_.noise, block, dark_noise_);
    while (next_ < steps_.size() && steps_[next_].end() <= first) ++next_;
    for (std::size_t i = next_; i < steps_.size() && steps_[i].first() < first + block; ++i)
      steps_[i].add(first, block, light_);
    noise_.fill(x, block);
    for (int i = 0; i < block; ++i) x[i] = dsp::fused(x[i], light_.noise[i], light_.irradiance[i]);
  }

 private:
  std::vector<StepLight> steps_;
  std::size_t next_ = 0;  // the first that is not over
  Lanes8 dark_noise_;
  dsp::NormalSource<Lanes8> noise_;
  BlockLight light_;
};

/// Edges of the lanes' pins, which begin high.
class EdgeList {
 public:
  explicit EdgeList(std::size_t parts) : edges_(parts) {}

  /// Of the sample `at`, bit i of `pins` being lane i's.
  void look(std::int64_t at, std::uint32_t pins) {
    if (pins == before_) return;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if ((pins ^ before_) >> i & 1) edges_[i].push_back(at + 1);
    before_ = pins;
  }

  std::vector<std::vector<std::int64_t>> take() { return std::move(edges_); }

 private:
  std::vector<std::vector<std::int64_t>> edges_;
  std::uint32_t before_ = 0xFF;
};

/// A tick of the gain control, which all lanes share: a cycle of the plan's first carrier, so that
/// no part depends on those beside it.
int tick_of(const sim::Plan& plan, double rate) {
  return std::max(1, static_cast<int>(rate / plan.steps.front().carrier_hz));
}

channel::ModuleDesignOf<Lanes8> designs_of(std::span<const HiddenPart> parts, double rate,
                                           int tick) {
  channel::ModuleDesignOf<Lanes8> all;
  for (int i = 0; i < dsp::lanes<Lanes8>; ++i) {
    const HiddenPart& part = part_of(parts, i);
    const dsp::WattsPerSquareMetre ambient(part.ambient_w_per_m2);
    set_lane(all, i, channel::design_module(part.module, ambient, dsp::Hertz(rate)));
  }
  all.agc.samples_per_tick = tick;
  return all;
}

BrokenRuleOf<Lanes8> rules_of(std::span<const HiddenPart> parts, double rate) {
  BrokenRuleOf<Lanes8> all;
  for (int i = 0; i < dsp::lanes<Lanes8>; ++i) {
    const HiddenPart& part = part_of(parts, i);
    set_lane(all, i, broken_rule(part.broken, part.module, dsp::Hertz(rate)));
  }
  return all;
}

template <class Module>
void hear_block(Module& module, std::int64_t first, const Lanes8* x, EdgeList& edges) {
  Lanes8 peak[block];
  for (int i = 0; i < block; ++i) peak[i] = module.filtered(x[i]);
  for (int i = 0; i < block; ++i) edges.look(first + i, dsp::bits(module.demodulated(peak[i])));
}

/// Edges of so many parts' pins in so many samples of light.
template <class Module>
std::vector<std::vector<std::int64_t>> heard(Module module, PlanLight& light, std::int64_t samples,
                                             std::size_t parts) {
  EdgeList edges(parts);
  Lanes8 x[block];
  for (std::int64_t first = 0; first < samples; first += block) {
    light.fill(first, x);
    hear_block(module, first, x, edges);
  }
  return edges.take();
}

bool is_broken(const HiddenPart& part) { return part.broken != Broken::nothing; }

/// An instant of the plan in a part's recording.
double recorded_s(const HiddenPart& part, double plan_s) {
  return part.start_s + (1 + part.clock_error) * plan_s;
}

double on_grid(double s) { return std::round(s / analyser_step_s) * analyser_step_s; }

/// Pulses of edges, in the recording's time; one that the analyser misses is none.
std::vector<sim::PinPulse> pulses_of(const std::vector<double>& edges_s, double end_s) {
  std::vector<sim::PinPulse> pulses;
  for (std::size_t i = 0; i < edges_s.size(); i += 2) {
    const double until = i + 1 < edges_s.size() ? std::min(edges_s[i + 1], end_s) : end_s;
    const double from = std::max(edges_s[i], 0.0);
    if (from < until) pulses.push_back({from, until});
  }
  return pulses;
}

sim::PinRecording recording_of(const HiddenPart& part, double plan_end_s,
                               const std::vector<double>& edges_plan_s) {
  sim::PinRecording recording;
  recording.end_s = on_grid(recorded_s(part, plan_end_s) + part.tail_s);
  recording.resolution_s = analyser_step_s;
  std::vector<double> edges_s;
  for (const double at : edges_plan_s) edges_s.push_back(on_grid(recorded_s(part, at)));
  recording.pulses = pulses_of(edges_s, recording.end_s);
  return recording;
}

std::int64_t up_to(double samples) { return static_cast<std::int64_t>(std::ceil(samples)); }

/// As much dark as any drawn part needs, so that none depends on those beside it; more where a part
/// asks for more.
DarkAround dark_around(std::span<const HiddenPart> parts, double rate) {
  constexpr double usual_s = 3.1;
  DarkAround around{.before = up_to(usual_s * rate)};
  for (const HiddenPart& part : parts) {
    const double scale = rate / (1 + part.clock_error);
    around.before = std::max(around.before, up_to(part.start_s * scale));
    around.behind = std::max(around.behind, up_to(part.tail_s * scale));
  }
  return around;
}

}  // namespace

double sample_rate_of(const sim::Plan& plan) {
  constexpr double usual = 600e3, samples_a_cycle = 4;
  double highest = 0;
  for (const sim::PlanStep& step : plan.steps) highest = std::max(highest, step.carrier_hz);
  return usual * std::max(1.0, std::ceil(samples_a_cycle * highest / usual));
}

double end_s(const sim::Plan& plan) {
  double end = 0;
  for (const sim::PlanStep& step : plan.steps) end = std::max(end, sim::end_ms(step) * 1e-3);
  return end;
}

std::vector<std::vector<std::int64_t>> edges_of(const sim::Plan& plan,
                                                std::span<const HiddenPart> parts,
                                                double first_level_mw_per_m2, DarkAround around) {
  assert(!parts.empty() && parts.size() <= most_parts);
  const double rate = sample_rate_of(plan);
  const std::int64_t samples = around.before + up_to(end_s(plan) * rate) + around.behind;
  PlanLight light(plan, parts, first_level_mw_per_m2, rate, around.before);
  const auto designs = designs_of(parts, rate, tick_of(plan, rate));
  if (std::ranges::none_of(parts, is_broken))
    return heard(channel::ReceiverModule<Lanes8>(designs), light, samples, parts.size());
  return heard(BrokenModule<Lanes8>(designs, rules_of(parts, rate)), light, samples, parts.size());
}

std::vector<sim::PinRecording> recordings_of(const sim::Plan& plan,
                                             std::span<const HiddenPart> parts,
                                             double first_level_mw_per_m2) {
  const double rate = sample_rate_of(plan);
  const DarkAround around = dark_around(parts, rate);
  const auto edges = edges_of(plan, parts, first_level_mw_per_m2, around);
  std::vector<sim::PinRecording> recordings;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::vector<double> plan_s;
    for (const std::int64_t at : edges[i])
      plan_s.push_back(static_cast<double>(at - around.before) / rate);
    recordings.push_back(recording_of(parts[i], end_s(plan), plan_s));
  }
  return recordings;
}

}  // namespace hidden
