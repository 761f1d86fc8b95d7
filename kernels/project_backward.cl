/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   One item for GW Gaussians: sums their pairs' slots in order, then applies the chain rule from the splats to the
   trained parameters and to the pose.
   Derivation: with K the conic and S = K^-1 the dilated covariance, dL/dS = -K dL/dK K; the rest follows the steps of
   project_one and depth_slope from the last to the first. */

#if GW == 8
#define as_gF as_float8
#define as_gI as_int8
#else
#define as_gF as_float
#define as_gI as_int
#endif
#define GKEEP(v, mask) as_gF(as_gI(v) & (mask))

inline gV plus_g(gV a, gV b) { return make_gV(a.x + b.x, a.y + b.y, a.z + b.z); }
inline gV scaled_g(gF k, gV a) { return make_gV(k * a.x, k * a.y, k * a.z); }
/* a + k b */
inline gV added_g(gV a, gF k, gV b) { return make_gV(a.x + k * b.x, a.y + k * b.y, a.z + k * b.z); }

/* Writes one value of each lane to values[stride * g + offset]: 0 for Gaussians without pairs. */
inline void store_g(gF v, gI used, int lanes, int first, int stride, int offset, global float* restrict values) {
  float lane[GW];
  STORE_LANES(GKEEP(v, used), lane);
  for (int i = 0; i < lanes; ++i) values[(size_t)(first + i) * (size_t)stride + (size_t)offset] = lane[i];
}
inline void store_gV(gV v, gI used, int lanes, int first, int stride, int offset, global float* restrict values) {
  store_g(v.x, used, lanes, first, stride, offset, values);
  store_g(v.y, used, lanes, first, stride, offset + 1, values);
  store_g(v.z, used, lanes, first, stride, offset + 2, values);
}

