/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors

   Statistics for densification, summed over training steps, one item per Gaussian: the norm of the loss gradient by its
   projected centre (pulls), and the number of steps in which it was drawn (seen). scale: half the longer side of the
   image, converts 1/px to normalised units. */
__kernel void screen_statistics(int n, const __global uint* restrict counts,
                                const __global float* restrict screen_gradients, float scale,
                                __global float* restrict pulls, __global float* restrict seen) {
  const int g = get_global_id(0);
  if (g >= n || counts[g] == 0) return;
  const float2 slope = vload2(g, screen_gradients);
  pulls[g] += scale * sqrt(dot(slope, slope));
  seen[g] += 1.0f;
}
