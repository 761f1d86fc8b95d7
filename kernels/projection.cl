/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   EWA projection of one Gaussian with all that its gradient needs again (Zwicker et al. 2001, Kerbl et al. 2023).
   pose: rotation world to camera row by row (0..8), translation (9..11), camera centre in the world (12..14).
   lens: fx, fy, cx, cy, then the range of x/z and of y/z in which the perspective's slope follows the centre. */

typedef struct {
  float3 p;           /* centre in the camera */
  float3 V0, V1, V2;  /* rows of R_camera_own */
  float3 M0, M1, M2;  /* the same with columns times the scales: covariance = M M^T */
  float3 q;           /* x y z of the unit quaternion */
  float qw, q_norm;
  float3 scale;
  float tx, ty;       /* x/z and y/z as the Jacobian takes them */
  float u, v;
  float3 r0, r1, n;   /* rows of the projected square root, and their cross product */
  float a, b, c;      /* covariance in the image before dilation [px^2] */
  float det0, det;    /* its determinant before and after dilation, as sums of squares: no cancellation for needles */
  float opacity;      /* before compensation */
  float visibility;   /* det0 / det */
} Projection;

inline Projection project_one(float3 position, float3 log_scale, float4 rotation, float logit, float16 pose, float8 lens,
                              float dilation) {
  Projection s;
  s.p.x = pose.s0 * position.x + pose.s1 * position.y + pose.s2 * position.z + pose.s9;
  s.p.y = pose.s3 * position.x + pose.s4 * position.y + pose.s5 * position.z + pose.sa;
  s.p.z = pose.s6 * position.x + pose.s7 * position.y + pose.s8 * position.z + pose.sb;
  s.scale = exp(log_scale);
  s.q_norm = sqrt(dot(rotation, rotation));
  const float4 unit = rotation / s.q_norm;
  s.qw = unit.x;
  s.q = unit.yzw;
  const float w = s.qw, x = s.q.x, y = s.q.y, z = s.q.z;
  const float3 R0 = (float3)(1.0f - 2.0f * (y * y + z * z), 2.0f * (x * y - w * z), 2.0f * (x * z + w * y));
  const float3 R1 = (float3)(2.0f * (x * y + w * z), 1.0f - 2.0f * (x * x + z * z), 2.0f * (y * z - w * x));
  const float3 R2 = (float3)(2.0f * (x * z - w * y), 2.0f * (y * z + w * x), 1.0f - 2.0f * (x * x + y * y));
  s.V0 = pose.s0 * R0 + pose.s1 * R1 + pose.s2 * R2;
  s.V1 = pose.s3 * R0 + pose.s4 * R1 + pose.s5 * R2;
  s.V2 = pose.s6 * R0 + pose.s7 * R1 + pose.s8 * R2;
  s.M0 = s.V0 * s.scale;
  s.M1 = s.V1 * s.scale;
  s.M2 = s.V2 * s.scale;
  const float inverse_z = 1.0f / s.p.z;
  const float hx = s.p.x * inverse_z, hy = s.p.y * inverse_z;
  s.u = lens.s0 * hx + lens.s2;
  s.v = lens.s1 * hy + lens.s3;
  s.tx = min(max(hx, lens.s4), lens.s5);
  s.ty = min(max(hy, lens.s6), lens.s7);
  s.r0 = (lens.s0 * inverse_z) * (s.M0 - s.tx * s.M2);
  s.r1 = (lens.s1 * inverse_z) * (s.M1 - s.ty * s.M2);
  s.n = cross(s.r0, s.r1);
  s.a = dot(s.r0, s.r0);
  s.b = dot(s.r0, s.r1);
  s.c = dot(s.r1, s.r1);
  s.det0 = dot(s.n, s.n);
  s.det = s.det0 + dilation * (s.a + s.c) + dilation * dilation;
  s.opacity = 1.0f / (1.0f + exp(-logit));
  s.visibility = s.det0 / s.det;
  return s;
}

/* Slope of the depth over the image, relative to the depth of the centre: the regression of depth on pixel under the
   projected Gaussian, (covariance + PLANE_DILATION I)^-1 cov(pixel, depth) / depth. For flat Gaussians that is the plane
   of the disc, for others the ray plane of Zhang et al. 2024. */
typedef struct {
  float numerator_u, numerator_v, det;
  float u, v; /* [1/px] */
} Slope;

inline Slope depth_slope(const Projection* s) {
  Slope slope;
  slope.det = s->det0 + PLANE_DILATION * (s->a + s->c) + PLANE_DILATION * PLANE_DILATION;
  slope.numerator_u = dot(s->n, cross(s->M2, s->r1)) + PLANE_DILATION * dot(s->r0, s->M2);
  slope.numerator_v = dot(s->n, cross(s->r0, s->M2)) + PLANE_DILATION * dot(s->r1, s->M2);
  const float factor = 1.0f / (slope.det * s->p.z);
  slope.u = slope.numerator_u * factor;
  slope.v = slope.numerator_v * factor;
  return slope;
}
