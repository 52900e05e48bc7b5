#pragma once
// The stages of channel/receiver_module.hpp at one step a carrier cycle. A peak is in the middle of
// its step, give or take half; what the comparator makes of it is an interval of time, and hold and
// integrator go on from interval to interval, not from sample to sample. The follower and the slow
// AGC are the waveform's.
#include <cstdint>

#include "channel/demodulator.hpp"
#include "channel/envelope_design.hpp"
#include "channel/slow_agc.hpp"
#include "dsp/angle.hpp"
#include "dsp/lanes.hpp"

namespace channel {

/// The same in all lanes.
template <class T>
EnvelopeNoise<T> in_all_lanes(const EnvelopeNoise<float>& one) {
  return {one.re, one.cross, one.im};
}
template <class T>
SlowAgcDesignOf<T> in_all_lanes(const SlowAgcDesign& one) {
  SlowAgcDesignOf<T> all;
  for (int i = 0; i < dsp::lanes<T>; ++i) set_lane(all, i, one);
  return all;
}
template <class T>
EnvelopeDesignOf<T> in_all_lanes(const EnvelopeDesign& d) {
  return {d.keep_re,
          d.keep_im,
          d.drift_re,
          d.drift_im,
          d.seen,
          in_all_lanes<T>(d.dark),
          in_all_lanes<T>(d.lit),
          in_all_lanes<T>(d.resting),
          d.peak,
          d.threshold,
          d.atc_fraction,
          d.atc_decay,
          d.atc_octaves,
          d.hold,
          d.integrator,
          in_all_lanes<T>(d.agc),
          d.least_db};
}

/// The band-pass output about the middle of a step: its envelope, and the part of it that is the
/// response to edges.
template <class T>
struct Envelope {
  T re, im, edge_re, edge_im;
};

/// The band-pass as its envelope: the response to steady light; that to the edges of bursts, which
/// turns and fades; and noise, which does the same and is renewed.
template <class T>
class EnvelopeBandPass {
 public:
  explicit EnvelopeBandPass(const EnvelopeDesignOf<T>& d)
      : keep_re_(d.keep_re), keep_im_(d.keep_im), seen_(d.seen) {}

  /// Light of steady output `peak`, or dark; and the noise that comes with it.
  void set_light(T peak, const EnvelopeNoise<T>& noise) {
    steady_ = peak;
    noise_ = noise;
  }
  /// No edge for long, and the noise.
  void set(T re, T im) {
    edge_re_ = edge_im_ = T(0.0f);
    re_ = re;
    im_ = im;
  }
  /// An edge before the next step.
  void add_edge(T re, T im) {
    edge_re_ = edge_re_ + re;
    edge_im_ = edge_im_ + im;
  }

  /// Forgets edges of long ago, before they become denormal numbers.
  void settle() {
    const T power = dsp::fused(edge_re_, edge_re_, edge_im_ * edge_im_);
    const auto heard = power > T(1e-24f);
    edge_re_ = dsp::choose(heard, edge_re_, T(0.0f));
    edge_im_ = dsp::choose(heard, edge_im_, T(0.0f));
  }

  /// One step with two standard normals.
  Envelope<T> operator()(T x, T y) {
    fade(edge_re_, edge_im_);
    fade(re_, im_);
    const T noise_re = noise_.re * x, noise_im = dsp::fused(noise_.cross, x, noise_.im * y);
    const T re = dsp::fused(seen_, noise_re, re_), im = dsp::fused(seen_, noise_im, im_);
    re_ = re_ + noise_re;
    im_ = im_ + noise_im;
    return {steady_ + (edge_re_ + re), edge_im_ + im, edge_re_, edge_im_};
  }

 private:
  void fade(T& re, T& im) const {
    const T faded = dsp::fused(keep_re_, re, -(keep_im_ * im));
    im = dsp::fused(keep_im_, re, keep_re_ * im);
    re = faded;
  }

