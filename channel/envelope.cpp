#include "channel/envelope.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "channel/envelope_kernel.hpp"
#include "channel/envelope_loop.hpp"
#include "channel/kernel_choice.hpp"
#include "channel/lane_parts.hpp"

namespace channel {
namespace {

using Complex = std::complex<double>;

/// State of the band-pass's pole in steady light of unit peak.
class SteadyState {
 public:
  SteadyState(Complex pole, double cycle, double duty)
      : pole_(pole), lit_(duty * cycle), cycle_(cycle), driven_(1.0 / pole) {
    const Complex lit = std::exp(pole * lit_), dark = std::exp(pole * (cycle - lit_));
    begin_ = dark * (lit - 1.0) * driven_ / (1.0 - lit * dark);
    end_ = lit * (begin_ + driven_) - driven_;
  }

  /// At a phase of the carrier, in cycles, and left alone from there for a time.
  Complex operator()(double phase, double time) const {
    const double t = phase * cycle_;
    if (t >= lit_) return std::exp(pole_ * (t - lit_ + time)) * end_;
    const Complex left = std::exp(pole_ * time);
    return left * (std::exp(pole_ * t) * (begin_ + driven_) - driven_);
  }

 private:
  Complex pole_;
  double lit_, cycle_;
  Complex driven_, begin_, end_;  // what light adds for ever; where light begins, and ends
};

double fraction(double x) { return x - std::floor(x); }

/// A trial in steps.
class StepClock {
 public:
  StepClock(const EnvelopeChain& chain, std::uint32_t carrier_phase)
      : hz_(chain.carrier.value), first_(chain.unit.peak_phase - carrier_phase * 0x1p-32) {}
  double seconds(double step) const { return (step + first_) / hz_; }
  std::int64_t at_or_after(dsp::Seconds t) const {
    return static_cast<std::int64_t>(std::ceil(t.value * hz_ - first_));
  }

 private:
  double hz_, first_;
};

/// One lane's stretches in the kernels' form, and its pin.
class EnvelopeLane {
 public:
  EnvelopeLane(const EnvelopeChain& chain, const EnvelopeInput& input,
               std::span<const std::int32_t> steps)
      : clock_(chain, input.carrier_phase), pin_(true, input.drive->end()) {
    std::int64_t done = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      begins_.push_back(clock_.at_or_after(input.begins[i]));
      rests_.push_back(begins_.back() - done);
      assert(rests_.back() >= 0);
      done = begins_.back() + steps[i];
    }
    add_edges(chain, input, steps);
    for (std::size_t i = 0; i < steps.size(); ++i)
      stretches_.push_back({edges_[i].data(), edges_[i].size(), static_cast<float>(rests_[i])});
  }

  const EnvelopeStretch* stretches() const { return stretches_.data(); }
  /// The pin changes so many steps behind the begin of a stretch, unless the trial is over by then.
  void add_edge(std::size_t stretch, double step) {
    const double last = pin_.edges().empty() ? 0 : pin_.edges().back().value;
    const double at = clock_.seconds(static_cast<double>(begins_[stretch]) + step - 0.5);
    if (at <= pin_.end().value) pin_.add_edge(dsp::Seconds(std::max(last, at)));
  }
  dsp::LogicTrace take() { return std::move(pin_); }

 private:
  void add_edges(const EnvelopeChain& chain, const EnvelopeInput& input,
                 std::span<const std::int32_t> steps) {
    const SteadyState steady(chain.unit.pole, 1 / chain.carrier.value, chain.duty);
    edges_.resize(steps.size());
    bool lit = !input.drive->initial();
    std::size_t stretch = 0;
    for (const dsp::Seconds edge : input.drive->edges()) {
      lit = !lit;
      const dsp::Seconds behind = edge + chain.unit.delay;
      const std::int64_t step = clock_.at_or_after(behind);
      while (stretch + 1 < steps.size() && step >= begins_[stretch + 1]) ++stretch;
      assert(step >= begins_[stretch]);
      const double phase =
          fraction(edge.value * chain.carrier.value + input.carrier_phase * 0x1p-32);
      const double until = clock_.seconds(static_cast<double>(step) - 1) - behind.value;
      const Complex free =
          (lit ? -1.0 : 1.0) * chain.unit.irradiance * chain.unit.gain * steady(phase, until);
      edges_[stretch].push_back({.step = static_cast<std::int32_t>(step - begins_[stretch]),
                                 .re = static_cast<float>(free.real()),
                                 .im = static_cast<float>(free.imag()),
                                 .lit = lit});
    }
  }

