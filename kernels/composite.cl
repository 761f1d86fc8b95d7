/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Front-to-back compositing of the tiles' lists into images.
   Built with WITH_COLOR, WITH_SIGMA, DEPTH_MODE and one shell: SHELL_TILE (item a tile, VW pixels of a row at a time, all
   sums in private arrays, no barrier: for CPUs) or not (item a pixel, group a tile, splats through local memory).
   One step, the same in both, for VW pixels of a row against one splat: */

typedef struct {
  fV T;
#if WITH_COLOR
  fV r, g, b;
#endif
#if WITH_DEPTH
  fV depth; /* with sigma: of the difference to `first` */
#endif
#if WITH_SIGMA
  fV first, square; /* depth of the first Gaussian: sums of small differences keep their digits */
#endif
} Pixels;

inline void clear_pixels(Pixels* s) {
  s->T = (fV)(1.0f);
#if WITH_COLOR
  s->r = (fV)(0.0f);
  s->g = (fV)(0.0f);
  s->b = (fV)(0.0f);
#endif
#if WITH_DEPTH
  s->depth = (fV)(0.0f);
#endif
#if WITH_SIGMA
  s->first = (fV)(0.0f);
  s->square = (fV)(0.0f);
#endif
}

/* e0 = log2 opacity - C dy^2, bd = B dy, ratio0 = 1 - slope_v dy. */
inline void add_splat(Pixels* s, fV dx, float A, float bd, float e0, float depth, float slope_u, float ratio0,
                      float4 color) {
  const fV e = e0 - dx * (A * dx + bd);
  const fV T = s->T;
  const iV m = MASK((e >= LOG2_MIN_ALPHA) & (T >= MIN_TRANSMITTANCE));
  const fV alpha = KEEP(min(exp2_poly(e), (fV)(MAX_ALPHA)), m);
  const fV w = alpha * T;
  const fV T_after = T - w;
  s->T = T_after;
#if WITH_COLOR
  s->r = s->r + w * color.x;
  s->g = s->g + w * color.y;
  s->b = s->b + w * color.z;
#endif
#if WITH_DEPTH
  const fV z = depth / max(ratio0 - slope_u * dx, (fV)(MIN_PLANE_RATIO));
#if DEPTH_MODE == DEPTH_MEDIAN
  s->depth = CHOOSE(s->depth, z, m & MASK((T >= 0.5f) & (T_after < 0.5f)));
#elif WITH_SIGMA
  s->first = CHOOSE(s->first, z, m & MASK(T == 1.0f));
  const fV difference = z - s->first;
  const fV weighted = w * difference;
  s->depth = s->depth + weighted;
  s->square = s->square + weighted * difference;
#else
  s->depth = s->depth + w * z;
#endif
#endif
}

/* What the images hold, from the sums. */
inline fV final_depth(const Pixels* s) {
#if DEPTH_MODE == DEPTH_EXPECTED
  const iV touched = MASK(s->T < 1.0f);
#if WITH_SIGMA
  return KEEP(s->first + s->depth / (1.0f - s->T), touched);
#else
  return KEEP(s->depth / (1.0f - s->T), touched);
#endif
#elif WITH_DEPTH
  return s->depth;
#else
  return (fV)(0.0f);
#endif
}
inline fV final_sigma(const Pixels* s) {
#if WITH_SIGMA
  const fV inverse = 1.0f / (1.0f - s->T);
  const fV mean = s->depth * inverse;
  return KEEP(sqrt(max(s->square * inverse - mean * mean, (fV)(0.0f))), MASK(s->T < 1.0f));
#else
  return (fV)(0.0f);
#endif
}

#define COMPOSITE_ARGUMENTS                                                                                     \
  global const uint *restrict tile_start, global const uint *restrict list, global const float4 *restrict splats, \
      global const float4 *restrict colors, int4 size, global float *restrict color_out,                        \
      global float *restrict depth_out, global float *restrict alpha_out, global float *restrict sigma_out

#if SHELL_TILE

inline void store_row(global float* restrict image, int at, int count, fV value) {
  if (count >= VW) {
    store_fV(value, image + at);
  } else {
    float part[VW];
    store_fV(value, part);
    for (int i = 0; i < count; ++i) image[at + i] = part[i];
  }
}

