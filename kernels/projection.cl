/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   EWA projection of a Gaussian, with all values that its gradient needs (Zwicker et al. 2001, Kerbl et al. 2023).
   pose: rotation world to camera row by row (0..8), translation (9..11), camera centre in the world (12..14).
   lens: fx, fy, cx, cy, then the ranges of x/z and of y/z to which the point of the projection's Jacobian is clamped.
   GW Gaussians at once, in the lanes of vectors: 8 on CPUs (scalar code takes twice the time there, as the compiler
   does not vectorise it), 1 elsewhere and in the backward pass. */
#ifndef GW
#define GW 1
#endif
#if GW == 8
typedef float8 gF;
typedef int8 gI;
typedef struct {
  float8 x, y, z;
} gV;
#define to_gI convert_int8
#define CONVERT_GF convert_float8
#define LANES ((int8)(0, 1, 2, 3, 4, 5, 6, 7))
#define EACH(f) (f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7))
#define GMASK(condition) (condition)
inline gV make_gV(gF x, gF y, gF z) {
  gV v;
  v.x = x;
  v.y = y;
  v.z = z;
  return v;
}
#else
typedef float gF;
typedef int gI;
typedef float3 gV;
#define to_gI (int)
#define CONVERT_GF (float)
#define GMASK(condition) (-(condition))
inline gV make_gV(gF x, gF y, gF z) { return (float3)(x, y, z); }
#endif

/* GW consecutive indices from `first` on, limited to n - 1; gather_*: the values at GW indices. */
#if GW == 8
/* Both arguments are vectors, because oclgrind computes min(vector, scalar) wrongly. */
inline gI group_of(int first, int n) { return min((gI)(first) + LANES, (gI)(n - 1)); }
#define AT(i) values[at.s##i]
inline gF gather_g(global const float* restrict values, gI at) { return (gF)EACH(AT); }
#undef AT
#define AT(i) (int)values[at.s##i]
inline gI gather_indices(global const uint* restrict values, gI at) { return (gI)EACH(AT); }
#undef AT
#define STORE_LANES(v, p) vstore8(v, 0, p)
#define LOAD_LANES(p) vload8(0, p)
#else
inline gI group_of(int first, int n) { return min(first, n - 1); }
#define gather_g(values, at) ((values)[at])
#define gather_indices(values, at) ((int)(values)[at])
#define STORE_LANES(v, p) (*(p) = (v))
#define LOAD_LANES(p) (*(p))
#endif
inline gV gather_gV(global const float* restrict values, gI at) {
  return make_gV(gather_g(values, 3 * at), gather_g(values, 3 * at + 1), gather_g(values, 3 * at + 2));
}

