/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors

   Regularisation that keeps discs on the surface they were made from, one item per Gaussian; adds to the gradients of
   the image terms.
   anchors [N x 8]: a point of the surface, 1 / size^2 there, the unit normal, 0 (no anchor: all 0).
     place_weight   * (normal . (position - point))^2 / size^2
     normal_weight  * (1 - (normal . axis)^2), axis: the Gaussian's third axis
     flatten_weight * exp(log_scale_2 - (log_scale_0 + log_scale_1) / 2), thickness / size */
__kernel void surface_terms(int n, const __global float* restrict positions, const __global float* restrict log_scales,
                            const __global float* restrict rotations, const __global float* restrict anchors,
                            float place_weight, float normal_weight, float flatten_weight,
                            __global float* restrict position_gradients, __global float* restrict log_scale_gradients,
                            __global float* restrict rotation_gradients) {
  const int g = get_global_id(0);
  if (g >= n) return;
  const float4 point = vload4(2 * g, anchors);
  const float3 normal = vload4(2 * g + 1, anchors).xyz;
  const float height = dot(normal, vload3(g, positions) - point.xyz);
  vstore3(vload3(g, position_gradients) + (2.0f * place_weight * point.w * height) * normal, g, position_gradients);

  const float4 raw = vload4(g, rotations);
  const float inverse_norm = rsqrt(dot(raw, raw));
  const float4 q = raw * inverse_norm; /* w x y z */
  const float w = q.x, x = q.y, y = q.z, z = q.w;
  const float3 axis = (float3)(2.0f * (x * z + w * y), 2.0f * (y * z - w * x), 1.0f - 2.0f * (x * x + y * y));
  const float3 d = (-2.0f * normal_weight * dot(normal, axis)) * normal;
  const float4 d_q = 2.0f * (float4)(d.x * y - d.y * x, d.x * z - d.y * w - 2.0f * d.z * x,
                                     d.x * w + d.y * z - 2.0f * d.z * y, d.x * x + d.y * y);
  vstore4(vload4(g, rotation_gradients) + (d_q - dot(d_q, q) * q) * inverse_norm, g, rotation_gradients);

  const float3 log_scale = vload3(g, log_scales);
  const float thick = flatten_weight * exp(log_scale.z - 0.5f * (log_scale.x + log_scale.y));
  vstore3(vload3(g, log_scale_gradients) + (float3)(-0.5f * thick, -0.5f * thick, thick), g, log_scale_gradients);
}
