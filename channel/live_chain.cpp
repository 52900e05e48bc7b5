#include "channel/live_chain.hpp"

#include <algorithm>
#include <cassert>
#include <vector>

#include "channel/bursts.hpp"
#include "channel/chain_kernel.hpp"
#include "channel/kernel_disturbances.hpp"

namespace channel {
namespace {

/// What is keyed on one LED, without what has long passed.
class KeyedBursts {
 public:
  KeyedBursts() = default;
  KeyedBursts(const Burst* first, std::size_t n) : bursts_(first, first + n) {}

  void add(const std::vector<Burst>& more) {
    bursts_.insert(bursts_.end(), more.begin(), more.end());
  }
  void forget(std::int64_t samples) {
    const auto going_on = std::ranges::find_if(
        bursts_, [&](const Burst& burst) { return burst.off > static_cast<double>(samples); });
    bursts_.erase(bursts_.begin(), going_on);
  }
  void show_to(const Burst*& first, std::size_t& n) const {
    first = bursts_.data();
    n = bursts_.size();
  }

 private:
  std::vector<Burst> bursts_;
};

LiveKernel kernel_for(std::size_t chains, InstructionSet set) {
  assert(chains <= static_cast<std::size_t>(trials_at_once(set)));
#ifdef COSYS_HAVE_X86
  if (chains > narrow_lanes) return live_lanes_v4();
  if (runs_v3(set)) return live_lanes_v3();
#endif
  return live_lanes_baseline();
}

}  // namespace

struct LiveChains::State {
  State(const ChainDesign& chain, std::span<const ChainInput> inputs, InstructionSet set)
      : design(chain), own(inputs.size()), pins(inputs.size(), dsp::LogicTrace(true)) {
    kernel_.carrier = &design.carrier;
    kernel_.noise_dark = design.noise_dark;
    kernel_.noise_lit = design.noise_lit;
    kernel_.on_edge = &State::add_edge;
    kernel_.context = this;
    for (ChainKernelInput::Lane& lane : kernel_.lane) lane.module = &design.module;
    for (std::size_t i = 0; i < inputs.size(); ++i) take(inputs[i], kernel_.lane[i]);
    take_disturbances();
    live_ = kernel_for(inputs.size(), set);
    run_ = live_.start(kernel_);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { live_.stop(run_); }

  void advance(std::int64_t end) {
    show();
    live_.advance(run_, end);
    done_ = std::max(done_, end / chain_block * chain_block);
    for (dsp::LogicTrace& pin : pins) pin.observe_until(time_of(done_));
  }

  KeyedBursts& keyed(std::size_t chain, std::size_t which) {
    return others_keyed_[carrier_of_[which]][chain];
  }

 private:
  dsp::Seconds time_of(std::int64_t sample) const {
    return dsp::Seconds(static_cast<double>(sample) / design.sample_rate.value);
  }

  static void add_edge(void* self, std::int64_t sample, std::uint32_t lanes) {
    State& state = *static_cast<State*>(self);
    for (std::size_t i = 0; i < state.pins.size(); ++i)
      if ((lanes >> i & 1) != 0) state.pins[i].add_edge(state.time_of(sample));
  }

  void take(const ChainInput& input, ChainKernelInput::Lane& lane) {
    lane.carrier_phase = input.carrier_phase;
    lane.noise_seed = input.noise_seed;
    if (input.unit != nullptr) lane.module = input.unit;
    others_.add_lane(design.disturbances, input.disturbances, design.sample_rate);
  }

  /// The carriers_ among them become our own, as their bursts grow.
  void take_disturbances() {
    others_.show_to(kernel_);
    carriers_.assign(kernel_.carriers, kernel_.carriers + kernel_.n_carriers);
    kernel_.carriers = carriers_.data();
    for (const ChainKernelInput::Carrier& carrier : carriers_)
      for (std::size_t i = 0; i < own.size(); ++i) {
        if (i == 0) others_keyed_.emplace_back();
        others_keyed_.back().emplace_back(carrier.bursts[i], carrier.n_bursts[i]);
      }
    std::size_t next = 0;
    for (const Disturbance& d : design.disturbances) {
      carrier_of_.push_back(next);
      next += d.carrier.has_value();
    }
  }

  /// Bursts, which may have moved, to the kernel.
  void show() {
    for (std::size_t i = 0; i < own.size(); ++i) {
      own[i].forget(done_);
      own[i].show_to(kernel_.lane[i].bursts, kernel_.lane[i].n_bursts);
      for (std::size_t k = 0; k < carriers_.size(); ++k) {
        others_keyed_[k][i].forget(done_);
        others_keyed_[k][i].show_to(carriers_[k].bursts[i], carriers_[k].n_bursts[i]);
      }
    }
  }

 public:
  const ChainDesign& design;
  std::vector<KeyedBursts> own;       // one a chain
  std::vector<dsp::LogicTrace> pins;  // one a chain

 private:
  KernelDisturbances others_;
  std::vector<ChainKernelInput::Carrier> carriers_;     // theirs
  std::vector<std::vector<KeyedBursts>> others_keyed_;  // of each of those, one a chain
  std::vector<std::size_t> carrier_of_;                 // each disturbance's place among them
  ChainKernelInput kernel_;
  LiveKernel live_{};
  void* run_ = nullptr;
  std::int64_t done_ = 0;
};

LiveChains::LiveChains(const ChainDesign& design, std::span<const ChainInput> inputs,
                       InstructionSet set)
    : state_(std::make_unique<State>(design, inputs, set)) {}
LiveChains::~LiveChains() = default;
LiveChains::LiveChains(LiveChains&&) noexcept = default;

void LiveChains::key(std::size_t chain, const dsp::LogicTrace& drive) {
  state_->own[chain].add(bursts_of(drive, state_->design.sample_rate));
}

void LiveChains::key_disturbance(std::size_t chain, std::size_t which,
                                 const dsp::LogicTrace& drive) {
  state_->keyed(chain, which).add(bursts_of(drive, state_->design.sample_rate));
}

void LiveChains::advance(dsp::Seconds t) {
  state_->advance(static_cast<std::int64_t>(dsp::cycles(t, state_->design.sample_rate)));
}

const dsp::LogicTrace& LiveChains::pin(std::size_t chain) const { return state_->pins[chain]; }

}  // namespace channel
