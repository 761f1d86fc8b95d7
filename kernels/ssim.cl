/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors

   Structural similarity of two images (Wang, Bovik, Sheikh, Simoncelli 2004) with an 11 x 11 Gaussian window of
   sigma 1.5, centred on the pixel, and its gradient. The window is separable: each kernel is one direction.
   At the border the window is cut and its weights are scaled to sum to one (the image is not padded with black).

   Images are planar [3 x height x width]. Maps between passes are padded: rows of `stride` floats with PAD zeros on the
   left and at least PAD on the right, so that the horizontal pass needs no bounds check. A work-item computes 8 pixels
   of a row.
   Range: (blocks * height, 3) with blocks = ceil(width / 8). */

#define RADIUS 5
#define PAD 8
/* exp(-k^2 / (2 * 1.5^2)), not normalised: every mean is divided by the sum of the weights in the image. */
__constant float WINDOW[2 * RADIUS + 1] = {0.00386592014f, 0.0285655007f, 0.135335283f, 0.411112291f,
                                           0.800737403f,   1.0f,          0.800737403f, 0.411112291f,
                                           0.135335283f,   0.0285655007f, 0.00386592014f};
/* (0.01 L)^2 and (0.03 L)^2 with the range L = 1. */
#define C1 1.0e-4f
#define C2 9.0e-4f

/* 8 pixels from x on; those beyond the row are 0. */
static inline float8 load_pixels(const __global float* restrict row, int x, int width) {
  if (x + 8 <= width) return vload8(0, row + x);
  float v[8];
  for (int i = 0; i < 8; ++i) v[i] = x + i < width ? row[x + i] : 0.0f;
  return vload8(0, v);
}

static inline void store_pixels(__global float* restrict row, int x, int width, float8 value) {
  if (x + 8 <= width) {
    vstore8(value, 0, row + x);
    return;
  }
  float v[8];
  vstore8(value, 0, v);
  for (int i = 0; i < 8; ++i)
    if (x + i < width) row[x + i] = v[i];
}

/* 1 where x + lane is inside the row, else 0. */
static inline float8 inside(int x, int width) {
  const int8 column = (int8)(0, 1, 2, 3, 4, 5, 6, 7) + x;
  return select((float8)(0.0f), (float8)(1.0f), (column >= 0) & (column < width));
}

/* Sum of the window's weights that fall into the image, along one axis. */
static inline float8 weight_along_row(int x, int width) {
  float8 sum = (float8)(0.0f);
  for (int k = -RADIUS; k <= RADIUS; ++k) sum += WINDOW[k + RADIUS] * inside(x + k, width);
  return fmax(sum, (float8)(1.0e-6f)); /* the sum may be 0 for lanes beyond the row */
}

static inline float weight_along_column(int y, int height) {
  float sum = 0.0f;
  for (int k = -RADIUS; k <= RADIUS; ++k)
    if (y + k >= 0 && y + k < height) sum += WINDOW[k + RADIUS];
  return sum;
}

static inline float sum_lanes(float8 v) {
  const float4 a = v.lo + v.hi;
  const float2 b = a.lo + a.hi;
  return b.x + b.y;
}

/* rendered, target [3 x height x width] -> moments [5 x 3 x height x stride]: column means of x, y, x^2, y^2, x y. */
__kernel void ssim_moments_vertical(const __global float* restrict rendered, const __global float* restrict target,
                                    __global float* restrict moments, int width, int height, int stride) {
  const int blocks = (width + 7) / 8;
  const int item = (int)get_global_id(0);
  const int channel = (int)get_global_id(1);
  if (item >= blocks * height || channel >= 3) return;
  const int y = item / blocks;
  const int x = (item - y * blocks) * 8;
  float8 sx = (float8)(0.0f), sy = sx, sxx = sx, syy = sx, sxy = sx;
  for (int k = -RADIUS; k <= RADIUS; ++k) {
    if (y + k < 0 || y + k >= height) continue;
    const int row = (channel * height + y + k) * width;
    const float8 a = load_pixels(rendered + row, x, width);
    const float8 b = load_pixels(target + row, x, width);
    const float8 wa = a * WINDOW[k + RADIUS];
    const float8 wb = b * WINDOW[k + RADIUS];
    sx += wa;
    sy += wb;
    sxx += wa * a;
    syy += wb * b;
    sxy += wa * b;
  }
  const float scale = 1.0f / weight_along_column(y, height);
  const int map = 3 * height * stride;
  __global float* out = moments + (channel * height + y) * stride + PAD + x;
  vstore8(sx * scale, 0, out);
  vstore8(sy * scale, 0, out + map);
  vstore8(sxx * scale, 0, out + 2 * map);
  vstore8(syy * scale, 0, out + 3 * map);
  vstore8(sxy * scale, 0, out + 4 * map);
}

