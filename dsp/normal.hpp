#pragma once
// White Gaussian noise, dense: one fast generator a lane, seeded by an addressed draw, so that a
// trial always sees the noise that is its own. Generator: xoshiro128++ 1.0 (Blackman & Vigna 2021,
// "Scrambled linear pseudorandom number generators"); shape: Box & Muller 1958, in single
// precision.
#include <array>
#include <cstdint>
#include <utility>

#include "dsp/lanes.hpp"

namespace dsp {

/// xoshiro128++: one 32-bit word a call and lane. The four seed words of a lane must not all be 0.
template <class T>
class Xoshiro {
 public:
  void seed(int which_lane, const std::array<std::uint32_t, 4>& words) {
    set_lane(a_, which_lane, words[0] | 1u);  // never the all-zero state
    set_lane(b_, which_lane, words[1]);
    set_lane(c_, which_lane, words[2]);
    set_lane(d_, which_lane, words[3]);
  }

  Words<T> operator()() {
    const Words<T> result = rotate(a_ + d_, 7) + a_;
    const Words<T> t = b_ << 9;
    c_ = c_ ^ a_;
    d_ = d_ ^ b_;
    b_ = b_ ^ c_;
    a_ = a_ ^ d_;
    c_ = c_ ^ t;
    d_ = rotate(d_, 11);
    return result;
  }

 private:
  static Words<T> rotate(Words<T> w, int n) { return (w << n) | (w >> (32 - n)); }

  Words<T> a_{}, b_{}, c_{}, d_{};
};

/// -2 ln(n / 2^31) for whole n in [1, 2^31], never below zero; error below 1.5e-7 of one plus that.
/// Polynomial: Chebyshev fit of ln(1+t)/t, times -2. Powers of two are in its constants, where they
/// cost nothing and round nothing.
template <class T>
T squared_radius(T n) {
  constexpr float minus_two_ln2 = -1.386294361119891f;
  const Words<T> bits = to_bits(n) - Words<T>(0x4EB504F3u);   // mantissa into [sqrt(1/2), sqrt 2)
  const T exponent = to_float(bits & Words<T>(0xFF800000u));  // times 2^23
  const T t = from_bits((bits & Words<T>(0x007FFFFFu)) + Words<T>(0x3F3504F3u)) - T(1.0f);
  T p = fused(T(0.20268113911151886f), t, T(-0.3246837854385376f));
  p = fused(p, t, T(0.34494027495384216f));
  p = fused(p, t, T(-0.39797130227088928f));
  p = fused(p, t, T(0.49940142035484314f));
  p = fused(p, t, T(-0.6667022705078125f));
  p = fused(p, t, T(1.0000072717666626f));
  p = fused(p, t, T(-1.9999998807907104f));
  return larger(fused(exponent, T(minus_two_ln2 * 0x1p-23f), p * t), T(-0.0f));
}

/// sin and cos of a quarter turn times x, x in [0, 1); absolute error below 1e-7 (Chebyshev fits).
template <class T>
std::pair<T, T> quarter_turn(T x) {
  const T y = x * x;
  T s = fused(T(1.516751217423007e-4f), y, T(-4.674150608479977e-3f));
  s = fused(s, y, T(0.07968991994857788f));
  s = fused(s, y, T(-0.6459637880325317f));
  s = fused(s, y, T(1.5707963705062866f));
  T c = fused(T(8.581625297665596e-4f), y, T(-0.020810570567846298f));
  c = fused(c, y, T(0.2536506950855255f));
  c = fused(c, y, T(-1.2336982488632202f));
  c = fused(c, y, T(0.9999999403953552f));
  return {s * x, c};
}

/// Independent standard normals, two a call. Radius from 31 bits: reaches 6.5 sigma.
template <class T>
class NormalSource {
 public:
  void seed(int which_lane, const std::array<std::uint32_t, 4>& words) {
    words_.seed(which_lane, words);
  }

  /// What a pair of normals is made of: its radius is sqrt(-2 ln(uniform / 2^31)), `uniform` being
  /// a whole number in [1, 2^31].
  struct Draw {
    T uniform;
    Words<T> angle;
  };

  Draw draw() {
    const T uniform = to_float((words_() >> 1) | Words<T>(1u));
    return {uniform, words_()};
  }

  static std::pair<T, T> normals_of(const Draw& draw) {
    const Words<T> sign = Words<T>(0x80000000u), w = draw.angle;
    const auto [sine, cosine] = quarter_turn(to_float(w >> 8) * T(0x1p-24f));
    const T radius = square_root(squared_radius(draw.uniform));
    const T x = radius * cosine;
    const T y = radius * sine;
    return {from_bits(to_bits(x) ^ (w << 31)), from_bits(to_bits(y) ^ ((w << 30) & sign))};
  }

  std::pair<T, T> operator()() { return normals_of(draw()); }

  /// The next `n` normals, n even, in the order of the calls that would give them.
  void fill(T* normals, int n) {
    NormalSource local = *this;
    for (int i = 0; i < n; i += 2) {
      const auto [x, y] = local();
      normals[i] = x;
      normals[i + 1] = y;
    }
    *this = local;
  }

 private:
  Xoshiro<T> words_;
};

}  // namespace dsp