inline gF dot_g(gV a, gV b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline gV cross_g(gV a, gV b) {
  return make_gV(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
inline gV times_g(gV a, gV b) { return make_gV(a.x * b.x, a.y * b.y, a.z * b.z); }
/* k (a - t b) */
inline gV reduced_g(gF k, gV a, gF t, gV b) {
  return make_gV(k * (a.x - t * b.x), k * (a.y - t * b.y), k * (a.z - t * b.z));
}
inline gV weighted_g(float r0, gV a, float r1, gV b, float r2, gV c) {
  return make_gV(r0 * a.x + r1 * b.x + r2 * c.x, r0 * a.y + r1 * b.y + r2 * c.y, r0 * a.z + r1 * b.z + r2 * c.z);
}

typedef struct {
  gV p;           /* centre in the camera frame */
  gV V0, V1, V2;  /* rows of R_camera_own */
  gV M0, M1, M2;  /* rows of R_camera_own diag(scale): covariance = M M^T */
  gV q;           /* x y z of the unit quaternion */
  gF qw, q_norm;
  gV scale;
  gF tx, ty;      /* x/z and y/z, clamped, for the Jacobian */
  gF u, v;
  gV r0, r1, n;   /* rows of the projected square root, and their cross product */
  gF a, b, c;     /* covariance in the image before dilation [px^2] */
  gF det0, det;   /* its determinant before and after dilation, as sums of squares, which avoids cancellation */
  gF opacity;     /* before compensation */
  gF visibility;  /* det0 / det */
} Projection;

/* rotation_w, rotation: the quaternion's w and its x, y, z, of any length. */
inline Projection project_one(gV position, gV log_scale, gF rotation_w, gV rotation, gF logit, float16 pose, float8 lens,
                              float dilation) {
  Projection s;
  s.p = make_gV(pose.s0 * position.x + pose.s1 * position.y + pose.s2 * position.z + pose.s9,
                pose.s3 * position.x + pose.s4 * position.y + pose.s5 * position.z + pose.sa,
                pose.s6 * position.x + pose.s7 * position.y + pose.s8 * position.z + pose.sb);
  s.scale = make_gV(exp(log_scale.x), exp(log_scale.y), exp(log_scale.z));
  s.q_norm = sqrt(rotation_w * rotation_w + dot_g(rotation, rotation));
  const gF w = rotation_w / s.q_norm, x = rotation.x / s.q_norm, y = rotation.y / s.q_norm, z = rotation.z / s.q_norm;
  s.qw = w;
  s.q = make_gV(x, y, z);
  const gV R0 = make_gV(1.0f - 2.0f * (y * y + z * z), 2.0f * (x * y - w * z), 2.0f * (x * z + w * y));
  const gV R1 = make_gV(2.0f * (x * y + w * z), 1.0f - 2.0f * (x * x + z * z), 2.0f * (y * z - w * x));
  const gV R2 = make_gV(2.0f * (x * z - w * y), 2.0f * (y * z + w * x), 1.0f - 2.0f * (x * x + y * y));
  s.V0 = weighted_g(pose.s0, R0, pose.s1, R1, pose.s2, R2);
  s.V1 = weighted_g(pose.s3, R0, pose.s4, R1, pose.s5, R2);
  s.V2 = weighted_g(pose.s6, R0, pose.s7, R1, pose.s8, R2);
  s.M0 = times_g(s.V0, s.scale);
  s.M1 = times_g(s.V1, s.scale);
  s.M2 = times_g(s.V2, s.scale);
  const gF inverse_z = 1.0f / s.p.z;
  const gF hx = s.p.x * inverse_z, hy = s.p.y * inverse_z;
  s.u = lens.s0 * hx + lens.s2;
  s.v = lens.s1 * hy + lens.s3;
  s.tx = min(max(hx, (gF)(lens.s4)), (gF)(lens.s5));
  s.ty = min(max(hy, (gF)(lens.s6)), (gF)(lens.s7));
  s.r0 = reduced_g(lens.s0 * inverse_z, s.M0, s.tx, s.M2);
  s.r1 = reduced_g(lens.s1 * inverse_z, s.M1, s.ty, s.M2);
  s.n = cross_g(s.r0, s.r1);
  s.a = dot_g(s.r0, s.r0);
  s.b = dot_g(s.r0, s.r1);
  s.c = dot_g(s.r1, s.r1);
  s.det0 = dot_g(s.n, s.n);
  s.det = s.det0 + dilation * (s.a + s.c) + dilation * dilation;
  s.opacity = 1.0f / (1.0f + exp(-logit));
  s.visibility = s.det0 / s.det;
  return s;
}

/* Slope of the depth over the image, relative to the depth of the centre: the linear regression of depth on the pixel
   position under the projected Gaussian, (covariance + PLANE_DILATION I)^-1 cov(pixel, depth) / depth. For flat
   Gaussians that is the plane of the disc, for others the ray plane of Zhang et al. 2024. */
typedef struct {
  gF numerator_u, numerator_v, det;
  gF u, v; /* [1/px] */
} Slope;

inline Slope depth_slope(const Projection* s) {
  Slope slope;
  slope.det = s->det0 + PLANE_DILATION * (s->a + s->c) + PLANE_DILATION * PLANE_DILATION;
  slope.numerator_u = dot_g(s->n, cross_g(s->M2, s->r1)) + PLANE_DILATION * dot_g(s->r0, s->M2);
  slope.numerator_v = dot_g(s->n, cross_g(s->r0, s->M2)) + PLANE_DILATION * dot_g(s->r1, s->M2);
  const gF factor = 1.0f / (slope.det * s->p.z);
  slope.u = slope.numerator_u * factor;
  slope.v = slope.numerator_v * factor;
  return slope;
}