/* moments -> values [3 x height x blocks]: sums of SSIM over 8 pixels; partials [3 x 3 x height x stride]: derivatives
   of SSIM by the means of x, x^2 and x y, each divided by the pixel's sum of weights, as input of the transposed
   window. */
__kernel void ssim_horizontal(const __global float* restrict moments, __global float* restrict values,
                              __global float* restrict partials, int width, int height, int stride) {
  const int blocks = (width + 7) / 8;
  const int item = (int)get_global_id(0);
  const int channel = (int)get_global_id(1);
  if (item >= blocks * height || channel >= 3) return;
  const int y = item / blocks;
  const int x = (item - y * blocks) * 8;
  const int map = 3 * height * stride;
  const __global float* in = moments + (channel * height + y) * stride + PAD + x;
  float8 mx = (float8)(0.0f), my = mx, exx = mx, eyy = mx, exy = mx;
  for (int k = -RADIUS; k <= RADIUS; ++k) {
    const float w = WINDOW[k + RADIUS];
    mx += w * vload8(0, in + k);
    my += w * vload8(0, in + map + k);
    exx += w * vload8(0, in + 2 * map + k);
    eyy += w * vload8(0, in + 3 * map + k);
    exy += w * vload8(0, in + 4 * map + k);
  }
  const float8 scale = 1.0f / weight_along_row(x, width);
  mx *= scale;
  my *= scale;
  exx *= scale;
  eyy *= scale;
  exy *= scale;
  const float8 a = 2.0f * mx * my + C1;
  const float8 b = 2.0f * (exy - mx * my) + C2;
  const float8 c = mx * mx + my * my + C1;
  const float8 d = (exx - mx * mx) + (eyy - my * my) + C2;
  const float8 inverse = 1.0f / (c * d);
  const float8 ssim = a * b * inverse;
  const float8 mask = inside(x, width);
  values[channel * height * blocks + item] = sum_lanes(ssim * mask);

  const float8 weight = mask * scale / weight_along_column(y, height);
  const float8 d_mean = 2.0f * ((b - a) * inverse * my + ssim * mx * (1.0f / d - 1.0f / c));
  __global float* out = partials + (channel * height + y) * stride + PAD + x;
  vstore8(weight * d_mean, 0, out);
  vstore8(-weight * ssim / d, 0, out + map);
  vstore8(weight * 2.0f * a * inverse, 0, out + 2 * map);
}

/* partials -> spread [3 x 3 x height x stride]: applies the transposed window along the columns. */
__kernel void ssim_spread_vertical(const __global float* restrict partials, __global float* restrict spread, int width,
                                   int height, int stride) {
  const int blocks = (width + 7) / 8;
  const int item = (int)get_global_id(0);
  const int channel = (int)get_global_id(1);
  if (item >= blocks * height || channel >= 3) return;
  const int y = item / blocks;
  const int x = (item - y * blocks) * 8;
  const int map = 3 * height * stride;
  float8 p = (float8)(0.0f), q = p, r = p;
  for (int k = -RADIUS; k <= RADIUS; ++k) {
    if (y + k < 0 || y + k >= height) continue;
    const __global float* in = partials + (channel * height + y + k) * stride + PAD + x;
    const float w = WINDOW[k + RADIUS];
    p += w * vload8(0, in);
    q += w * vload8(0, in + map);
    r += w * vload8(0, in + 2 * map);
  }
  __global float* out = spread + (channel * height + y) * stride + PAD + x;
  vstore8(p, 0, out);
  vstore8(q, 0, out + map);
  vstore8(r, 0, out + 2 * map);
}
