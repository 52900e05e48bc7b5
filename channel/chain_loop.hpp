#pragma once
// The loop over samples, the same for one trial as float and for many as lanes. Block by block it
// is short loops, one behind the other: noise, light, light of others, the module, edges of the
// pin. The state of each stays in registers; that of all in one does not (tests/bench). For the
// kernels, and for who computes one trial alone.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "channel/chain_kernel.hpp"
#include "channel/correlator.hpp"
#include "channel/interference.hpp"
#include "channel/keyed_carrier.hpp"
#include "channel/noise_window.hpp"
#include "channel/receiver_module.hpp"
#include "dsp/lanes.hpp"
#include "dsp/normal.hpp"

namespace channel {

/// The probe that looks at nothing and costs nothing.
struct NoProbe {
  static constexpr bool looks = false;
  template <class T>
  void operator()(T, const ModuleTaps<T>&) const {}
};

constexpr int block = chain_block;
static_assert(block <= longest_interference_block && gain_step % block == 0);

/// Samples [from, to) of a carrier's block, no edge in them: noise of the lit or the dark strength,
/// and the light.
template <class T>
void add_steady_light(KeyedCarrier<T>& carrier, T dark, T lit, int from, int to, T* x) {
  const dsp::Mask<T> is_lit = carrier.lit_at(from);
  const T strength = dsp::choose(is_lit, lit, dark);
  for (int i = from; i < to; ++i) x[i] = dsp::fused(x[i], strength, carrier.steady(is_lit));
}

/// The same for a block with edges.
template <class T>
void add_keyed_light(KeyedCarrier<T>& carrier, T dark, T lit, T* x, int n) {
  for (int i = 0; i < n; ++i) {
    const int edge = carrier.next_edge(i, n);
    add_steady_light(carrier, dark, lit, i, edge, x);
    i = edge;
    if (i == n) return;
    const auto light = carrier(i);
    x[i] = dsp::fused(x[i], dsp::choose(light.lit, lit, dark), light.irradiance);
  }
}

/// Turns white noise into irradiance: noise of the lit or the dark strength, and the light.
template <class T>
void add_light(KeyedCarrier<T>& carrier, T dark, T lit, std::int64_t first, T* x, int n) {
  for (int done = 0; done < n;) {
    const int length = carrier.begin_block(first + done, n - done);
    T* const part = x + done;
    if (carrier.dark(length)) {
      for (int i = 0; i < length; ++i) part[i] = dsp::fused(part[i], dark, T(0.0f));
      carrier.skip(length);
    } else {
      add_keyed_light(carrier, dark, lit, part, length);
    }
    done += length;
  }
}

/// The light of others. Costs nothing where there is none.
template <class T>
class Interference {
 public:
  explicit Interference(const ChainKernelInput& in) {
    for (std::size_t i = 0; i < in.n_tones; ++i) load(in.tones[i]);
    for (std::size_t i = 0; i < in.n_tables; ++i) load(in.tables[i]);
    for (std::size_t i = 0; i < in.n_carriers; ++i) load(in.carriers[i]);
  }

  /// Other bursts of the carriers, equal as far as they are done.
  void resume(const ChainKernelInput& in) {
    for (std::size_t k = 0; k < in.n_carriers; ++k)
      for (int i = 0; i < dsp::lanes<T>; ++i)
        senders_[k].carrier.resume(i, {in.carriers[k].bursts[i], in.carriers[k].n_bursts[i]});
  }

  /// Adds the samples [first, first + n).
  void add(std::int64_t first, T* x, int n) {
    for (Tone<T>& tone : tones_) tone.add(x, n);
    for (PeriodicTable<T>& table : tables_) table.add(x, n);
    for (Sender& sender : senders_) add(sender, first, x, n);
  }

 private:
  struct Sender {
    KeyedCarrier<T> carrier;
    const float* gain;
  };

  static void add(Sender& sender, std::int64_t first, T* x, int n) {
    KeyedCarrier<T>& carrier = sender.carrier;
    if (carrier.begin_block(first, n) == n && carrier.dark(n)) return carrier.skip(n);
    if (sender.gain == nullptr) return add_light(carrier, T(1.0f), T(1.0f), first, x, n);
    T light[block] = {};
    add_light(carrier, T(1.0f), T(1.0f), first, light, n);
    const GainRamp<T> gain(sender.gain, first);
    for (int i = 0; i < n; ++i) x[i] = dsp::fused(light[i], gain(i), x[i]);
  }

  void load(const ChainKernelInput::Tone& in) {
    Tone<T>& tone = tones_.emplace_back(*in.design);
    for (int i = 0; i < dsp::lanes<T>; ++i) tone.load(i, in.phase[i]);
  }
  void load(const ChainKernelInput::Table& in) {
    PeriodicTable<T>& table = tables_.emplace_back(in.samples, in.period);
    for (int i = 0; i < dsp::lanes<T>; ++i) table.load(i, in.phase[i]);
  }
  void load(const ChainKernelInput::Carrier& in) {
    senders_.push_back({KeyedCarrier<T>(*in.design), in.gain});
    for (int i = 0; i < dsp::lanes<T>; ++i)
      senders_.back().carrier.load(i, {in.bursts[i], in.n_bursts[i]}, in.phase[i]);
  }