kernel void project_backward(int n, global const float* restrict positions, global const float* restrict log_scales,
                             global const float* restrict rotations, global const float* restrict opacity_logits,
                             float16 pose, float8 lens, float dilation, int compensated, int ray_plane,
                             global const uint* restrict counts,
                             global const uint* restrict offsets, global const float* restrict slots,
                             global float* restrict position_gradients, global float* restrict log_scale_gradients,
                             global float* restrict rotation_gradients, global float* restrict opacity_gradients,
                             global float4* restrict color_gradients, global float* restrict screen_gradients,
                             int with_pose, global float* restrict pose_terms) {
  const int first = (int)get_global_id(0) * GW;
  if (first >= n) return;
  const int lanes = min(GW, n - first);
  float sums[SLOT_FLOATS][GW];
  int has_pairs[GW];
  for (int lane = 0; lane < GW; ++lane) {
    const int g = first + lane;
    const uint count = lane < lanes ? counts[g] : 0u;
    has_pairs[lane] = count > 0 ? -1 : 0;
    float sum[SLOT_FLOATS];
    for (int i = 0; i < SLOT_FLOATS; ++i) sum[i] = 0.0f;
    if (count > 0) {
      global const float* slot = slots + (size_t)offsets[g] * SLOT_FLOATS;
      for (uint k = 0; k < count; ++k, slot += SLOT_FLOATS) {
        for (int i = 0; i < SLOT_FLOATS; ++i) sum[i] += slot[i];
      }
#if WITH_COLOR
      color_gradients[g] = (float4)(sum[SLOT_COLOR], sum[SLOT_COLOR + 1], sum[SLOT_COLOR + 2], 0.0f);
#endif
    }
    for (int i = 0; i < SLOT_FLOATS; ++i) sums[i][lane] = sum[i];
  }
#define SUM(i) LOAD_LANES(sums[i])
  const gI used = LOAD_LANES(has_pairs);
  const gI at = group_of(first, n);
  const gF rotation_w = gather_g(rotations, 4 * at);
  const gV rotation = make_gV(gather_g(rotations, 4 * at + 1), gather_g(rotations, 4 * at + 2),
                              gather_g(rotations, 4 * at + 3));
  const Projection s = project_one(gather_gV(positions, at), gather_gV(log_scales, at), rotation_w, rotation,
                                   gather_g(opacity_logits, at), pose, lens, dilation);
  const gF inverse_z = 1.0f / s.p.z;
  const gF inverse_det = 1.0f / s.det;
  const gF K0 = (s.c + dilation) * inverse_det, K1 = -s.b * inverse_det, K2 = (s.a + dilation) * inverse_det;
  /* y = K d for an offset d: the moments of y give dL/dcovariance = 1/2 sum h y y^T. */
  gF d_u = K0 * SUM(1) + K1 * SUM(2);
  gF d_v = K1 * SUM(1) + K2 * SUM(2);
  const gF Kxx0 = K0 * SUM(3) + K1 * SUM(4), Kxy0 = K0 * SUM(4) + K1 * SUM(5);
  const gF Kxx1 = K1 * SUM(3) + K2 * SUM(4), Kxy1 = K1 * SUM(4) + K2 * SUM(5);
  gF d_a = 0.5f * (Kxx0 * K0 + Kxy0 * K1);
  const gF d_b = Kxx0 * K1 + Kxy0 * K2;
  gF d_c = 0.5f * (Kxx1 * K1 + Kxy1 * K2);
  const gF d_log_opacity = SUM(0);
  const gV none = make_gV((gF)(0.0f), (gF)(0.0f), (gF)(0.0f));
  gV d_n = none, d_r0 = none, d_r1 = none, d_M2 = none;
  gF d_z = (gF)(0.0f);

  if (compensated) {
    const gI bound = GMASK(s.visibility > COMPENSATION_FLOOR);
    const gF d_det = GKEEP(-0.5f * d_log_opacity * inverse_det, bound);
    d_n = added_g(d_n, GKEEP(d_log_opacity / s.det0, bound) + 2.0f * d_det, s.n);
    d_a += dilation * d_det;
    d_c += dilation * d_det;
  }
#if WITH_DEPTH
  d_z += SUM(SLOT_DEPTH);
  if (ray_plane) {
    const Slope slope = depth_slope(&s);
    d_u -= slope.u * SUM(SLOT_DEPTH + 1);
    d_v -= slope.v * SUM(SLOT_DEPTH + 1);
    const gF d_slope_u = SUM(SLOT_DEPTH + 2), d_slope_v = SUM(SLOT_DEPTH + 3);
    const gF factor = 1.0f / (slope.det * s.p.z);
    const gF d_nu = d_slope_u * factor, d_nv = d_slope_v * factor;
    const gF through = d_slope_u * slope.u + d_slope_v * slope.v;
    const gF d_det = -through / slope.det;
    d_z -= through * inverse_z;
    d_n = added_g(d_n, d_nu, cross_g(s.M2, s.r1));
    d_n = added_g(d_n, d_nv, cross_g(s.r0, s.M2));
    d_n = added_g(d_n, 2.0f * d_det, s.n);
    d_M2 = added_g(d_M2, d_nu, cross_g(s.r1, s.n));
    d_M2 = added_g(d_M2, d_nv, cross_g(s.n, s.r0));
    d_M2 = added_g(d_M2, PLANE_DILATION * d_nu, s.r0);
    d_M2 = added_g(d_M2, PLANE_DILATION * d_nv, s.r1);
    d_r0 = added_g(added_g(d_r0, d_nv, cross_g(s.M2, s.n)), PLANE_DILATION * d_nu, s.M2);
    d_r1 = added_g(added_g(d_r1, d_nu, cross_g(s.n, s.M2)), PLANE_DILATION * d_nv, s.M2);
    d_a += PLANE_DILATION * d_det;
    d_c += PLANE_DILATION * d_det;
  }
#endif
  d_r0 = added_g(added_g(plus_g(d_r0, cross_g(s.r1, d_n)), 2.0f * d_a, s.r0), d_b, s.r1);
  d_r1 = added_g(added_g(plus_g(d_r1, cross_g(d_n, s.r0)), 2.0f * d_c, s.r1), d_b, s.r0);
  const gV d_M0 = scaled_g(lens.s0 * inverse_z, d_r0), d_M1 = scaled_g(lens.s1 * inverse_z, d_r1);
  d_M2 = added_g(added_g(d_M2, -s.tx, d_M0), -s.ty, d_M1);
  d_z -= (dot_g(s.r0, d_r0) + dot_g(s.r1, d_r1)) * inverse_z;
  const gF hx = s.p.x * inverse_z, hy = s.p.y * inverse_z;
  const gF d_hx = lens.s0 * d_u - GKEEP(dot_g(s.M2, d_M0), GMASK((hx >= lens.s4) & (hx <= lens.s5)));
  const gF d_hy = lens.s1 * d_v - GKEEP(dot_g(s.M2, d_M1), GMASK((hy >= lens.s6) & (hy <= lens.s7)));
  const gV d_p = make_gV(d_hx * inverse_z, d_hy * inverse_z, d_z - (d_hx * hx + d_hy * hy) * inverse_z);

  store_g(pose.s0 * d_p.x + pose.s3 * d_p.y + pose.s6 * d_p.z, used, lanes, first, 3, 0, position_gradients);
  store_g(pose.s1 * d_p.x + pose.s4 * d_p.y + pose.s7 * d_p.z, used, lanes, first, 3, 1, position_gradients);
  store_g(pose.s2 * d_p.x + pose.s5 * d_p.y + pose.s8 * d_p.z, used, lanes, first, 3, 2, position_gradients);
  store_gV(plus_g(times_g(s.M0, d_M0), plus_g(times_g(s.M1, d_M1), times_g(s.M2, d_M2))), used, lanes, first, 3, 0,
           log_scale_gradients);
  store_g(d_log_opacity * (1.0f - s.opacity), used, lanes, first, 1, 0, opacity_gradients);
  store_g(d_u, used, lanes, first, 2, 0, screen_gradients);
  store_g(d_v, used, lanes, first, 2, 1, screen_gradients);

  /* Gradient by R = R_world_own: dL/dV is dL/dM with columns times the scales; A = R_world_camera dL/dV = dL/dR. */
  const gV d_V0 = times_g(d_M0, s.scale), d_V1 = times_g(d_M1, s.scale), d_V2 = times_g(d_M2, s.scale);
  const gV A0 = weighted_g(pose.s0, d_V0, pose.s3, d_V1, pose.s6, d_V2);
  const gV A1 = weighted_g(pose.s1, d_V0, pose.s4, d_V1, pose.s7, d_V2);
  const gV A2 = weighted_g(pose.s2, d_V0, pose.s5, d_V1, pose.s8, d_V2);
  const gF w = s.qw, x = s.q.x, y = s.q.y, z = s.q.z;
  const gF unit_w = 2.0f * (x * (A2.y - A1.z) + y * (A0.z - A2.x) + z * (A1.x - A0.y));
  const gF unit_x = 2.0f * (y * (A0.y + A1.x) + z * (A0.z + A2.x) + w * (A2.y - A1.z) - 2.0f * x * (A1.y + A2.z));
  const gF unit_y = 2.0f * (x * (A0.y + A1.x) - 2.0f * y * (A0.x + A2.z) + z * (A1.z + A2.y) + w * (A0.z - A2.x));
  const gF unit_z = 2.0f * (x * (A0.z + A2.x) + y * (A1.z + A2.y) - 2.0f * z * (A0.x + A1.y) + w * (A1.x - A0.y));
  const gF along = unit_w * w + unit_x * x + unit_y * y + unit_z * z;
  store_g((unit_w - along * w) / s.q_norm, used, lanes, first, 4, 0, rotation_gradients);
  store_g((unit_x - along * x) / s.q_norm, used, lanes, first, 4, 1, rotation_gradients);
  store_g((unit_y - along * y) / s.q_norm, used, lanes, first, 4, 2, rotation_gradients);
  store_g((unit_z - along * z) / s.q_norm, used, lanes, first, 4, 3, rotation_gradients);

  if (with_pose) {
    /* Rotational part: p x dL/dp plus the sum over M's columns k of M_k x (dL/dM)_k. */
    const gV turn = plus_g(cross_g(s.p, d_p), make_gV(dot_g(s.M1, d_M2) - dot_g(s.M2, d_M1),
                                                      dot_g(s.M2, d_M0) - dot_g(s.M0, d_M2),
                                                      dot_g(s.M0, d_M1) - dot_g(s.M1, d_M0)));
    store_gV(d_p, used, lanes, first, 6, 0, pose_terms);
    store_gV(turn, used, lanes, first, 6, 3, pose_terms);
  }
}
