/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   One item for GW Gaussians: computes their splats, their depths or distances as sort keys (~0: not drawn), the numbers
   of tiles they reach, and their ellipses for emit_pairs. Compiled after tiles.cl. selected: if `select`, the indices
   of the n Gaussians to project; all output is in their order. */

/* Half of log2(e): exp(-q / 2) = 2^(-HALF_LOG2_E q). */
#define HALF_LOG2_E 0.72134752f
/* The tile test enlarges the ellipses by this much in log2 alpha, so that no pixel is lost by rounding. */
#define TILE_TEST_MARGIN 1.0e-3f

kernel void project(int n, int select, global const uint* restrict selected, global const float* restrict positions,
                    global const float* restrict log_scales, global const float* restrict rotations,
                    global const float* restrict opacity_logits, float16 pose, float8 lens, int4 size, float dilation,
                    int compensated, int ray_plane, int by_distance, WANTED_ARGUMENTS, global float4* restrict splats,
                    global float* restrict boxes, global uint* restrict depth_keys, global uint* restrict counts) {
  const int item = get_global_id(0), first = item * GW;
  if (first >= n) return;
  const gI place = group_of(first, n), at = select ? gather_indices(selected, place) : place;
  const Projection s = project_one(gather_gV(positions, at), gather_gV(log_scales, at), gather_g(rotations, 4 * at),
                                   make_gV(gather_g(rotations, 4 * at + 1), gather_g(rotations, 4 * at + 2),
                                           gather_g(rotations, 4 * at + 3)),
                                   gather_g(opacity_logits, at), pose, lens, dilation);
  gF log2_opacity = log2(s.opacity);
  if (compensated) log2_opacity += 0.5f * log2(max(s.visibility, (gF)(COMPENSATION_FLOOR)));
  const gF level = log2_opacity - LOG2_MIN_ALPHA;
  const gF scale = HALF_LOG2_E / s.det;
  const gF A = scale * (s.c + dilation), B = -2.0f * scale * s.b, C = scale * (s.a + dilation);
  const gF tested = level + TILE_TEST_MARGIN;
  /* 4 A C - B^2 = 4 HALF_LOG2_E^2 / det */
  const gF half_x = sqrt(tested / HALF_LOG2_E * (s.a + dilation));
  const gF half_y = sqrt(tested / HALF_LOG2_E * (s.c + dilation));
  const gF inverse_A = 1.0f / A;
  const Slope slope = depth_slope(&s);
  /* Every comparison is false for NaN, so that such a Gaussian is not drawn. */
  const gI drawn = GMASK((s.p.z >= NEAR_DEPTH) & (s.p.z < 1.0e6f) & (level >= 0.0f) & (s.det > 0.0f) & (A > 0.0f) &
                         (C > 0.0f) & (half_x < 1.0e7f) & (half_y < 1.0e7f) & (inverse_A < 1.0e30f) &
                         (fabs(s.u) < 1.0e7f) & (fabs(s.v) < 1.0e7f) & (fabs(slope.u) < 1.0e6f) &
                         (fabs(slope.v) < 1.0e6f) & (s.u + half_x >= 0.0f) & (s.u - half_x <= (float)(size.x - 1)) &
                         (s.v + half_y >= 0.0f) & (s.v - half_y <= (float)(size.y - 1)));
  Ellipse box;
  box.u = s.u;
  box.v = s.v;
  box.half_x = half_x;
  box.half_y = half_y;
  box.shear = -0.5f * B * inverse_A;
  box.w0 = tested * inverse_A;
  box.w1 = HALF_LOG2_E * scale * inverse_A * inverse_A;
  box.tilt = -0.5f * B / C * half_x;
  store_ellipse(boxes, item, &box);
  float columns[11][GW];
  float near_to_far[GW];
  int is_drawn[GW];
  STORE_LANES(by_distance ? sqrt(s.p.x * s.p.x + s.p.y * s.p.y + s.p.z * s.p.z) : s.p.z, near_to_far);
  STORE_LANES(s.u, columns[0]);
  STORE_LANES(s.v, columns[1]);
  STORE_LANES(A, columns[2]);
  STORE_LANES(B, columns[3]);
  STORE_LANES(C, columns[4]);
  STORE_LANES(log2_opacity, columns[5]);
  STORE_LANES(s.p.z, columns[6]);
  STORE_LANES(ray_plane ? slope.u : (gF)(0.0f), columns[7]);
  STORE_LANES(ray_plane ? slope.v : (gF)(0.0f), columns[8]);
  STORE_LANES(half_y, columns[9]);
  STORE_LANES(ray_plane ? s.p.z * sqrt(slope.u * slope.u + slope.v * slope.v) : (gF)(0.0f), columns[10]);
  STORE_LANES(drawn, is_drawn);
  uint count[GW];
  count_tiles(&box, is_drawn, size, WANTED, count);
  const int lanes = min(GW, n - first);
  for (int i = 0; i < lanes; ++i) {
    const int g = first + i;
    depth_keys[g] = is_drawn[i] != 0 ? as_uint(near_to_far[i]) : 0xffffffffu;
    counts[g] = count[i];
    splats[SPLAT_VECTORS * g] = (float4)(columns[0][i], columns[1][i], columns[2][i], columns[3][i]);
    splats[SPLAT_VECTORS * g + 1] = (float4)(columns[4][i], columns[5][i], columns[6][i], columns[9][i]);
    splats[SPLAT_VECTORS * g + 2] = (float4)(columns[7][i], columns[8][i], columns[10][i], 0.0f);
  }
}
