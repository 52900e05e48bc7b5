#pragma once
// Correlation of light with the carrier, bit slot by bit slot: what both matched receivers see of
// a bit. Each lane has slots of its own; between two edges of any lane all run in step. Sums are
// single precision over 256 samples at most, on a grid that is the same for all trials, and double
// beyond: long slots lose nothing, and which trials run together cannot change a bit.
#include <algorithm>
#include <cstdint>
#include <span>

#include "dsp/lanes.hpp"
#include "dsp/whole_turn.hpp"

namespace channel {

/// The samples of a bit slot: those whose centre is in it. `end` is past the last.
struct SlotSamples {
  std::int64_t begin, end;
};

/// Sums over a slot of the light times the carrier's cosine and sine.
struct SlotSums {
  double in_phase = 0, quadrature = 0;
};

template <class T>
class Correlator {
 public:
  /// Carrier cycles a sample, in 2^-32.
  explicit Correlator(std::uint32_t step) : step_(step) {}

  /// Gives a lane its slots (which must outlive this, in order, none empty) and the phase of the
  /// carrier's fundamental at the centre of sample 0, in 2^-32 cycles.
  void load(int lane, std::span<const SlotSamples> slots, std::uint32_t phase) {
    lane_[lane].slot = slots.data();
    lane_[lane].last = slots.data() + slots.size();
    dsp::set_lane(phase_, lane, phase);
  }

  /// The samples [first, first + n), the next ones; calls report(lane, sums) at each slot's end.
  template <class Report>
  void operator()(std::int64_t first, const T* x, int n, Report report) {
    for (int done = 0; done < n;) {
      open_slots(first + done);
      const int length = to_next_edge(first + done, n - done);
      if (any_open())
        add(x + done, length);
      else
        phase_ = phase_ + dsp::Words<T>(step_ * static_cast<std::uint32_t>(length));
      done += length;
      close_slots(first + done, report);
    }
    for (int i = 0; i < dsp::lanes<T>; ++i) move_sums(i);
  }

 private:
  struct Lane {
    const SlotSamples* slot = nullptr;  // the open one or else the next
    const SlotSamples* last = nullptr;
    bool open = false;
    SlotSums sums;
  };

  void open_slots(std::int64_t at) {
    for (int i = 0; i < dsp::lanes<T>; ++i) {
      Lane& lane = lane_[i];
      if (lane.open || lane.slot == lane.last || lane.slot->begin > at) continue;
      move_sums(i);
      lane.sums = {};
      lane.open = true;
    }
  }

  int to_next_edge(std::int64_t at, int length) const {
    std::int64_t least = length;
    for (const Lane& lane : lane_)
      if (lane.slot != lane.last)
        least = std::min(least, (lane.open ? lane.slot->end : lane.slot->begin) - at);
    return static_cast<int>(least);
  }

  bool any_open() const {
    bool open = false;
    for (const Lane& lane : lane_) open |= lane.open;
    return open;
  }

  void add(const T* x, int length) {
    T in_phase = in_phase_, quadrature = quadrature_;
    dsp::Words<T> phase = phase_;
    for (int i = 0; i < length; ++i) {
      const dsp::Phasor<T> carrier = dsp::whole_turn<T>(phase);
      in_phase = dsp::fused(x[i], carrier.cosine, in_phase);
      quadrature = dsp::fused(x[i], carrier.sine, quadrature);
      phase = phase + dsp::Words<T>(step_);
    }
    in_phase_ = in_phase;
    quadrature_ = quadrature;
    phase_ = phase;
  }

  template <class Report>
  void close_slots(std::int64_t at, Report report) {
    for (int i = 0; i < dsp::lanes<T>; ++i) {
      Lane& lane = lane_[i];
      if (!lane.open || lane.slot->end != at) continue;
      move_sums(i);
      report(i, lane.sums);
      ++lane.slot;
      lane.open = false;
    }
  }

  /// Out of the vectors, which start at 0 again.
  void move_sums(int i) {
    lane_[i].sums.in_phase += static_cast<double>(dsp::lane(in_phase_, i));
    lane_[i].sums.quadrature += static_cast<double>(dsp::lane(quadrature_, i));
    dsp::set_lane(in_phase_, i, 0);
    dsp::set_lane(quadrature_, i, 0);
  }

  std::uint32_t step_;
  dsp::Words<T> phase_ = dsp::Words<T>(0u);
  T in_phase_ = T(0.0f), quadrature_ = T(0.0f);
  Lane lane_[dsp::lanes<T>];
};

}  // namespace channel