  std::vector<Tone<T>> tones_;
  std::vector<PeriodicTable<T>> tables_;
  std::vector<Sender> senders_;
};

/// Tells whoever asked that a loop over a block is done.
template <class T>
void done(const ChainKernelInput& in, ChainStage stage) {
  if (in.on_stage != nullptr) in.on_stage(in.stage_context, stage);
}

/// The modules of the lanes, which need not be alike.
template <class T>
ReceiverModule<T> modules_of(const ChainKernelInput& in) {
  ModuleDesignOf<T> units;
  for (int i = 0; i < dsp::lanes<T>; ++i) set_lane(units, i, *in.lane[i].module);
  return ReceiverModule<T>(units);
}

/// What samples [first, first + n) and a window have in common.
struct Overlap {
  std::int64_t from, to;  // empty unless from < to
};
template <class T, class Window>
Overlap overlap(std::int64_t first, int n, const Window& window) {
  return {std::max(first, window.first), std::min(first + n, window.first + window.n)};
}

/// Puts prescribed normals of the samples [first, first + n) into the place of drawn ones.
template <class T>
void prescribe(const ChainKernelInput& in, std::int64_t first, T* normals, int n) {
  for (int i = 0; i < dsp::lanes<T>; ++i) {
    const ChainKernelInput::Lane& lane = in.lane[i];
    for (std::size_t w = 0; w < lane.n_noise_windows; ++w) {
      const NoiseWindow& window = lane.noise_windows[w];
      const Overlap both = overlap<T>(first, n, window);
      for (std::int64_t at = both.from; at < both.to; ++at)
        dsp::set_lane(normals[at - first], i, window.normals[at - window.first]);
    }
  }
}

/// Noise, light and the light of others, which are the same for any receiver.
template <class T>
class Irradiance {
 public:
  explicit Irradiance(const ChainKernelInput& in)
      : in_(in), dark_(in.noise_dark), lit_(in.noise_lit), carrier_(*in.carrier), others_(in) {
    for (int i = 0; i < dsp::lanes<T>; ++i) {
      carrier_.load(i, {in.lane[i].bursts, in.lane[i].n_bursts}, in.lane[i].carrier_phase);
      noise_.seed(i, in.lane[i].noise_seed);
    }
  }

  /// Other bursts in the kernel's input, equal as far as they are done.
  void resume() {
    for (int i = 0; i < dsp::lanes<T>; ++i)
      carrier_.resume(i, {in_.lane[i].bursts, in_.lane[i].n_bursts});
    others_.resume(in_);
  }

  /// The block that begins at sample `first`; to be called for each in turn.
  void fill(std::int64_t first, T* x, int length) {
    noise_.fill(x, block);
    prescribe(in_, first, x, block);
    done<T>(in_, ChainStage::noise);
    add_light(carrier_, dark_, lit_, first, x, length);
    done<T>(in_, ChainStage::light);
    others_.add(first, x, length);
    done<T>(in_, ChainStage::others_light);
  }

