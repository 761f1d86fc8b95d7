/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   One item per Gaussian: propagates dL/dcolour to the SH coefficients, and through the viewing direction to position
   and pose. Runs after project_backward and adds to its results. */
kernel void shade_backward(int n, global const float* restrict positions, global const float* restrict sh, int stored,
                           float16 pose, global const uint* restrict counts,
                           global const float4* restrict splats, global const float4* restrict color_gradients,
                           global float* restrict position_gradients, global float* restrict sh_gradients, int with_pose,
                           global float* restrict pose_terms) {
  const int g = get_global_id(0);
  if (g >= n) return;
  global float* gradient = sh_gradients + (size_t)g * (size_t)(3 * stored);
  if (counts[g] == 0) {
    for (int k = 0; k < 3 * stored; ++k) gradient[k] = 0.0f;
    return;
  }
  const float3 ray = vload3(g, positions) - pose.scde;
  const float inverse_length = rsqrt(dot(ray, ray));
  const float3 direction = ray * inverse_length;
  const float3 color = splats[SPLAT_VECTORS * g + 3].xyz;
  const float3 given = color_gradients[g].xyz;
  const float3 d_color = (float3)(color.x > 0.0f ? given.x : 0.0f, color.y > 0.0f ? given.y : 0.0f,
                                  color.z > 0.0f ? given.z : 0.0f);
  float basis[SH_USED];
  float weight[SH_USED];
  sh_basis(direction, basis);
  global const float* coefficient = sh + (size_t)g * (size_t)(3 * stored);
#pragma unroll
  for (int k = 0; k < SH_USED; ++k) {
    weight[k] = dot(d_color, vload3(k, coefficient));
    vstore3(basis[k] * d_color, k, gradient);
  }
  for (int k = SH_USED; k < stored; ++k) vstore3((float3)(0.0f), k, gradient);
  const float3 slope = sh_slope(direction, weight);
  const float3 d_ray = (slope - dot(slope, direction) * direction) * inverse_length;
  vstore3(vload3(g, position_gradients) + d_ray, g, position_gradients);
  if (with_pose) {
    pose_terms[6 * g] += pose.s0 * d_ray.x + pose.s1 * d_ray.y + pose.s2 * d_ray.z;
    pose_terms[6 * g + 1] += pose.s3 * d_ray.x + pose.s4 * d_ray.y + pose.s5 * d_ray.z;
    pose_terms[6 * g + 2] += pose.s6 * d_ray.x + pose.s7 * d_ray.y + pose.s8 * d_ray.z;
  }
}
