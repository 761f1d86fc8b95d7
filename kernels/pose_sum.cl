/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Sums the pose gradients of POSE_CHUNK Gaussians in order, one item per chunk. */
kernel void sum_pose_terms(int n, global const float* restrict pose_terms, global float* restrict sums) {
  const int chunk = get_global_id(0);
  const int begin = chunk * POSE_CHUNK, end = min(n, begin + POSE_CHUNK);
  if (begin >= n) return;
  float sum[6] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
  for (int g = begin; g < end; ++g) {
    for (int i = 0; i < 6; ++i) sum[i] += pose_terms[6 * g + i];
  }
  for (int i = 0; i < 6; ++i) sums[6 * chunk + i] = sum[i];
}
