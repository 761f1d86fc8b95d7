/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   One item per Gaussian: colour = max(0, 0.5 + sum_k basis_k(direction) sh[k]). `stored`: coefficients per channel in
   sh. selected: as in project.cl. */
kernel void shade(int n, int select, global const uint* restrict selected, global const float* restrict positions,
                  global const float* restrict sh, int stored, float16 pose, global const uint* restrict counts,
                  global float4* restrict splats) {
  const int g = get_global_id(0);
  if (g >= n || counts[g] == 0) return;
  const size_t from = select ? selected[g] : (uint)g;
  const float3 direction = normalize(vload3(from, positions) - pose.scde);
  float basis[SH_USED];
  sh_basis(direction, basis);
  global const float* coefficient = sh + from * (size_t)(3 * stored);
  float3 color = (float3)(0.5f);
#pragma unroll
  for (int k = 0; k < SH_USED; ++k) color += basis[k] * vload3(k, coefficient);
  splats[SPLAT_VECTORS * g + 3] = (float4)(max(color, 0.0f), 0.0f);
}
