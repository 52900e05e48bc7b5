#pragma once
// Matched receivers, for validation against closed forms: told when each bit is sent and what the
// carrier's frequency and phase are, they correlate the light of a bit with the carrier and decide
// by its in-phase part (coherent) or its envelope (noncoherent). They work on the same samples as a
// receiver module does (channel::detect). Proakis & Salehi, "Digital Communications", 5th ed.,
// 4.2, 4.5.
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "channel/chain_kernel.hpp"
#include "channel/correlator.hpp"
#include "dsp/logic_trace.hpp"
#include "dsp/units.hpp"

namespace channel {

/// When a bit is sent.
struct BitSlot {
  dsp::Seconds begin, end;
};
using BitSlots = std::vector<BitSlot>;  // in order, none overlapping

struct IdealDesign {
  enum class Statistic { in_phase, envelope };
  Statistic statistic;
  double threshold;    // amplitude of the carrier's fundamental from which a bit is light, mW/m2
  dsp::Seconds delay;  // of the pin: one bit, since a bit is known at its end
};

/// Amplitude of the fundamental of an on/off wave: (2/pi) sin(pi duty) of its peak.
double fundamental_of(double peak, double duty);

/// Standard deviation of that amplitude as measured over a bit, a component: of white samples with
/// standard deviation `sample`, sqrt(2 / samples a bit) of it.
double amplitude_deviation(double sample, dsp::Hertz sample_rate, dsp::Hertz baud);

/// Whether sums over a slot of so many samples say light.
bool says_light(const IdealDesign& design, const SlotSums& sums, std::int64_t samples);

/// The samples of a slot.
SlotSamples slot_samples(const BitSlot& slot, dsp::Hertz sample_rate);

/// A pin being written bit by bit, each late by `delay`; idle between them.
class SlotPin {
 public:
  /// The slots must outlive this.
  SlotPin(const BitSlots& slots, dsp::Seconds delay) : slots_(&slots), delay_(delay) {}

  /// Decides the next bit.
  void decide(bool light);
  std::size_t decided() const { return decided_; }
  /// The pin, observed until `end` of its drive wire and the delay.
  dsp::LogicTrace take(dsp::Seconds end);

 private:
  const BitSlots* slots_;
  dsp::Seconds delay_;
  std::size_t decided_ = 0;
  dsp::LogicTrace pin_{true};
};

/// Pins being written by what a kernel correlates.
class SlotWriter {
 public:
  SlotWriter(const IdealDesign& design, std::span<const BitSlots> slots, dsp::Hertz sample_rate,
             const std::atomic<bool>* stop);

  /// Makes the kernel correlate and report to this. The lanes' other inputs are the caller's.
  void attach_to(ChainKernelInput& kernel);
  /// The pins, given the ends of their drive wires.
  std::vector<dsp::LogicTrace> take(std::span<const dsp::Seconds> ends);

 private:
  struct Lane {
    SlotPin pin;
    std::vector<SlotSamples> samples{};
  };

  static void write(void* self, int lane, const SlotSums& sums);
  static bool stopped(void* self);

  IdealDesign design_;
  const std::atomic<bool>* stop_;
  std::vector<Lane> lanes_;
};

}  // namespace channel