  StepClock clock_;
  dsp::LogicTrace pin_;
  std::vector<std::int64_t> begins_, rests_;
  std::vector<std::vector<EnvelopeEdge>> edges_;
  std::vector<EnvelopeStretch> stretches_;
};

/// Inputs of a group in the kernels' form, with the memory that they point to.
class EnvelopeGroup {
 public:
  EnvelopeGroup(const EnvelopeChain& chain, std::span<const EnvelopeInput> inputs,
                std::span<const std::int32_t> steps, const std::atomic<bool>* stop)
      : stop_(stop) {
    lanes_.reserve(inputs.size());
    for (const EnvelopeInput& input : inputs) lanes_.emplace_back(chain, input, steps);
    for (std::size_t i = 0; i < most_lanes; ++i) {
      const std::size_t from = std::min(i, inputs.size() - 1);  // an idle lane repeats the last
      kernel_.lane[i] = {lanes_[from].stretches(), inputs[from].noise_seed};
    }
    kernel_.design = &chain.unit.design;
    kernel_.steps = steps.data();
    kernel_.n_stretches = steps.size();
    kernel_.on_edge = &EnvelopeGroup::add_edge;
    kernel_.stopped = &EnvelopeGroup::stopped;
    kernel_.context = this;
  }
  EnvelopeGroup(const EnvelopeGroup&) = delete;
  EnvelopeGroup& operator=(const EnvelopeGroup&) = delete;

  const EnvelopeKernelInput& kernel() const { return kernel_; }
  std::vector<dsp::LogicTrace> take() {
    std::vector<dsp::LogicTrace> pins;
    for (EnvelopeLane& lane : lanes_) pins.push_back(lane.take());
    return pins;
  }

 private:
  static void add_edge(void* self, int lane, std::size_t stretch, double step) {
    auto& lanes = static_cast<EnvelopeGroup*>(self)->lanes_;
    const auto i = static_cast<std::size_t>(lane);
    if (i < lanes.size()) lanes[i].add_edge(stretch, step);
  }
  static bool stopped(void* self) {
    const std::atomic<bool>* stop = static_cast<EnvelopeGroup*>(self)->stop_;
    return stop != nullptr && stop->load(std::memory_order_relaxed);
  }

  std::vector<EnvelopeLane> lanes_;
  const std::atomic<bool>* stop_;
  EnvelopeKernelInput kernel_;
};

constexpr Kernels<EnvelopeKernelInput> envelope_kernels{
    .baseline = run_envelopes_baseline,
#ifdef COSYS_HAVE_X86
    .v3 = run_envelopes_v3,
    .v4 = run_envelopes_v4,
#endif
};

}  // namespace

std::vector<dsp::LogicTrace> propagate_envelopes(const EnvelopeChain& chain,
                                                 std::span<const EnvelopeInput> inputs,
                                                 std::span<const std::int32_t> steps,
                                                 const std::atomic<bool>* stop,
                                                 InstructionSet set) {
  return pins_in_parts(inputs.size(), set, [&](std::size_t first, std::size_t n) {
    EnvelopeGroup group(chain, inputs.subspan(first, n), steps, stop);
    run_narrowest(envelope_kernels, group.kernel(), n, set);
    return group.take();
  });
}

dsp::LogicTrace propagate_envelope(const EnvelopeChain& chain, const EnvelopeInput& input,
                                   std::span<const std::int32_t> steps) {
  EnvelopeGroup group(chain, {&input, 1}, steps, nullptr);
  EnvelopeLoop<float>(group.kernel()).run();
  return group.take().front();
}

}  // namespace channel