kernel __attribute__((reqd_work_group_size(1, 1, 1))) void composite(COMPOSITE_ARGUMENTS) {
  const int tile = get_global_id(0);
  const int x0 = (tile % size.z) * TILE_WIDTH, y0 = (tile / size.z) * TILE_HEIGHT;
  const int rows = min(TILE_HEIGHT, size.y - y0);
  Pixels sums[TILE_HEIGHT][NV];
  for (int r = 0; r < TILE_HEIGHT; ++r) {
    for (int v = 0; v < NV; ++v) {
      clear_pixels(&sums[r][v]);
      /* Pixels beyond the border count as finished. */
      const fV outside = (fV)((float)(size.x - x0 - v * VW)) - RAMP;
      sums[r][v].T = KEEP((fV)(1.0f), MASK(outside > 0.0f) & (iV)(r < rows ? -1 : 0));
    }
  }
  const uint begin = tile_start[tile], end = tile_start[tile + 1];
  const fV ramp = RAMP;
  for (uint p = begin; p < end; ++p) {
    const uint g = list[p];
    const float4 s0 = splats[SPLAT_VECTORS * g], s1 = splats[SPLAT_VECTORS * g + 1];
#if WITH_DEPTH
    const float4 s2 = splats[SPLAT_VECTORS * g + 2];
#else
    const float4 s2 = (float4)(0.0f);
#endif
#if WITH_COLOR
    const float4 color = colors[g];
#else
    const float4 color = (float4)(0.0f);
#endif
    const float middle = s0.y - (float)y0;
    const int first = int_ceil(max(middle - s1.w, 0.0f));
    const int last = int_floor(min(middle + s1.w, (float)(rows - 1)));
    const fV dx0 = ramp + ((float)x0 - s0.x);
    for (int r = first; r <= last; ++r) {
      const float dy = (float)r - middle;
      const float e0 = s1.y - s1.x * dy * dy, bd = s0.w * dy, ratio0 = 1.0f - s2.y * dy;
      for (int v = 0; v < NV; ++v) {
        add_splat(&sums[r][v], dx0 + (float)(v * VW), s0.z, bd, e0, s1.z, s2.x, ratio0, color);
      }
    }
    if (((p - begin) & 31u) == 31u) {
      fV most = sums[0][0].T;
      for (int r = 0; r < TILE_HEIGHT; ++r) {
        for (int v = 0; v < NV; ++v) most = max(most, sums[r][v].T);
      }
      float part[VW];
      store_fV(most, part);
      float any = part[0];
      for (int i = 1; i < VW; ++i) any = max(any, part[i]);
      if (any < MIN_TRANSMITTANCE) break;
    }
  }
  const int pixels = size.x * size.y;
  for (int r = 0; r < rows; ++r) {
    for (int v = 0; v < NV; ++v) {
      const Pixels* s = &sums[r][v];
      const int x = x0 + v * VW, at = (y0 + r) * size.x + x, count = size.x - x;
      store_row(alpha_out, at, count, 1.0f - s->T);
#if WITH_COLOR
      store_row(color_out, at, count, s->r);
      store_row(color_out + pixels, at, count, s->g);
      store_row(color_out + 2 * pixels, at, count, s->b);
#endif
#if WITH_DEPTH
      store_row(depth_out, at, count, final_depth(s));
#endif
#if WITH_SIGMA
      store_row(sigma_out, at, count, final_sigma(s));
#endif
    }
  }
}

#else

kernel __attribute__((reqd_work_group_size(TILE_WIDTH, TILE_HEIGHT, 1))) void composite(COMPOSITE_ARGUMENTS) {
  local float4 batch0[PIXEL_BATCH], batch1[PIXEL_BATCH], batch2[PIXEL_BATCH], batch_color[PIXEL_BATCH];
  local int unfinished;
  const int x = get_global_id(0), y = get_global_id(1);
  const int lane = (int)(get_local_id(1) * TILE_WIDTH + get_local_id(0));
  const int tile = (int)(get_group_id(1) * get_num_groups(0) + get_group_id(0));
  const int inside = x < size.x && y < size.y;
  Pixels sums;
  clear_pixels(&sums);
  if (!inside) sums.T = 0.0f;
  const uint begin = tile_start[tile], end = tile_start[tile + 1];
  for (uint base = begin; base < end; base += PIXEL_BATCH) {
    const int count = (int)min((uint)PIXEL_BATCH, end - base);
    if (lane == 0) unfinished = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (sums.T >= MIN_TRANSMITTANCE) atomic_or(&unfinished, 1);
    if (lane < count) {
      const uint g = list[base + (uint)lane];
      batch0[lane] = splats[SPLAT_VECTORS * g];
      batch1[lane] = splats[SPLAT_VECTORS * g + 1];
      batch2[lane] = splats[SPLAT_VECTORS * g + 2];
#if WITH_COLOR
      batch_color[lane] = colors[g];
#endif
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    const int going_on = unfinished;
    if (going_on) {
      for (int i = 0; i < count; ++i) {
        const float4 s0 = batch0[i], s1 = batch1[i], s2 = batch2[i];
        const float dx = (float)x - s0.x, dy = (float)y - s0.y;
        add_splat(&sums, dx, s0.z, s0.w * dy, s1.y - s1.x * dy * dy, s1.z, s2.x, 1.0f - s2.y * dy,
#if WITH_COLOR
                  batch_color[i]
#else
                  (float4)(0.0f)
#endif
        );
      }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (!going_on) break;
  }
  if (!inside) return;
  const int pixels = size.x * size.y, at = y * size.x + x;
  alpha_out[at] = 1.0f - sums.T;
#if WITH_COLOR
  color_out[at] = sums.r;
  color_out[at + pixels] = sums.g;
  color_out[at + 2 * pixels] = sums.b;
#endif
#if WITH_DEPTH
  depth_out[at] = final_depth(&sums);
#endif
#if WITH_SIGMA
  sigma_out[at] = final_sigma(&sums);
#endif
}

#endif
