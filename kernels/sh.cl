/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Real spherical harmonics up to degree 3, order and signs as in 3DGS maps (m from -l to l, Condon-Shortley phase).
   Built with SH_DEGREE as a constant, so that the compiler knows every index and keeps the arrays in registers. */
#define SH_USED ((SH_DEGREE + 1) * (SH_DEGREE + 1))
#define SH_0 0.28209479f
#define SH_1 0.48860251f
#define SH_2A 1.09254843f
#define SH_2B 0.31539157f
#define SH_2C 0.54627422f
#define SH_3A 0.59004359f
#define SH_3B 2.89061144f
#define SH_3C 0.45704580f
#define SH_3D 0.37317633f
#define SH_3E 1.44530572f

static inline void sh_basis(float3 d, float* basis) {
  const float x = d.x, y = d.y, z = d.z;
  basis[0] = SH_0;
#if SH_DEGREE >= 1
  basis[1] = -SH_1 * y;
  basis[2] = SH_1 * z;
  basis[3] = -SH_1 * x;
#endif
#if SH_DEGREE >= 2
  const float xx = x * x, yy = y * y, zz = z * z;
  basis[4] = SH_2A * x * y;
  basis[5] = -SH_2A * y * z;
  basis[6] = SH_2B * (2.0f * zz - xx - yy);
  basis[7] = -SH_2A * x * z;
  basis[8] = SH_2C * (xx - yy);
#endif
#if SH_DEGREE >= 3
  basis[9] = -SH_3A * y * (3.0f * xx - yy);
  basis[10] = SH_3B * x * y * z;
  basis[11] = -SH_3C * y * (4.0f * zz - xx - yy);
  basis[12] = SH_3D * z * (2.0f * zz - 3.0f * xx - 3.0f * yy);
  basis[13] = -SH_3C * x * (4.0f * zz - xx - yy);
  basis[14] = SH_3E * z * (xx - yy);
  basis[15] = -SH_3A * x * (xx - 3.0f * yy);
#endif
}

/* d/d(x, y, z) of sum_k weight[k] basis[k]. */
static inline float3 sh_slope(float3 d, const float* weight) {
  const float x = d.x, y = d.y, z = d.z;
  float3 g = (float3)(0.0f);
#if SH_DEGREE >= 1
  g = SH_1 * (float3)(-weight[3], -weight[1], weight[2]);
#endif
#if SH_DEGREE >= 2
  g += (SH_2A * weight[4]) * (float3)(y, x, 0.0f);
  g -= (SH_2A * weight[5]) * (float3)(0.0f, z, y);
  g += (2.0f * SH_2B * weight[6]) * (float3)(-x, -y, 2.0f * z);
  g -= (SH_2A * weight[7]) * (float3)(z, 0.0f, x);
  g += (2.0f * SH_2C * weight[8]) * (float3)(x, -y, 0.0f);
#endif
#if SH_DEGREE >= 3
  const float xx = x * x, yy = y * y, zz = z * z;
  g -= (SH_3A * weight[9]) * (float3)(6.0f * x * y, 3.0f * (xx - yy), 0.0f);
  g += (SH_3B * weight[10]) * (float3)(y * z, x * z, x * y);
  g -= (SH_3C * weight[11]) * (float3)(-2.0f * x * y, 4.0f * zz - xx - 3.0f * yy, 8.0f * y * z);
  g += (SH_3D * weight[12]) * (float3)(-6.0f * x * z, -6.0f * y * z, 6.0f * zz - 3.0f * xx - 3.0f * yy);
  g -= (SH_3C * weight[13]) * (float3)(4.0f * zz - 3.0f * xx - yy, -2.0f * x * y, 8.0f * x * z);
  g += (SH_3E * weight[14]) * (float3)(2.0f * x * z, -2.0f * y * z, xx - yy);
  g -= (SH_3A * weight[15]) * (float3)(3.0f * (xx - yy), -6.0f * x * y, 0.0f);
#endif
  return g;
}