  T keep_re_, keep_im_, seen_;
  EnvelopeNoise<T> noise_{};
  T steady_ = T(0.0f);
  T edge_re_ = T(0.0f), edge_im_ = T(0.0f);
  T re_ = T(0.0f), im_ = T(0.0f);
};

/// A peak of the band-pass output: its height, one over that, and when it is, from the middle of
/// the step.
template <class T>
struct Peak {
  T height, inverse, at;
};

/// The peaks of an envelope. That of noise is as likely to grow until the peak as to fall, the
/// response to edges is not.
template <class T>
class PeakFinder {
 public:
  explicit PeakFinder(const EnvelopeDesignOf<T>& d)
      : drift_re_(d.drift_re), drift_im_(d.drift_im) {}

  Peak<T> operator()(const Envelope<T>& e) const {
    const T one(1.0f);
    const T power = dsp::fused(e.re, e.re, dsp::fused(e.im, e.im, T(1e-30f)));
    const T at = -dsp::turns(e.re, e.im);
    const T slope_re = dsp::fused(drift_re_, e.edge_re, -(drift_im_ * e.edge_im));
    const T slope_im = dsp::fused(drift_im_, e.edge_re, drift_re_ * e.edge_im);
    const T inverse = one / power;
    const T later = at * (dsp::fused(e.re, slope_re, e.im * slope_im) * inverse);
    const T height = dsp::square_root(power);
    return {dsp::fused(height, later, height), height * inverse * (one - later), at};
  }

  /// No peak is higher: half a step away the response to edges has moved by less than itself.
  T bound(const Envelope<T>& e) const {
    const auto size = [](T x) { return dsp::larger(x, -x); };
    return (size(e.re) + size(e.im) + size(e.edge_re) + size(e.edge_im)) * T(1.0001f);
  }

 private:
  T drift_re_, drift_im_;
};

/// A step behind the comparator: lit until `end`, where a hold ends, and again from `begin`.
template <class T>
struct LitParts {
  T end, begin;
  T length() const { return end + (T(1.0f) - begin); }
};

/// A comparator pulse a carrier cycle becomes one level: it holds for a bit more than a cycle.
template <class T>
class EnvelopeHold {
 public:
  explicit EnvelopeHold(T length) : length_(length) {}

  /// The comparator is high while the peak's cosine is above the level.
  LitParts<T> operator()(const Peak<T>& peak, T level) {
    const T zero(0.0f), one(1.0f), middle(0.5f);
    const auto pulse = peak.height > level;
    const T half = dsp::turns_of_cosine(dsp::smaller(level * peak.inverse, one));
    const T centre = middle + peak.at;
    const T begin = dsp::choose(pulse, dsp::larger(centre - half, zero), one);
    const T end = dsp::choose(pulse, centre + (half + length_), zero);
    const LitParts<T> lit{dsp::smaller(left_, begin), begin};
    left_ = dsp::larger(dsp::larger(left_, end) - one, zero);
    return lit;
  }
  /// The same where no peak exceeds the level.
  LitParts<T> operator()() {
    const T one(1.0f);
    const LitParts<T> lit{dsp::smaller(left_, one), one};
    left_ = dsp::larger(left_ - one, T(0.0f));
    return lit;
  }

 private:
  T length_, left_ = T(0.0f);
};

/// Counts up in light and down in dark between two stops; the output switches at the stops.
template <class T>
class EnvelopeIntegrator {
 public:
  explicit EnvelopeIntegrator(T top) : top_(top) {}

  /// True while the output reports light.
  dsp::Mask<T> operator()(const LitParts<T>& lit) {
    const T zero(0.0f), one(1.0f);
    const T first = level_ + lit.end;
    const T fallen = dsp::smaller(first, top_) - (lit.begin - lit.end);
    const T last = dsp::larger(fallen, zero) + (one - lit.begin);
    const auto early = first >= top_, full = last >= top_;
    on_ = full | ((on_ | early) & (fallen > zero));
    const T late = dsp::choose(full, one - (last - top_), lit.begin + dsp::smaller(fallen, zero));
    edge_ = dsp::choose(early, top_ - level_, late);
    level_ = dsp::smaller(last, top_);
    return on_;
  }
  /// If the output switched in the last step: when, from its begin.
  T edge() const { return edge_; }

