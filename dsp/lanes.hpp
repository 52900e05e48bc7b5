#pragma once
// One trial, eight or sixteen from one source: a stage is written over T = float, Lanes8 (eight
// independent trials in the lanes of one vector) or Lanes16 (dsp/lanes16.hpp) and holds no `if` on
// a sample, only choose(mask, a, b). Every operation here is exactly rounded, so a lane computes
// the same bits as float does, whatever the instruction set. Code built for several of them sets
// COSYS_ISA: a namespace of its own keeps the linker from mixing them. For the same reason no std::
// template may see a bare vector here: std::bit_cast of one would be one symbol with two calling
// conventions.
#include <cmath>
#include <cstdint>

#ifdef __AVX2__
#include <immintrin.h>
#endif

#ifndef COSYS_ISA
#define COSYS_ISA baseline
#endif

namespace dsp {
inline namespace COSYS_ISA {

struct Lanes8 {
  using Vector [[gnu::vector_size(32)]] = float;
  Vector v;
  Lanes8() = default;
  // Implicit: constants read as in scalar code.
  Lanes8(float all) : v{all, all, all, all, all, all, all, all} {}
  explicit Lanes8(Vector value) : v(value) {}
  friend Lanes8 operator+(Lanes8 a, Lanes8 b) { return Lanes8(a.v + b.v); }
  friend Lanes8 operator-(Lanes8 a, Lanes8 b) { return Lanes8(a.v - b.v); }
  friend Lanes8 operator*(Lanes8 a, Lanes8 b) { return Lanes8(a.v * b.v); }
  friend Lanes8 operator/(Lanes8 a, Lanes8 b) { return Lanes8(a.v / b.v); }
  friend Lanes8 operator-(Lanes8 a) { return Lanes8(-a.v); }
};

struct Words8 {  // eight uint32_t, wrapping
  using Vector [[gnu::vector_size(32)]] = std::uint32_t;
  Vector v;
  Words8() = default;
  Words8(std::uint32_t all) : v(Vector{} + all) {}
  explicit Words8(Vector value) : v(value) {}
  friend Words8 operator+(Words8 a, Words8 b) { return Words8(a.v + b.v); }
  friend Words8 operator-(Words8 a, Words8 b) { return Words8(a.v - b.v); }
  friend Words8 operator^(Words8 a, Words8 b) { return Words8(a.v ^ b.v); }
  friend Words8 operator|(Words8 a, Words8 b) { return Words8(a.v | b.v); }
  friend Words8 operator&(Words8 a, Words8 b) { return Words8(a.v & b.v); }
  friend Words8 operator<<(Words8 a, int n) { return Words8(a.v << n); }
  friend Words8 operator>>(Words8 a, int n) { return Words8(a.v >> n); }
};

struct Mask8 {  // eight truth values: all bits of a lane set, or none
  using Vector [[gnu::vector_size(32)]] = std::int32_t;
  Vector v;
  Mask8() = default;
  Mask8(bool all) : v(Vector{} - static_cast<std::int32_t>(all)) {}
  explicit Mask8(Vector value) : v(value) {}
  friend Mask8 operator&(Mask8 a, Mask8 b) { return Mask8(a.v & b.v); }
  friend Mask8 operator|(Mask8 a, Mask8 b) { return Mask8(a.v | b.v); }
  friend Mask8 operator^(Mask8 a, Mask8 b) { return Mask8(a.v ^ b.v); }
  friend Mask8 operator!(Mask8 a) { return Mask8(~a.v); }
};

inline Mask8 operator<(Lanes8 a, Lanes8 b) { return Mask8(a.v < b.v); }
inline Mask8 operator>(Lanes8 a, Lanes8 b) { return Mask8(a.v > b.v); }
inline Mask8 operator<=(Lanes8 a, Lanes8 b) { return Mask8(a.v <= b.v); }
inline Mask8 operator>=(Lanes8 a, Lanes8 b) { return Mask8(a.v >= b.v); }

template <class T>
struct LaneTraits;
template <>
struct LaneTraits<float> {
  static constexpr int width = 1;
  using Mask = bool;
  using Words = std::uint32_t;
  using Bits = std::uint8_t;
};
template <>
struct LaneTraits<Lanes8> {
  static constexpr int width = 8;
  using Mask = Mask8;
  using Words = Words8;
  using Bits = std::uint8_t;
};
template <class T>
using Mask = typename LaneTraits<T>::Mask;
template <class T>
using Words = typename LaneTraits<T>::Words;
/// A bit a lane.
template <class T>
using LaneBits = typename LaneTraits<T>::Bits;
template <class T>
inline constexpr int lanes = LaneTraits<T>::width;

inline float choose(bool m, float a, float b) { return m ? a : b; }
inline Lanes8 choose(Mask8 m, Lanes8 a, Lanes8 b) { return Lanes8(m.v ? a.v : b.v); }

/// The word where `m` holds, else 0.
inline std::uint32_t kept(bool m, std::uint32_t w) { return m ? w : 0; }
inline Words8 kept(Mask8 m, Words8 w) {
  return Words8(__builtin_bit_cast(Words8::Vector, m.v) & w.v);
}

// Words read as signed integers.
inline std::int32_t as_signed(std::uint32_t w) { return static_cast<std::int32_t>(w); }
inline Mask8::Vector as_signed(Words8 w) { return __builtin_bit_cast(Mask8::Vector, w.v); }
inline bool exceeds(std::uint32_t a, std::uint32_t b) { return as_signed(a) > as_signed(b); }
inline Mask8 exceeds(Words8 a, Words8 b) { return Mask8(as_signed(a) > as_signed(b)); }
inline std::uint32_t larger_signed(std::uint32_t a, std::uint32_t b) {
  return exceeds(a, b) ? a : b;
}
inline std::uint32_t smaller_signed(std::uint32_t a, std::uint32_t b) {
  return exceeds(b, a) ? a : b;
}
inline Words8 larger_signed(Words8 a, Words8 b) {
#ifdef __AVX2__
  return Words8(__builtin_bit_cast(
      Words8::Vector,
      _mm256_max_epi32(__builtin_bit_cast(__m256i, a.v), __builtin_bit_cast(__m256i, b.v))));
#else
  return Words8(as_signed(a) > as_signed(b) ? a.v : b.v);
#endif
}
inline Words8 smaller_signed(Words8 a, Words8 b) {
#ifdef __AVX2__
  return Words8(__builtin_bit_cast(
      Words8::Vector,
      _mm256_min_epi32(__builtin_bit_cast(__m256i, a.v), __builtin_bit_cast(__m256i, b.v))));
#else
  return Words8(as_signed(a) < as_signed(b) ? a.v : b.v);
#endif
}

/// Bit i tells lane i.
inline std::uint32_t bits(bool m) { return m; }
inline std::uint32_t bits(Mask8 m) {
#ifdef __AVX2__
  return static_cast<std::uint32_t>(_mm256_movemask_ps(__builtin_bit_cast(__m256, m.v)));
#else
  std::uint32_t all = 0;
  for (int i = 0; i < 8; ++i) all |= static_cast<std::uint32_t>(m.v[i] & 1) << i;
  return all;
#endif
}
template <class M>
bool any(M m) {
  return bits(m) != 0;
}

// a > b ? a : b, and the other way round; written so that a NaN in `a` is dropped.
inline float larger(float a, float b) { return a > b ? a : b; }
inline float smaller(float a, float b) { return a < b ? a : b; }
inline Lanes8 larger(Lanes8 a, Lanes8 b) {
#ifdef __AVX2__
  return Lanes8(__builtin_bit_cast(Lanes8::Vector, _mm256_max_ps(__builtin_bit_cast(__m256, a.v),
                                                                 __builtin_bit_cast(__m256, b.v))));
#else
  return choose(a > b, a, b);
#endif
}
inline Lanes8 smaller(Lanes8 a, Lanes8 b) {
#ifdef __AVX2__
  return Lanes8(__builtin_bit_cast(Lanes8::Vector, _mm256_min_ps(__builtin_bit_cast(__m256, a.v),
                                                                 __builtin_bit_cast(__m256, b.v))));
#else
  return choose(a < b, a, b);
#endif
}

// a * b + c, rounded once. The only fused operation: the compiler may not make its own.
inline float fused(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
inline Lanes8 fused(Lanes8 a, Lanes8 b, Lanes8 c) {
#ifdef __FMA__
  return Lanes8(__builtin_bit_cast(
      Lanes8::Vector,
      _mm256_fmadd_ps(__builtin_bit_cast(__m256, a.v), __builtin_bit_cast(__m256, b.v),
                      __builtin_bit_cast(__m256, c.v))));
#else
  Lanes8 r;
  for (int i = 0; i < 8; ++i) r.v[i] = __builtin_fmaf(a.v[i], b.v[i], c.v[i]);
  return r;
#endif
}

inline float square_root(float a) { return __builtin_sqrtf(a); }
inline Lanes8 square_root(Lanes8 a) {
#ifdef __AVX2__
  return Lanes8(
      __builtin_bit_cast(Lanes8::Vector, _mm256_sqrt_ps(__builtin_bit_cast(__m256, a.v))));
#else
  Lanes8 r;
  for (int i = 0; i < 8; ++i) r.v[i] = __builtin_sqrtf(a.v[i]);
  return r;
#endif
}

inline float from_bits(std::uint32_t w) { return __builtin_bit_cast(float, w); }
inline Lanes8 from_bits(Words8 w) { return Lanes8(__builtin_bit_cast(Lanes8::Vector, w.v)); }
inline std::uint32_t to_bits(float a) { return __builtin_bit_cast(std::uint32_t, a); }
inline Words8 to_bits(Lanes8 a) { return Words8(__builtin_bit_cast(Words8::Vector, a.v)); }

/// The word read as a signed integer, to the nearest float.
inline float to_float(std::uint32_t w) { return static_cast<float>(static_cast<std::int32_t>(w)); }
inline Lanes8 to_float(Words8 w) {
  return Lanes8(__builtin_convertvector(__builtin_bit_cast(Mask8::Vector, w.v), Lanes8::Vector));
}

/// Shift right of the word read as a signed integer: the sign bit fills.
inline std::uint32_t arithmetic_shift(std::uint32_t w, int n) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(w) >> n);
}
inline Words8 arithmetic_shift(Words8 w, int n) {
  return Words8(__builtin_bit_cast(Words8::Vector, __builtin_bit_cast(Mask8::Vector, w.v) >> n));
}

inline float lane(float a, int) { return a; }
inline float lane(Lanes8 a, int i) { return a.v[i]; }
inline bool lane(bool m, int) { return m; }
inline bool lane(Mask8 m, int i) { return m.v[i] != 0; }
inline std::uint32_t lane(std::uint32_t w, int) { return w; }
inline std::uint32_t lane(Words8 w, int i) { return w.v[i]; }
inline void set_lane(float& a, int, float x) { a = x; }
inline void set_lane(Lanes8& a, int i, float x) { a.v[i] = x; }
inline void set_lane(std::uint32_t& a, int, std::uint32_t x) { a = x; }
inline void set_lane(Words8& a, int i, std::uint32_t x) { a.v[i] = x; }

}  // namespace COSYS_ISA
}  // namespace dsp

#ifdef __AVX512F__
#include "dsp/lanes16.hpp"
#endif
