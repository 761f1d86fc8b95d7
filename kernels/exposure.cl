/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors

   Exposure of an image: channel c of the rendered image becomes gain_c * value + offset_c (settings: gains,
   offsets). */
__kernel void expose(int pixels, const __global float* restrict rendered, float8 settings, __global float* restrict exposed) {
  const int i = get_global_id(0);
  if (i >= pixels) return;
  exposed[i] = settings.s0 * rendered[i] + settings.s3;
  exposed[pixels + i] = settings.s1 * rendered[pixels + i] + settings.s4;
  exposed[2 * pixels + i] = settings.s2 * rendered[2 * pixels + i] + settings.s5;
}

/* For one channel and its gain: turns the gradient [3 x height x width] with respect to the exposed image into that
   with respect to the rendered image, in place. rows [2 x 3 x height]: sums over a row of the derivatives by gain and
   by offset. One item per row. */
__kernel void expose_backward(int width, int height, int channel, float gain, const __global float* restrict rendered,
                              __global float* restrict gradient, __global float* restrict rows) {
  const int y = get_global_id(0);
  if (y >= height) return;
  const int row = channel * height + y;
  float by_gain = 0.0f, by_offset = 0.0f;
  for (int x = 0; x < width; ++x) {
    const int i = row * width + x;
    const float g = gradient[i];
    by_gain += g * rendered[i];
    by_offset += g;
    gradient[i] = gain * g;
  }
  rows[row] = by_gain;
  rows[3 * height + row] = by_offset;
}