 private:
  const ChainKernelInput& in_;
  T dark_, lit_;
  KeyedCarrier<T> carrier_;
  Interference<T> others_;
  dsp::NormalSource<T> noise_;
};

/// A block of light to the module's pins, bit i of each being lane i's. A probe looks behind each
/// sample, so its loops are one long.
template <class T, class Probe>
void receive(ReceiverModule<T>& module, const T* x, int length, dsp::LaneBits<T>* pins,
             Probe probe) {
  constexpr int step = Probe::looks ? 1 : block;
  T peak[step];
  for (int first = 0; first < length; first += step) {
    const int n = std::min(step, length - first);
    for (int i = 0; i < n; ++i) peak[i] = module.filtered(x[first + i]);
    for (int i = 0; i < n; ++i)
      pins[first + i] = static_cast<dsp::LaneBits<T>>(dsp::bits(module.demodulated(peak[i])));
    if constexpr (Probe::looks) probe(x[first], module.taps());
  }
}

/// Keeps the margins of a block.
template <class T>
struct MarginProbe {
  static constexpr bool looks = true;
  T* next;
  void operator()(T, const ModuleTaps<T>& taps) { *next++ = taps.peak - taps.threshold; }
};

/// Whether any lane wants margins of the samples [first, first + n).
template <class T>
bool wants_margins(const ChainKernelInput& in, std::int64_t first, int n) {
  for (int i = 0; i < dsp::lanes<T>; ++i) {
    for (std::size_t w = 0; w < in.lane[i].n_margin_windows; ++w) {
      const Overlap both = overlap<T>(first, n, in.lane[i].margin_windows[w]);
      if (both.from < both.to) return true;
    }
  }
  return false;
}

template <class T>
void give_margins(const ChainKernelInput& in, std::int64_t first, const T* margins, int n) {
  for (int i = 0; i < dsp::lanes<T>; ++i) {
    const ChainKernelInput::Lane& lane = in.lane[i];
    for (std::size_t w = 0; w < lane.n_margin_windows; ++w) {
      const MarginWindow& window = lane.margin_windows[w];
      const Overlap both = overlap<T>(first, n, window);
      for (std::int64_t at = both.from; at < both.to; ++at)
        window.margins[at - window.first] = dsp::lane(margins[at - first], i);
    }
  }
}

/// A block as in receive(), with the margins that somebody wants of it.
template <class T>
void receive_with_margins(const ChainKernelInput& in, ReceiverModule<T>& module, std::int64_t first,
                          const T* x, int length, dsp::LaneBits<T>* pins) {
  T margins[block];
  receive(module, x, length, pins, MarginProbe<T>{margins});
  give_margins(in, first, margins, length);
}

/// Tells of each change of the pins in a block, of which most have none: eight bytes a look.
template <class T>
void report_edges(const ChainKernelInput& in, std::int64_t first, const dsp::LaneBits<T>* pins,
                  int length, dsp::LaneBits<T>& before) {
  using Bits = dsp::LaneBits<T>;
  constexpr int look = sizeof(std::uint64_t) / sizeof(Bits);
  constexpr std::uint64_t each = ~std::uint64_t{0} / static_cast<Bits>(~0u);
  for (int i = 0; i < length;) {
    const std::uint64_t same = before * each;
    if (i + look <= length && __builtin_memcmp(pins + i, &same, sizeof same) == 0) {
      i += look;
      continue;
    }
    const std::uint32_t edges = pins[i] ^ before;
    if (edges != 0) in.on_edge(in.context, first + i + 1, edges);
    before = pins[i++];
  }
}

template <class T, class Probe>
void run_chain(const ChainKernelInput& in, Probe probe) {
  Irradiance<T> irradiance(in);
  ReceiverModule<T> module = modules_of<T>(in);
  T x[block];
  dsp::LaneBits<T> pins[block];
  auto before = static_cast<dsp::LaneBits<T>>(dsp::bits(dsp::Mask<T>(true)));
  for (std::int64_t first = 0; first < in.samples && !in.stopped(in.context); first += block) {
    const int length = static_cast<int>(std::min<std::int64_t>(block, in.samples - first));
    irradiance.fill(first, x, length);
    if (!Probe::looks && wants_margins<T>(in, first, length))
      receive_with_margins(in, module, first, x, length, pins);
    else
      receive(module, x, length, pins, probe);
    done<T>(in, ChainStage::receiver);
    report_edges<T>(in, first, pins, length, before);
    done<T>(in, ChainStage::pin);
  }
}

/// A chain that goes on by the block while its LEDs are being keyed.
template <class T>
class ChainRun {
 public:
  explicit ChainRun(const ChainKernelInput& in)
      : in_(in), irradiance_(in), module_(modules_of<T>(in)) {}

  /// Whole blocks up to sample `end`, with the bursts that the input has by now.
  void advance(std::int64_t end) {
    irradiance_.resume();
    T x[block];
    dsp::LaneBits<T> pins[block];
    for (; done_ + block <= end; done_ += block) {
      irradiance_.fill(done_, x, block);
      receive(module_, x, block, pins, NoProbe{});
      report_edges<T>(in_, done_, pins, block, before_);
    }
  }

 private:
  const ChainKernelInput& in_;
  Irradiance<T> irradiance_;
  ReceiverModule<T> module_;
  dsp::LaneBits<T> before_ = static_cast<dsp::LaneBits<T>>(dsp::bits(dsp::Mask<T>(true)));
  std::int64_t done_ = 0;
};

/// The same light to matched receivers (channel/ideal_receiver.hpp), which have none of a module's
/// stages: their taps are NaN.
template <class T, class Probe>
void run_correlator(const ChainKernelInput& in, Probe probe) {
  Irradiance<T> irradiance(in);
  Correlator<T> correlator(in.carrier->step);
  for (int i = 0; i < dsp::lanes<T>; ++i)
    correlator.load(i, {in.lane[i].slots, in.lane[i].n_slots},
                    fundamental_phase(*in.carrier, in.lane[i].carrier_phase));
  const T none(__builtin_nanf(""));
  T x[block];
  for (std::int64_t first = 0; first < in.samples && !in.stopped(in.context); first += block) {
    const int length = static_cast<int>(std::min<std::int64_t>(block, in.samples - first));
    irradiance.fill(first, x, length);
    correlator(first, x, length,
               [&](int lane, const SlotSums& sums) { in.on_slot(in.context, lane, sums); });
    done<T>(in, ChainStage::receiver);
    for (int i = 0; i < length; ++i) probe(x[i], ModuleTaps<T>{none, none, none, none, none});
  }
}

}  // namespace channel