 private:
  T top_, level_ = T(0.0f), edge_ = T(0.0f);
  dsp::Mask<T> on_ = dsp::Mask<T>(false);
};

/// From peaks to the pin.
template <class T>
class EnvelopeDemodulator {
 public:
  explicit EnvelopeDemodulator(const EnvelopeDesignOf<T>& d)
      : threshold_(d.threshold),
        margin_(d.agc.margin),
        least_db_(d.least_db),
        octaves_(d.atc_octaves),
        peaks_(d),
        follower_(d.atc_fraction, d.atc_decay),
        signal_(d.hold),
        activity_(d.hold),
        integrator_(d.integrator),
        agc_(d.agc) {
    set_gain(T(1.0f));
  }

  /// The steps of a tick: at the end of each whether the output reports light, bit i of it being
  /// lane i's, and when in it the output switched, if it did.
  void operator()(const Envelope<T>* envelope, dsp::LaneBits<T>* light, T* edge) {
    if (dsp::any(bound(envelope) > sensed_))
      see(envelope, light, edge);
    else
      see_nothing(light, edge);
    agc_(active_);
    set_gain(agc_.ahead(middle_of_tick));
    active_ = T(0.0f);
  }

  /// Dark steps in which nothing is seen.
  void rest(T steps) {
    follower_.rest(dsp::power_of_two(dsp::larger(-(octaves_ * steps), T(-125.0f))));
    set_gain(agc_.rest(steps, least_db_));
  }

 private:
  T bound(const Envelope<T>* envelope) const {
    T highest(0.0f);
    for (int i = 0; i < steps_per_tick; ++i)
      highest = dsp::larger(highest, peaks_.bound(envelope[i]));
    return highest;
  }

  // What no comparator sees the follower does not either, whichever lanes run together.
  void see(const Envelope<T>* envelope, dsp::LaneBits<T>* light, T* edge) {
    Peak<T> peaks[steps_per_tick];
    for (int i = 0; i < steps_per_tick; ++i) peaks[i] = peaks_(envelope[i]);
    for (int i = 0; i < steps_per_tick; ++i) {
      const T height = peaks[i].height;
      const T following = follower_(dsp::choose(height > sensed_, height, T(0.0f)));
      active_ = active_ + activity_(peaks[i], dsp::larger(sensed_, following)).length();
      count(signal_(peaks[i], dsp::larger(fixed_, following)), light + i, edge + i);
    }
  }
  void see_nothing(dsp::LaneBits<T>* light, T* edge) {
    for (int i = 0; i < steps_per_tick; ++i) {
      follower_(T(0.0f));
      active_ = active_ + activity_().length();
      count(signal_(), light + i, edge + i);
    }
  }
  void count(const LitParts<T>& lit, dsp::LaneBits<T>* light, T* edge) {
    *light = static_cast<dsp::LaneBits<T>>(dsp::bits(integrator_(lit)));
    *edge = integrator_.edge();
  }

  /// The waveform's gain is that of its last tick, which is as long as a step.
  static constexpr float middle_of_tick = (steps_per_tick - 1) * 0.5f / steps_per_tick;

  void set_gain(T gain) {
    fixed_ = threshold_ * gain;
    sensed_ = fixed_ * margin_;
  }

  T threshold_, margin_, least_db_, octaves_;
  T fixed_, sensed_;
  T active_ = T(0.0f);
  PeakFinder<T> peaks_;
  PeakFollower<T> follower_;
  EnvelopeHold<T> signal_, activity_;
  EnvelopeIntegrator<T> integrator_;
  SlowAgc<T> agc_;
};

}  // namespace channel
