/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   One item a Gaussian: its pairs' sums in order, then the chain rule from the splat to what is trained and to the pose.
   Derivation: with K the conic and S = K^-1 the dilated covariance, dL/dS = -K dL/dK K; the rest follows the steps of
   project_one and depth_slope from the last to the first. */

kernel void project_backward(int n, global const float* restrict positions, global const float* restrict log_scales,
                             global const float* restrict rotations, global const float* restrict opacity_logits,
                             float16 pose, float8 lens, float dilation, int compensated, int ray_plane,
                             global const uint* restrict counts,
                             global const uint* restrict offsets, global const float* restrict slots,
                             global float* restrict position_gradients, global float* restrict log_scale_gradients,
                             global float* restrict rotation_gradients, global float* restrict opacity_gradients,
                             global float4* restrict color_gradients, global float* restrict screen_gradients,
                             int with_pose, global float* restrict pose_terms) {
  const int g = get_global_id(0);
  if (g >= n) return;
  const uint count = counts[g];
  if (count == 0) {
    vstore3((float3)(0.0f), g, position_gradients);
    vstore3((float3)(0.0f), g, log_scale_gradients);
    vstore4((float4)(0.0f), g, rotation_gradients);
    opacity_gradients[g] = 0.0f;
    vstore2((float2)(0.0f), g, screen_gradients);
    if (with_pose) {
      for (int i = 0; i < 6; ++i) pose_terms[6 * g + i] = 0.0f;
    }
    return;
  }
  float sum[SLOT_FLOATS];
  global const float* slot = slots + (size_t)offsets[g] * SLOT_FLOATS;
  for (int i = 0; i < SLOT_FLOATS; ++i) sum[i] = slot[i];
  for (uint k = 1; k < count; ++k) {
    slot += SLOT_FLOATS;
    for (int i = 0; i < SLOT_FLOATS; ++i) sum[i] += slot[i];
  }
#if WITH_COLOR
  color_gradients[g] = (float4)(sum[SLOT_COLOR], sum[SLOT_COLOR + 1], sum[SLOT_COLOR + 2], 0.0f);
#endif

  const float4 rotation = vload4(g, rotations);
  const Projection s = project_one(vload3(g, positions), vload3(g, log_scales), rotation.x, rotation.yzw,
                                   opacity_logits[g], pose, lens, dilation);
  const float inverse_z = 1.0f / s.p.z;
  const float inverse_det = 1.0f / s.det;
  const float K0 = (s.c + dilation) * inverse_det, K1 = -s.b * inverse_det, K2 = (s.a + dilation) * inverse_det;
  /* y = K d for an offset d: the moments of y give dL/dcovariance = 1/2 sum h y y^T. */
  float d_u = K0 * sum[1] + K1 * sum[2];
  float d_v = K1 * sum[1] + K2 * sum[2];
  const float Kxx0 = K0 * sum[3] + K1 * sum[4], Kxy0 = K0 * sum[4] + K1 * sum[5];
  const float Kxx1 = K1 * sum[3] + K2 * sum[4], Kxy1 = K1 * sum[4] + K2 * sum[5];
  float d_a = 0.5f * (Kxx0 * K0 + Kxy0 * K1);
  const float d_b = Kxx0 * K1 + Kxy0 * K2;
  float d_c = 0.5f * (Kxx1 * K1 + Kxy1 * K2);
  const float d_log_opacity = sum[0];
  float3 d_n = (float3)(0.0f), d_r0 = (float3)(0.0f), d_r1 = (float3)(0.0f), d_M2 = (float3)(0.0f);
  float d_z = 0.0f;

  if (compensated && s.visibility > COMPENSATION_FLOOR) {
    const float d_det = -0.5f * d_log_opacity * inverse_det;
    d_n += (d_log_opacity / s.det0 + 2.0f * d_det) * s.n;
    d_a += dilation * d_det;
    d_c += dilation * d_det;
  }
#if WITH_DEPTH
  d_z += sum[SLOT_DEPTH];
  if (ray_plane) {
    const Slope slope = depth_slope(&s);
    d_u -= slope.u * sum[SLOT_DEPTH + 1];
    d_v -= slope.v * sum[SLOT_DEPTH + 1];
    const float d_slope_u = sum[SLOT_DEPTH + 2], d_slope_v = sum[SLOT_DEPTH + 3];
    const float factor = 1.0f / (slope.det * s.p.z);
    const float d_nu = d_slope_u * factor, d_nv = d_slope_v * factor;
    const float through = d_slope_u * slope.u + d_slope_v * slope.v;
    const float d_det = -through / slope.det;
    d_z -= through * inverse_z;
    d_n += d_nu * cross(s.M2, s.r1) + d_nv * cross(s.r0, s.M2) + 2.0f * d_det * s.n;
    d_M2 += d_nu * cross(s.r1, s.n) + d_nv * cross(s.n, s.r0) + PLANE_DILATION * (d_nu * s.r0 + d_nv * s.r1);
    d_r0 += d_nv * cross(s.M2, s.n) + (PLANE_DILATION * d_nu) * s.M2;
    d_r1 += d_nu * cross(s.n, s.M2) + (PLANE_DILATION * d_nv) * s.M2;
    d_a += PLANE_DILATION * d_det;
    d_c += PLANE_DILATION * d_det;
  }
#endif
  d_r0 += cross(s.r1, d_n) + 2.0f * d_a * s.r0 + d_b * s.r1;
  d_r1 += cross(d_n, s.r0) + 2.0f * d_c * s.r1 + d_b * s.r0;
  const float zoom_x = lens.s0 * inverse_z, zoom_y = lens.s1 * inverse_z;
  const float3 d_M0 = zoom_x * d_r0, d_M1 = zoom_y * d_r1;
  d_M2 -= s.tx * d_M0 + s.ty * d_M1;
  d_z -= (dot(s.r0, d_r0) + dot(s.r1, d_r1)) * inverse_z;
  const float hx = s.p.x * inverse_z, hy = s.p.y * inverse_z;
  float d_hx = lens.s0 * d_u, d_hy = lens.s1 * d_v;
  if (hx >= lens.s4 && hx <= lens.s5) d_hx -= dot(s.M2, d_M0);
  if (hy >= lens.s6 && hy <= lens.s7) d_hy -= dot(s.M2, d_M1);
  const float3 d_p = (float3)(d_hx * inverse_z, d_hy * inverse_z, d_z - (d_hx * hx + d_hy * hy) * inverse_z);

  vstore3((float3)(pose.s0 * d_p.x + pose.s3 * d_p.y + pose.s6 * d_p.z,
                   pose.s1 * d_p.x + pose.s4 * d_p.y + pose.s7 * d_p.z,
                   pose.s2 * d_p.x + pose.s5 * d_p.y + pose.s8 * d_p.z),
          g, position_gradients);
  vstore3(s.M0 * d_M0 + s.M1 * d_M1 + s.M2 * d_M2, g, log_scale_gradients);
  opacity_gradients[g] = d_log_opacity * (1.0f - s.opacity);
  vstore2((float2)(d_u, d_v), g, screen_gradients);

  /* To R = R_world_own: columns of dL/dV by the scales, then R_world_camera. Rows of A: dL/dR. */
  const float3 d_V0 = d_M0 * s.scale, d_V1 = d_M1 * s.scale, d_V2 = d_M2 * s.scale;
  const float3 A0 = pose.s0 * d_V0 + pose.s3 * d_V1 + pose.s6 * d_V2;
  const float3 A1 = pose.s1 * d_V0 + pose.s4 * d_V1 + pose.s7 * d_V2;
  const float3 A2 = pose.s2 * d_V0 + pose.s5 * d_V1 + pose.s8 * d_V2;
  const float w = s.qw, x = s.q.x, y = s.q.y, z = s.q.z;
  const float4 d_unit = 2.0f * (float4)(x * (A2.y - A1.z) + y * (A0.z - A2.x) + z * (A1.x - A0.y),
                                        -2.0f * x * (A1.y + A2.z) + y * (A0.y + A1.x) + z * (A0.z + A2.x) + w * (A2.y - A1.z),
                                        x * (A0.y + A1.x) - 2.0f * y * (A0.x + A2.z) + z * (A1.z + A2.y) + w * (A0.z - A2.x),
                                        x * (A0.z + A2.x) + y * (A1.z + A2.y) - 2.0f * z * (A0.x + A1.y) + w * (A1.x - A0.y));
  const float4 unit = (float4)(w, s.q);
  vstore4((d_unit - dot(d_unit, unit) * unit) / s.q_norm, g, rotation_gradients);

  if (with_pose) {
    /* theta: p x dL/dp, and sum over columns k of M_k x (dL/dM)_k. */
    const float3 turn = cross(s.p, d_p) + (float3)(dot(s.M1, d_M2) - dot(s.M2, d_M1), dot(s.M2, d_M0) - dot(s.M0, d_M2),
                                                   dot(s.M0, d_M1) - dot(s.M1, d_M0));
    vstore3(d_p, 2 * g, pose_terms);
    vstore3(turn, 2 * g + 1, pose_terms);
  }
}
