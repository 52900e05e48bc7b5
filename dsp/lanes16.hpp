#pragma once
// Sixteen trials in the lanes of one AVX-512 vector: for kernels built for x86-64-v4 alone, the
// operations of dsp/lanes.hpp, which includes this, and their bits.
#include <immintrin.h>

#include <cstdint>

namespace dsp {
inline namespace COSYS_ISA {

struct Lanes16 {
  __m512 v;
  Lanes16() = default;
  Lanes16(float all) : v(_mm512_set1_ps(all)) {}
  explicit Lanes16(__m512 value) : v(value) {}
  friend Lanes16 operator+(Lanes16 a, Lanes16 b) { return Lanes16(a.v + b.v); }
  friend Lanes16 operator-(Lanes16 a, Lanes16 b) { return Lanes16(a.v - b.v); }
  friend Lanes16 operator*(Lanes16 a, Lanes16 b) { return Lanes16(a.v * b.v); }
  friend Lanes16 operator/(Lanes16 a, Lanes16 b) { return Lanes16(a.v / b.v); }
  friend Lanes16 operator-(Lanes16 a) { return Lanes16(-a.v); }
};

struct Words16 {
  using Vector [[gnu::vector_size(64)]] = std::uint32_t;
  Vector v;
  Words16() = default;
  Words16(std::uint32_t all) : v(Vector{} + all) {}
  explicit Words16(Vector value) : v(value) {}
  explicit Words16(__m512i value) : v(__builtin_bit_cast(Vector, value)) {}
  __m512i raw() const { return __builtin_bit_cast(__m512i, v); }
  friend Words16 operator+(Words16 a, Words16 b) { return Words16(a.v + b.v); }
  friend Words16 operator-(Words16 a, Words16 b) { return Words16(a.v - b.v); }
  friend Words16 operator^(Words16 a, Words16 b) { return Words16(a.v ^ b.v); }
  friend Words16 operator|(Words16 a, Words16 b) { return Words16(a.v | b.v); }
  friend Words16 operator&(Words16 a, Words16 b) { return Words16(a.v & b.v); }
  friend Words16 operator<<(Words16 a, int n) { return Words16(a.v << n); }
  friend Words16 operator>>(Words16 a, int n) { return Words16(a.v >> n); }
};

struct Mask16 {  // a bit a lane, as the processor keeps them
  __mmask16 v;
  Mask16() = default;
  Mask16(bool all) : v(static_cast<__mmask16>(all ? 0xffff : 0)) {}
  explicit Mask16(__mmask16 value) : v(value) {}
  friend Mask16 operator&(Mask16 a, Mask16 b) { return Mask16(_kand_mask16(a.v, b.v)); }
  friend Mask16 operator|(Mask16 a, Mask16 b) { return Mask16(_kor_mask16(a.v, b.v)); }
  friend Mask16 operator^(Mask16 a, Mask16 b) { return Mask16(_kxor_mask16(a.v, b.v)); }
  friend Mask16 operator!(Mask16 a) { return Mask16(_knot_mask16(a.v)); }
};

inline Mask16 operator<(Lanes16 a, Lanes16 b) {
  return Mask16(_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ));
}
inline Mask16 operator>(Lanes16 a, Lanes16 b) {
  return Mask16(_mm512_cmp_ps_mask(a.v, b.v, _CMP_GT_OQ));
}
inline Mask16 operator<=(Lanes16 a, Lanes16 b) {
  return Mask16(_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ));
}
inline Mask16 operator>=(Lanes16 a, Lanes16 b) {
  return Mask16(_mm512_cmp_ps_mask(a.v, b.v, _CMP_GE_OQ));
}

template <>
struct LaneTraits<Lanes16> {
  static constexpr int width = 16;
  using Mask = Mask16;
  using Words = Words16;
  using Bits = std::uint16_t;
};

inline Lanes16 choose(Mask16 m, Lanes16 a, Lanes16 b) {
  return Lanes16(_mm512_mask_blend_ps(m.v, b.v, a.v));
}
inline Words16 kept(Mask16 m, Words16 w) { return Words16(_mm512_maskz_mov_epi32(m.v, w.raw())); }

inline Mask16 exceeds(Words16 a, Words16 b) {
  return Mask16(_mm512_cmpgt_epi32_mask(a.raw(), b.raw()));
}
inline Words16 larger_signed(Words16 a, Words16 b) {
  return Words16(_mm512_max_epi32(a.raw(), b.raw()));
}
inline Words16 smaller_signed(Words16 a, Words16 b) {
  return Words16(_mm512_min_epi32(a.raw(), b.raw()));
}

inline std::uint32_t bits(Mask16 m) { return m.v; }

inline Lanes16 larger(Lanes16 a, Lanes16 b) { return Lanes16(_mm512_max_ps(a.v, b.v)); }
inline Lanes16 smaller(Lanes16 a, Lanes16 b) { return Lanes16(_mm512_min_ps(a.v, b.v)); }

inline Lanes16 fused(Lanes16 a, Lanes16 b, Lanes16 c) {
  return Lanes16(_mm512_fmadd_ps(a.v, b.v, c.v));
}
inline Lanes16 square_root(Lanes16 a) { return Lanes16(_mm512_sqrt_ps(a.v)); }

inline Lanes16 from_bits(Words16 w) { return Lanes16(__builtin_bit_cast(__m512, w.v)); }
inline Words16 to_bits(Lanes16 a) { return Words16(__builtin_bit_cast(Words16::Vector, a.v)); }
inline Lanes16 to_float(Words16 w) { return Lanes16(_mm512_cvtepi32_ps(w.raw())); }
inline Words16 arithmetic_shift(Words16 w, int n) {
  return Words16(_mm512_srai_epi32(w.raw(), static_cast<unsigned>(n)));
}

inline float lane(Lanes16 a, int i) { return a.v[i]; }
inline void set_lane(Lanes16& a, int i, float x) { a.v[i] = x; }
inline void set_lane(Words16& a, int i, std::uint32_t x) { a.v[i] = x; }

}  // namespace COSYS_ISA
}  // namespace dsp
