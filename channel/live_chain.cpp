#include "channel/live_chain.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "channel/bursts.hpp"
#include "channel/chain_loop.hpp"
#include "channel/kernel_disturbances.hpp"

namespace channel {
namespace {

/// What is keyed on one LED, without what has long passed.
class KeyedBursts {
 public:
  void add(std::span<const Burst> more) { bursts_.insert(bursts_.end(), more.begin(), more.end()); }
  void forget(std::int64_t samples) {
    const auto passed = std::ranges::find_if(
        bursts_, [&](const Burst& burst) { return burst.off > static_cast<double>(samples); });
    bursts_.erase(bursts_.begin(), passed);
  }
  const Burst* data() const { return bursts_.data(); }
  std::size_t size() const { return bursts_.size(); }

 private:
  std::vector<Burst> bursts_;
};

}  // namespace

struct LiveChain::State {
  State(const ChainDesign& chain, const ChainInput& input)
      : design(chain),
        kernel(kernel_of(input)),
        irradiance(kernel),
        module(modules_of<float>(kernel)) {
    kernel.on_flip = &State::flip;
    kernel.context = this;
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void run_to(std::int64_t end) {
    show();
    irradiance.resume();
    float x[block];
    dsp::LaneBits<float> pins[block];
    for (; done + block <= end; done += block) {
      irradiance.fill(done, x, block);
      receive(module, x, block, pins, NoProbe{});
      report_flips<float>(kernel, done, pins, block, before);
    }
    pin.observe_until(reached());
  }

  dsp::Seconds reached() const {
    return dsp::Seconds(static_cast<double>(done) / design.sample_rate.value);
  }

  const ChainDesign& design;
  KernelDisturbances others;
  std::vector<ChainKernelInput::Carrier> carriers;  // theirs
  std::vector<std::size_t> carrier_of;              // each disturbance's place among them
  KeyedBursts own;
  std::vector<KeyedBursts> keyed;  // one a carrier
  ChainKernelInput kernel;
  Irradiance<float> irradiance;
  ReceiverModule<float> module;
  dsp::LaneBits<float> before =
      static_cast<dsp::LaneBits<float>>(dsp::bits(dsp::Mask<float>(true)));
  std::int64_t done = 0;
  dsp::LogicTrace pin{true};

 private:
  static void flip(void* self, std::int64_t sample, std::uint32_t) {
    State& state = *static_cast<State*>(self);
    state.pin.flip_at(dsp::Seconds(static_cast<double>(sample) / state.design.sample_rate.value));
  }

  ChainKernelInput kernel_of(const ChainInput& input) {
    std::size_t next_carrier = 0;
    ChainKernelInput in;
    in.carrier = &design.carrier;
    in.noise_dark = design.noise_dark;
    in.noise_lit = design.noise_lit;
    in.lane[0].module = input.unit != nullptr ? input.unit : &design.module;
    in.lane[0].carrier_phase = input.carrier_phase;
    in.lane[0].noise_seed = input.noise_seed;
    others.add_lane(design.disturbances, input.disturbances, design.sample_rate);
    others.show_to(in);
    carriers.assign(in.carriers, in.carriers + in.n_carriers);
    in.carriers = carriers.data();
    for (const ChainKernelInput::Carrier& carrier : carriers)
      keyed.emplace_back().add({carrier.bursts[0], carrier.n_bursts[0]});
    for (const Disturbance& d : design.disturbances) {
      carrier_of.push_back(next_carrier);
      next_carrier += d.carrier.has_value();
    }
    return in;
  }

  /// Shows the bursts, which may have moved, to the kernel.
  void show() {
    own.forget(done);
    kernel.lane[0].bursts = own.data();
    kernel.lane[0].n_bursts = own.size();
    for (std::size_t k = 0; k < carriers.size(); ++k) {
      keyed[k].forget(done);
      carriers[k].bursts[0] = keyed[k].data();
      carriers[k].n_bursts[0] = keyed[k].size();
    }
  }
};

LiveChain::LiveChain(const ChainDesign& design, const ChainInput& input)
    : state_(std::make_unique<State>(design, input)) {}
LiveChain::~LiveChain() = default;
LiveChain::LiveChain(LiveChain&&) noexcept = default;

void LiveChain::key(const dsp::LogicTrace& drive) {
  state_->own.add(bursts_of(drive, state_->design.sample_rate));
}

void LiveChain::key_disturbance(std::size_t which, const dsp::LogicTrace& drive) {
  state_->keyed[state_->carrier_of[which]].add(bursts_of(drive, state_->design.sample_rate));
}

void LiveChain::advance(dsp::Seconds t) {
  state_->run_to(static_cast<std::int64_t>(dsp::cycles(t, state_->design.sample_rate)));
}

dsp::Seconds LiveChain::reached() const { return state_->reached(); }

const dsp::LogicTrace& LiveChain::pin() const { return state_->pin; }

}  // namespace channel
