#include "channel/ideal_receiver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace channel {
namespace {

std::int64_t first_centre_from(dsp::Seconds t, dsp::Hertz sample_rate) {
  return static_cast<std::int64_t>(std::ceil(dsp::cycles(t, sample_rate) - 0.5));
}

}  // namespace

double fundamental_of(double peak, double duty) {
  return peak * 2 / std::numbers::pi * std::sin(std::numbers::pi * duty);
}

double amplitude_deviation(double sample, dsp::Hertz sample_rate, dsp::Hertz baud) {
  return sample * std::sqrt(2 * (baud / sample_rate));
}

bool says_light(const IdealDesign& design, const SlotSums& sums, std::int64_t samples) {
  const double sum = design.statistic == IdealDesign::Statistic::in_phase
                         ? sums.in_phase
                         : std::hypot(sums.in_phase, sums.quadrature);
  return 2 * sum > design.threshold * static_cast<double>(samples);
}

SlotSamples slot_samples(const BitSlot& slot, dsp::Hertz sample_rate) {
  return {first_centre_from(slot.begin, sample_rate), first_centre_from(slot.end, sample_rate)};
}

void SlotPin::decide(bool light) {
  const BitSlot& slot = (*slots_)[decided_];
  // Ends and begins of neighbours may differ by a rounding error; edges must not go back in time.
  const dsp::Seconds before = decided_ == 0 ? slot.begin : (*slots_)[decided_ - 1].end;
  pin_.set_at(std::max(slot.begin, before) + delay_, !light);
  pin_.set_at(slot.end + delay_, true);
  ++decided_;
}

dsp::LogicTrace SlotPin::take(dsp::Seconds end) {
  pin_.observe_until(end + delay_);
  return std::move(pin_);
}

SlotWriter::SlotWriter(const IdealDesign& design, std::span<const BitSlots> slots,
                       dsp::Hertz sample_rate, const std::atomic<bool>* stop)
    : design_(design), stop_(stop) {
  for (const BitSlots& of_lane : slots) {
    Lane& lane = lanes_.emplace_back(Lane{.pin = {of_lane, design_.delay}});
    for (const BitSlot& slot : of_lane) lane.samples.push_back(slot_samples(slot, sample_rate));
  }
}

void SlotWriter::attach_to(ChainKernelInput& kernel) {
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    kernel.lane[i].slots = lanes_[i].samples.data();
    kernel.lane[i].n_slots = lanes_[i].samples.size();
  }
  kernel.on_slot = &SlotWriter::write;
  kernel.stopped = &SlotWriter::stopped;
  kernel.context = this;
}

std::vector<dsp::LogicTrace> SlotWriter::take(std::span<const dsp::Seconds> ends) {
  std::vector<dsp::LogicTrace> pins;
  for (std::size_t i = 0; i < lanes_.size(); ++i) pins.push_back(lanes_[i].pin.take(ends[i]));
  return pins;
}

void SlotWriter::write(void* self, int lane, const SlotSums& sums) {
  SlotWriter& writer = *static_cast<SlotWriter*>(self);
  auto& [pin, samples] = writer.lanes_[static_cast<std::size_t>(lane)];
  const SlotSamples& slot = samples[pin.decided()];
  pin.decide(says_light(writer.design_, sums, slot.end - slot.begin));
}

bool SlotWriter::stopped(void* self) {
  const std::atomic<bool>* stop = static_cast<SlotWriter*>(self)->stop_;
  return stop != nullptr && stop->load(std::memory_order_relaxed);
}

}  // namespace channel
