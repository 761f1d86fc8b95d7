// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Operations on eight floats at a time. Included only by files that are compiled for AVX2 and FMA.
#pragma once

#include <immintrin.h>

namespace odosplat::yard {

using f8 = __m256;
using i8 = __m256i;

inline f8 set(float v) { return _mm256_set1_ps(v); }
inline i8 set(int v) { return _mm256_set1_epi32(v); }
inline f8 add(f8 a, f8 b) { return _mm256_add_ps(a, b); }
inline f8 sub(f8 a, f8 b) { return _mm256_sub_ps(a, b); }
inline f8 mul(f8 a, f8 b) { return _mm256_mul_ps(a, b); }
inline f8 div(f8 a, f8 b) { return _mm256_div_ps(a, b); }
inline f8 least(f8 a, f8 b) { return _mm256_min_ps(a, b); }
inline f8 most(f8 a, f8 b) { return _mm256_max_ps(a, b); }
inline f8 root(f8 a) { return _mm256_sqrt_ps(a); }
inline f8 magnitude(f8 a) { return _mm256_andnot_ps(set(-0.0F), a); }
inline f8 fma(f8 a, f8 b, f8 c) { return _mm256_fmadd_ps(a, b, c); }
inline f8 fnma(f8 a, f8 b, f8 c) { return _mm256_fnmadd_ps(a, b, c); }  // c - a b
inline f8 fms(f8 a, f8 b, f8 c) { return _mm256_fmsub_ps(a, b, c); }    // a b - c
inline f8 both(f8 a, f8 b) { return _mm256_and_ps(a, b); }
inline f8 at_least(f8 a, f8 b) { return _mm256_cmp_ps(a, b, _CMP_GE_OQ); }
inline f8 below(f8 a, f8 b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
inline int bits(f8 mask) { return _mm256_movemask_ps(mask); }

/// 2^x for -16 < x < 16 with the polynomial of raster_common.cl.
inline f8 exp2_short(f8 x) {
  const f8 magic = set(12582912.0F);
  const f8 z = add(x, magic);
  const f8 f = sub(x, sub(z, magic));
  f8 p = fma(set(0.0095701017F), f, set(0.0559178603F));
  p = fma(p, f, set(0.240247448F));
  p = fma(p, f, set(0.693121815F));
  p = fma(p, f, set(0.999999261F));
  const i8 shifted = _mm256_slli_epi32(_mm256_castps_si256(z), 23);
  return _mm256_castsi256_ps(_mm256_add_epi32(_mm256_castps_si256(p), shifted));
}

/// 2^x for |x| < 126 with a relative error of 2e-7.
inline f8 exp2_long(f8 x) {
  const f8 magic = set(12582912.0F);
  const f8 z = add(x, magic);
  const f8 f = sub(x, sub(z, magic));
  f8 p = fma(set(0.00132764718F), f, set(0.00967554133F));
  p = fma(p, f, set(0.0555071327F));
  p = fma(p, f, set(0.240221197F));
  p = fma(p, f, set(0.693146967F));
  p = fma(p, f, set(1.00000007F));
  const i8 shifted = _mm256_slli_epi32(_mm256_castps_si256(z), 23);
  return _mm256_castsi256_ps(_mm256_add_epi32(_mm256_castps_si256(p), shifted));
}

/// log2 of positive normal x: the exponent plus the artanh series of (m - 1) / (m + 1), m in [sqrt 1/2, sqrt 2).
inline f8 log2_of(f8 x) {
  const i8 raw = _mm256_castps_si256(x);
  const i8 exponent = _mm256_srai_epi32(_mm256_sub_epi32(raw, set(0x3f3504f3)), 23);
  const f8 m = _mm256_castsi256_ps(_mm256_sub_epi32(raw, _mm256_slli_epi32(exponent, 23)));
  const f8 s = div(sub(m, set(1.0F)), add(m, set(1.0F)));
  const f8 s2 = mul(s, s);
  f8 p = fma(set(0.32059890F), s2, set(0.41219858F));
  p = fma(p, s2, set(0.57707802F));
  p = fma(p, s2, set(0.96179669F));
  p = fma(p, s2, set(2.88539008F));
  return fma(p, s, _mm256_cvtepi32_ps(exponent));
}

inline f8 gather(const float* base, i8 index) { return _mm256_i32gather_ps(base, index, 4); }

struct V3 {
  f8 x, y, z;
};
inline f8 dot(const V3& a, const V3& b) { return fma(a.x, b.x, fma(a.y, b.y, mul(a.z, b.z))); }
inline V3 cross(const V3& a, const V3& b) {
  return {fms(a.y, b.z, mul(a.z, b.y)), fms(a.z, b.x, mul(a.x, b.z)), fms(a.x, b.y, mul(a.y, b.x))};
}
inline V3 times(const V3& a, const V3& b) { return {mul(a.x, b.x), mul(a.y, b.y), mul(a.z, b.z)}; }
/// k (a - t b)
inline V3 scaled_difference(f8 k, const V3& a, f8 t, const V3& b) {
  return {mul(k, fnma(t, b.x, a.x)), mul(k, fnma(t, b.y, a.y)), mul(k, fnma(t, b.z, a.z))};
}

}  // namespace odosplat::yard
