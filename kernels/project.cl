/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   One item a Gaussian: its splat, its box for the tile test, its depth as a sort key (~0: not drawn). */

/* Half of log2(e): exp(-q / 2) = 2^(-HALF_LOG2_E q). */
#define HALF_LOG2_E 0.72134752f
/* The tile test takes ellipses this much larger in log2 alpha, so that rounding cannot lose a pixel. */
#define TILE_TEST_MARGIN 1.0e-3f

kernel void project(int n, global const float* restrict positions, global const float* restrict log_scales,
                    global const float* restrict rotations, global const float* restrict opacity_logits, float16 pose,
                    float8 lens, int4 size, float dilation, int compensated, int ray_plane,
                    global float4* restrict splats, global float8* restrict boxes, global uint* restrict depth_keys) {
  const int g = get_global_id(0);
  if (g >= n) return;
  const Projection s = project_one(vload3(g, positions), vload3(g, log_scales), vload4(g, rotations),
                                   opacity_logits[g], pose, lens, dilation);
  float log2_opacity = log2(s.opacity);
  if (compensated) log2_opacity += 0.5f * log2(max(s.visibility, COMPENSATION_FLOOR));
  const float level = log2_opacity - LOG2_MIN_ALPHA;
  const float scale = HALF_LOG2_E / s.det;
  const float A = scale * (s.c + dilation), B = -2.0f * scale * s.b, C = scale * (s.a + dilation);
  const float tested = level + TILE_TEST_MARGIN;
  /* 4 A C - B^2 = 4 HALF_LOG2_E^2 / det */
  const float half_x = sqrt(tested / HALF_LOG2_E * (s.a + dilation));
  const float half_y = sqrt(tested / HALF_LOG2_E * (s.c + dilation));
  const float inverse_A = 1.0f / A;
  const Slope slope = depth_slope(&s);
  /* Every comparison is false for NaN, so that such a Gaussian is not drawn. */
  const int drawn = s.p.z >= NEAR_DEPTH && s.p.z < 1.0e6f && level >= 0.0f && s.det > 0.0f && A > 0.0f && C > 0.0f &&
                    half_x < 1.0e7f && half_y < 1.0e7f && inverse_A < 1.0e30f && fabs(s.u) < 1.0e7f &&
                    fabs(s.v) < 1.0e7f && fabs(slope.u) < 1.0e6f && fabs(slope.v) < 1.0e6f &&
                    s.u + half_x >= 0.0f && s.u - half_x <= (float)(size.x - 1) && s.v + half_y >= 0.0f &&
                    s.v - half_y <= (float)(size.y - 1);
  depth_keys[g] = drawn ? as_uint(s.p.z) : 0xffffffffu;
  splats[SPLAT_VECTORS * g] = (float4)(s.u, s.v, A, B);
  splats[SPLAT_VECTORS * g + 1] = (float4)(C, log2_opacity, s.p.z, half_y);
  splats[SPLAT_VECTORS * g + 2] = ray_plane ? (float4)(slope.u, slope.v, 0.0f, 0.0f) : (float4)(0.0f);
  /* The ellipse's x at height y: shear y +- sqrt(w0 - w1 y^2); its rightmost point lies at y = tilt. */
  boxes[g] = (float8)(s.u, s.v, half_x, half_y, -0.5f * B * inverse_A, tested * inverse_A,
                      HALF_LOG2_E * scale * inverse_A * inverse_A, -0.5f * B / C * half_x);
}
