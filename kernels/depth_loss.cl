/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors

   The depth term of the trainer and its gradient, one item per row of the image (so the order of sums is fixed).
   With r = (rendered - target) / target where both have depth: rho(r) = min(sqrt(r^2 + DEPTH_KNEE^2), cut) times the
   pixel's weight. Beyond `cut` the target is taken to be another surface, and the gradient is 0.
   rendered, target [height x width] m, weight [height x width] 0..1 -> gradient [height x width], the derivative of
   scale * sum(weight rho); rows [2 x height]: sums of weight rho and of weight. */
#define DEPTH_KNEE 1.0e-3f

inline float8 depth_pixels(const __global float* restrict row, int x, int width) {
  if (x + 8 <= width) return vload8(0, row + x);
  float v[8];
  for (int i = 0; i < 8; ++i) v[i] = x + i < width ? row[x + i] : 0.0f;
  return vload8(0, v);
}

__kernel void depth_loss(const __global float* restrict rendered, const __global float* restrict target,
                         const __global float* restrict weight, __global float* restrict gradient,
                         __global float* restrict rows, int width, int height, float scale, float cut) {
  const int y = (int)get_global_id(0);
  if (y >= height) return;
  const int begin = y * width;
  float8 sum = (float8)(0.0f), weights = (float8)(0.0f);
  for (int x = 0; x < width; x += 8) {
    const float8 d = depth_pixels(rendered + begin, x, width);
    const float8 t = depth_pixels(target + begin, x, width);
    const int8 both = (d > 0.0f) & (t > 0.0f); /* lanes beyond the row are 0 */
    const float8 w = as_float8(as_int8(depth_pixels(weight + begin, x, width)) & both);
    const float8 inverse = 1.0f / fmax(t, (float8)(1.0e-6f));
    const float8 r = (d - t) * inverse;
    const float8 s = sqrt(r * r + DEPTH_KNEE * DEPTH_KNEE);
    const float8 slope = as_float8(as_int8(scale * w * r * inverse / s) & (both & (s < cut)));
    sum += w * fmin(s, (float8)(cut));
    weights += w;
    if (x + 8 <= width) {
      vstore8(slope, 0, gradient + begin + x);
    } else {
      float v[8];
      vstore8(slope, 0, v);
      /* The constant length lets the compiler keep v in registers. */
      for (int i = 0; i < 8; ++i)
        if (x + i < width) gradient[begin + x + i] = v[i];
    }
  }
  const float4 s4 = sum.lo + sum.hi, w4 = weights.lo + weights.hi;
  const float2 s2 = s4.lo + s4.hi, w2 = w4.lo + w4.hi;
  rows[y] = s2.x + s2.y;
  rows[height + y] = w2.x + w2.y;
}
