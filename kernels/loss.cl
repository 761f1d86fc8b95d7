/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors

   The image loss of the trainer and its gradient; compiled after ssim.cl in the same program.
   loss = color_weight * mean colour difference + ssim_weight * (1 - mean SSIM). */

/* Gradient of the loss with respect to the rendered image [3 x height x width]; applies the horizontal direction of
   ssim.cl's transposed window, the last one. values [3 x 3 x height x blocks]: after the SSIM sums of ssim_horizontal
   it writes the sums over 8 pixels of |difference| and of its square.
   color_scale = color_weight / n, ssim_scale = ssim_weight / n with n = 3 width height; squared != 0: L2, else L1. */
__kernel void loss_gradient(const __global float* restrict rendered, const __global float* restrict target,
                            const __global float* restrict spread, __global float* restrict gradient,
                            __global float* restrict values, int width, int height, int stride, float color_scale,
                            float ssim_scale, int squared) {
  const int blocks = (width + 7) / 8;
  const int item = (int)get_global_id(0);
  const int channel = (int)get_global_id(1);
  if (item >= blocks * height || channel >= 3) return;
  const int y = item / blocks;
  const int x = (item - y * blocks) * 8;
  const int map = 3 * height * stride;
  const __global float* in = spread + (channel * height + y) * stride + PAD + x;
  float8 p = (float8)(0.0f), q = p, r = p;
  for (int k = -RADIUS; k <= RADIUS; ++k) {
    const float w = WINDOW[k + RADIUS];
    p += w * vload8(0, in + k);
    q += w * vload8(0, in + map + k);
    r += w * vload8(0, in + 2 * map + k);
  }
  const int row = (channel * height + y) * width;
  const float8 a = load_pixels(rendered + row, x, width);
  const float8 b = load_pixels(target + row, x, width);
  const float8 difference = a - b; /* lanes beyond the row are 0 in both */
  const float8 slope = squared ? 2.0f * difference : sign(difference);
  const float8 d_ssim = p + 2.0f * a * q + b * r;
  store_pixels(gradient + row, x, width, color_scale * slope - ssim_scale * d_ssim);
  const int plane = 3 * height * blocks;
  values[plane + channel * height * blocks + item] = sum_lanes(fabs(difference));
  values[2 * plane + channel * height * blocks + item] = sum_lanes(difference * difference);
}

/* values [3 kinds x 3 x height x blocks] -> rows [3 kinds x height]: sums over channels and blocks, in that order. */
__kernel void loss_rows(const __global float* restrict values, __global float* restrict rows, int blocks, int height) {
  const int item = (int)get_global_id(0);
  if (item >= 3 * height) return;
  const int kind = item / height;
  const int y = item - kind * height;
  float sum = 0.0f;
  for (int channel = 0; channel < 3; ++channel) {
    const __global float* in = values + ((kind * 3 + channel) * height + y) * blocks;
    for (int b = 0; b < blocks; ++b) sum += in[b];
  }
  rows[item] = sum;
}
