/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors

   What densification needs to know, summed over steps, an item a Gaussian: how strongly the image pulls its projected
   centre, and how often it was in view. scale: half the longer side of the image, from 1/px to normalised units. */
__kernel void screen_statistics(int n, const __global uint* restrict counts,
                                const __global float* restrict screen_gradients, float scale,
                                __global float* restrict pulls, __global float* restrict seen) {
  const int g = get_global_id(0);
  if (g >= n || counts[g] == 0) return;
  const float2 slope = vload2(g, screen_gradients);
  pulls[g] += scale * sqrt(dot(slope, slope));
  seen[g] += 1.0f;
}
