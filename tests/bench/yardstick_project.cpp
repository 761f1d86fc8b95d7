// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#if defined(__AVX2__) && defined(__FMA__)

#include <algorithm>
#include <bit>

#include "tests/bench/yardstick_parts.hpp"
#include "tests/bench/yardstick_simd.hpp"

namespace odosplat::yard {
namespace {

constexpr float log2_e = 1.44269504F;
constexpr float half_log2_e = 0.72134752F;
constexpr float tile_test_margin = 1.0e-3F;

/// The ellipses of eight Gaussians for the tile test: fields as `boxes` of project.cl.
struct Boxes {
  f8 u, v, half_y, shear, w0, w1, tilt;
};

i8 ceil_int(f8 x) { return _mm256_cvttps_epi32(_mm256_ceil_ps(x)); }
i8 floor_int(f8 x) { return _mm256_cvttps_epi32(_mm256_floor_ps(x)); }
i8 tile_of(i8 pixel) {
  static_assert(TILE_WIDTH == 16 && TILE_HEIGHT == 16);
  return _mm256_srai_epi32(pixel, 4);
}

/// Appends the tiles of the drawn Gaussians (bits of `drawn`, lanes from `begin` on) to `part`.
void emit_tiles(const Boxes& b, int drawn, const View& view, std::size_t begin, std::uint32_t* first,
                std::uint32_t* count, Part& part) {
  const f8 right_edge = set(static_cast<float>(view.width)), bottom_edge = set(static_cast<float>(view.height));
  const i8 y0 = _mm256_max_epi32(ceil_int(most(sub(b.v, b.half_y), set(-1.0F))), set(0));
  const i8 y1 = _mm256_min_epi32(floor_int(least(add(b.v, b.half_y), bottom_edge)), set(view.height - 1));
  alignas(32) std::array<int, 8> row_begin, row_last;
  _mm256_store_si256(reinterpret_cast<i8*>(row_begin.data()), tile_of(y0));
  _mm256_store_si256(reinterpret_cast<i8*>(row_last.data()), tile_of(y1));
  const int empty = bits(_mm256_castsi256_ps(_mm256_cmpgt_epi32(y0, y1)));
  int rows = 0;
  for (int lane = 0; lane < 8; ++lane) {
    const bool alive = ((drawn & ~empty) >> lane & 1) != 0;
    if (!alive) row_last[static_cast<std::size_t>(lane)] = row_begin[static_cast<std::size_t>(lane)] - 1;
    rows = std::max(rows, row_last[static_cast<std::size_t>(lane)] - row_begin[static_cast<std::size_t>(lane)] + 1);
  }
  thread_local std::vector<std::array<int, 8>> lefts, rights;
  if (lefts.size() < static_cast<std::size_t>(rows)) {
    lefts.resize(static_cast<std::size_t>(rows));
    rights.resize(static_cast<std::size_t>(rows));
  }
  const i8 row0 = tile_of(y0);
  for (int k = 0; k < rows; ++k) {
    const i8 top = _mm256_slli_epi32(_mm256_add_epi32(row0, set(k)), 4);
    const i8 bottom = _mm256_min_epi32(_mm256_add_epi32(top, set(15)), set(view.height - 1));
    const f8 low = sub(_mm256_cvtepi32_ps(top), b.v), high = sub(_mm256_cvtepi32_ps(bottom), b.v);
    const f8 right_y = least(most(b.tilt, low), high);
    const f8 left_y = least(most(sub(set(0.0F), b.tilt), low), high);
    const f8 right = add(b.u, fma(b.shear, right_y, root(most(fnma(b.w1, mul(right_y, right_y), b.w0), set(0.0F)))));
    const f8 left = add(b.u, sub(mul(b.shear, left_y), root(most(fnma(b.w1, mul(left_y, left_y), b.w0), set(0.0F)))));
    const i8 x0 = _mm256_max_epi32(ceil_int(most(left, set(-1.0F))), set(0));
    const i8 x1 = _mm256_min_epi32(floor_int(least(right, right_edge)), set(view.width - 1));
    const i8 none = _mm256_cmpgt_epi32(x0, x1);
    const auto at = static_cast<std::size_t>(k);
    _mm256_storeu_si256(reinterpret_cast<i8*>(lefts[at].data()), tile_of(x0));
    _mm256_storeu_si256(reinterpret_cast<i8*>(rights[at].data()), _mm256_blendv_epi8(tile_of(x1), set(-1), none));
  }
  for (std::size_t lane = 0; lane < 8; ++lane) {
    const std::size_t before = part.tiles.size();
    const int used = row_last[lane] - row_begin[lane] + 1;
    for (int k = 0; k < used; ++k) {
      const int row = (row_begin[lane] + k) * view.columns;
      for (int x = lefts[static_cast<std::size_t>(k)][lane]; x <= rights[static_cast<std::size_t>(k)][lane]; ++x)
        part.tiles.push_back(static_cast<std::uint32_t>(row + x));
    }
    first[begin + lane] = static_cast<std::uint32_t>(before);
    count[begin + lane] = static_cast<std::uint32_t>(part.tiles.size() - before);
  }
}

V3 rotated(const std::array<float, 12>& pose, std::size_t row, const V3& a, const V3& b, const V3& c) {
  const f8 r0 = set(pose[3 * row]), r1 = set(pose[3 * row + 1]), r2 = set(pose[3 * row + 2]);
  return {fma(r0, a.x, fma(r1, b.x, mul(r2, c.x))), fma(r0, a.y, fma(r1, b.y, mul(r2, c.y))),
          fma(r0, a.z, fma(r1, b.z, mul(r2, c.z)))};
}

}  // namespace

// The same steps as project_one, depth_slope and project of the kernels.
void project_part(const Gaussians& gaussians, const View& view, std::size_t begin, std::size_t end, Splat* splats,
                  std::uint32_t* keys, std::uint32_t* first, std::uint32_t* count, Part& part) {
  part.tiles.clear();
  const i8 lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const auto& pose = view.pose;
  const f8 one = set(1.0F), two = set(2.0F), dilation = set(DILATION), plane = set(PLANE_DILATION);
  for (std::size_t g = begin; g < end; g += 8) {
    const i8 index = _mm256_min_epi32(_mm256_add_epi32(set(static_cast<int>(g)), lane), set(static_cast<int>(end) - 1));
    const i8 by3 = _mm256_add_epi32(index, _mm256_add_epi32(index, index)), by4 = _mm256_slli_epi32(index, 2);
    const float* position = gaussians.positions.data();
    const float* log_scale = gaussians.log_scales.data();
    const float* rotation = gaussians.rotations.data();
    const V3 world{gather(position, by3), gather(position + 1, by3), gather(position + 2, by3)};
    const V3 size{exp2_long(mul(set(log2_e), gather(log_scale, by3))),
                  exp2_long(mul(set(log2_e), gather(log_scale + 1, by3))),
                  exp2_long(mul(set(log2_e), gather(log_scale + 2, by3)))};
    f8 w = gather(rotation, by4), x = gather(rotation + 1, by4), y = gather(rotation + 2, by4),
       z = gather(rotation + 3, by4);
    const f8 unit = div(one, root(fma(w, w, fma(x, x, fma(y, y, mul(z, z))))));
    w = mul(w, unit), x = mul(x, unit), y = mul(y, unit), z = mul(z, unit);
    const auto coordinate = [&](std::size_t row) {
      return fma(set(pose[3 * row]), world.x,
                 fma(set(pose[3 * row + 1]), world.y, fma(set(pose[3 * row + 2]), world.z, set(pose[9 + row]))));
    };
    const f8 px = coordinate(0), py = coordinate(1), pz = coordinate(2);
    const V3 R0{fnma(two, fma(y, y, mul(z, z)), one), mul(two, fms(x, y, mul(w, z))), mul(two, fma(x, z, mul(w, y)))};
    const V3 R1{mul(two, fma(x, y, mul(w, z))), fnma(two, fma(x, x, mul(z, z)), one), mul(two, fms(y, z, mul(w, x)))};
    const V3 R2{mul(two, fms(x, z, mul(w, y))), mul(two, fma(y, z, mul(w, x))), fnma(two, fma(x, x, mul(y, y)), one)};
    const V3 M0 = times(rotated(pose, 0, R0, R1, R2), size), M1 = times(rotated(pose, 1, R0, R1, R2), size),
             M2 = times(rotated(pose, 2, R0, R1, R2), size);
    const f8 inverse_z = div(one, pz), hx = mul(px, inverse_z), hy = mul(py, inverse_z);
    const f8 u = fma(set(view.lens[0]), hx, set(view.lens[2])), v = fma(set(view.lens[1]), hy, set(view.lens[3]));
    const f8 tx = least(most(hx, set(view.lens[4])), set(view.lens[5]));
    const f8 ty = least(most(hy, set(view.lens[6])), set(view.lens[7]));
    const V3 r0 = scaled_difference(mul(set(view.lens[0]), inverse_z), M0, tx, M2);
    const V3 r1 = scaled_difference(mul(set(view.lens[1]), inverse_z), M1, ty, M2);
    const V3 n = cross(r0, r1);
    const f8 a = dot(r0, r0), b = dot(r0, r1), c = dot(r1, r1), det0 = dot(n, n);
    const f8 det = add(det0, fma(dilation, add(a, c), set(DILATION * DILATION)));
    const f8 logit = mul(set(-log2_e), _mm256_i32gather_ps(gaussians.opacity_logits.data(), index, 4));
    const f8 l2 = sub(set(0.0F), log2_of(add(one, exp2_long(logit))));
    const f8 tested = add(sub(l2, set(LOG2_MIN_ALPHA)), set(tile_test_margin));
    const f8 scale = div(set(half_log2_e), det);
    const f8 ad = add(a, dilation), cd = add(c, dilation);
    const f8 A = mul(scale, cd), B = mul(set(-2.0F), mul(scale, b)), C = mul(scale, ad);
    const f8 reach = mul(tested, set(1.0F / half_log2_e));
    const f8 half_x = root(mul(reach, ad)), half_y = root(mul(reach, cd));
    const f8 inverse_A = div(one, A);
    const f8 plane_det = add(det0, fma(plane, add(a, c), set(PLANE_DILATION * PLANE_DILATION)));
    const f8 factor = div(one, mul(plane_det, pz));
    const f8 slope_u = mul(fma(plane, dot(r0, M2), dot(n, cross(M2, r1))), factor);
    const f8 slope_v = mul(fma(plane, dot(r1, M2), dot(n, cross(r0, M2))), factor);
    f8 ok = both(at_least(pz, set(NEAR_DEPTH)), at_least(l2, set(LOG2_MIN_ALPHA)));
    ok = both(ok, both(at_least(add(u, half_x), set(0.0F)),
                       at_least(set(static_cast<float>(view.width - 1)), sub(u, half_x))));
    ok = both(ok, both(at_least(add(v, half_y), set(0.0F)),
                       at_least(set(static_cast<float>(view.height - 1)), sub(v, half_y))));
    ok = both(ok, both(below(magnitude(u), set(1.0e7F)), below(magnitude(v), set(1.0e7F))));
    ok = both(ok, both(below(magnitude(slope_u), set(1.0e6F)), below(magnitude(slope_v), set(1.0e6F))));
    ok = both(ok, both(below(half_x, set(1.0e7F)), below(half_y, set(1.0e7F))));
    const std::size_t used = std::min<std::size_t>(8, end - g);
    const int drawn = bits(ok) & ((1 << used) - 1);

    alignas(32) std::array<std::array<float, 8>, 9> columns;
    const f8 values[9] = {u, v, A, B, C, l2, pz, slope_u, slope_v};
    for (std::size_t k = 0; k < 9; ++k) _mm256_store_ps(columns[k].data(), values[k]);
    for (std::size_t i = 0; i < used; ++i) {
      keys[g + i] = (drawn >> i & 1) != 0 ? std::bit_cast<std::uint32_t>(columns[6][i]) : 0xffffffffU;
      splats[g + i].value = {columns[0][i], columns[1][i], columns[2][i], columns[3][i], columns[4][i], columns[5][i],
                             columns[6][i], 0.0F,          columns[7][i], columns[8][i], 0.0F,          0.0F};
    }
    const f8 half_B = mul(set(-0.5F), B);
    emit_tiles({u, v, half_y, mul(half_B, inverse_A), mul(tested, inverse_A),
                mul(mul(set(half_log2_e), scale), mul(inverse_A, inverse_A)), mul(div(half_B, C), half_x)},
               drawn, view, g, first, count, part);
  }
}

}  // namespace odosplat::yard

#endif
