/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Front-to-back compositing of the tiles' lists into images.
   Built with WITH_COLOR, WITH_SIGMA, DEPTH_MODE and one of two shells:
     SHELL_TILE set (for CPUs): one item per tile, one block of 4 x 4 pixels at a time, all sums in private arrays, no
       barrier
     SHELL_TILE not set (pixel shell, for GPUs): one item per pixel, one group per tile, splats through local memory
   Both use the same step, add_splat, for VW pixels and one splat.
   wanted: if `sparse`, the blocks to render, one word per tile (block b: bit b, as in raster_common.cl); otherwise all
   are rendered. Pixels of other blocks are not written (the pixel shell renders all of a tile that has a wanted
   block). */

#define WITH_SPREAD (WITH_SIGMA || DEPTH_MODE == DEPTH_SURFACE)

typedef struct {
  fV T;
#if WITH_COLOR
  fV r, g, b;
#endif
#if WITH_DEPTH
  fV depth; /* with spread: weighted sum of the difference to `first` */
#endif
#if WITH_SPREAD
  fV first, square; /* first: depth of the first Gaussian; sums of differences to it lose less precision */
#endif
#if WITH_SIGMA
  fV steepness;
#endif
#if DEPTH_MODE == DEPTH_SURFACE
  fV median;
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
#if WITH_SPREAD
  s->first = (fV)(0.0f);
  s->square = (fV)(0.0f);
#endif
#if WITH_SIGMA
  s->steepness = (fV)(0.0f);
#endif
#if DEPTH_MODE == DEPTH_SURFACE
  s->median = (fV)(0.0f);
#endif
}

/* Adds a splat to the pixels. e: its log2 alpha at the pixels; ratio: divisor of its centre's depth there. */
inline void add_splat(Pixels* s, fV e, fV ratio, float depth, float steepness, float4 color) {
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
  const fV z = depth / max(ratio, (fV)(MIN_PLANE_RATIO));
#if DEPTH_MODE == DEPTH_MEDIAN
  s->depth = CHOOSE(s->depth, z, m & MASK((T >= 0.5f) & (T_after < 0.5f)));
#elif WITH_SPREAD
  s->first = CHOOSE(s->first, z, m & MASK(T == 1.0f));
  const fV difference = z - s->first;
  const fV weighted = w * difference;
  s->depth = s->depth + weighted;
  s->square = s->square + weighted * difference;
#if DEPTH_MODE == DEPTH_SURFACE
  s->median = CHOOSE(s->median, z, m & MASK((T >= 0.5f) & (T_after < 0.5f)));
#endif
#if WITH_SIGMA
  s->steepness = s->steepness + w * steepness;
#endif
#else
  s->depth = s->depth + w * z;
#endif
#endif
}

/* Values of the images, from the sums. */
#if WITH_SPREAD
/* Squared standard deviation of depth along the ray; undefined for pixels that no Gaussian reaches. */
inline fV squared_spread(const Pixels* s) {
  const fV inverse = 1.0f / (1.0f - s->T);
  const fV mean = s->depth * inverse;
  return max(s->square * inverse - mean * mean, (fV)(0.0f));
}
#endif
inline fV final_depth(const Pixels* s) {
#if DEPTH_MODE == DEPTH_EXPECTED || DEPTH_MODE == DEPTH_SURFACE
  const iV touched = MASK(s->T < 1.0f);
#if WITH_SPREAD
  const fV mean = s->first + s->depth / (1.0f - s->T);
#if DEPTH_MODE == DEPTH_SURFACE
  /* Pixels with alpha below 0.5 have no median. */
  const iV mixed = MASK((squared_spread(s) > (SURFACE_SPREAD * SURFACE_SPREAD) * mean * mean) & (s->median > 0.0f));
  return KEEP(CHOOSE(mean, s->median, mixed), touched);
#else
  return KEEP(mean, touched);
#endif
#else
  return KEEP(s->depth / (1.0f - s->T), touched);
#endif
#elif WITH_DEPTH
  return s->depth;
#else
  return (fV)(0.0f);
#endif
}
/* Standard deviation of depth. model: squared factors of spread, steepness, depth, and depth times transmittance
   (SigmaModel). */
inline fV final_sigma(const Pixels* s, fV depth, float4 model) {
#if WITH_SIGMA
  const fV steepness = s->steepness / (1.0f - s->T);
  const fV open = s->T * s->T;
  const fV square = model.x * squared_spread(s) + model.y * steepness * steepness +
                    depth * depth * (model.z + model.w * open);
  return KEEP(sqrt(square), MASK(s->T < 1.0f));
#else
  return (fV)(0.0f);
#endif
}

#define COMPOSITE_ARGUMENTS                                                                                     \
  global const uint *restrict tile_start, global const uint *restrict list, global const float4 *restrict splats, \
      int4 size, global float *restrict color_out,                        \
      global float *restrict depth_out, global float *restrict alpha_out, global float *restrict sigma_out, \
      float4 sigma_model, int sparse, global const uint *restrict wanted

#if SHELL_TILE

/* Writes a block's pixels, stored row by row, to the image; those outside are skipped. */
inline void store_block(global float* restrict image, int2 at, int4 size, fV value) {
  if (at.x + BLOCK <= size.x && at.y + BLOCK <= size.y) {
    global float* to = image + at.y * size.x + at.x;
    vstore4(value.s0123, 0, to);
    vstore4(value.s4567, 0, to + size.x);
    vstore4(value.s89ab, 0, to + 2 * size.x);
    vstore4(value.scdef, 0, to + 3 * size.x);
    return;
  }
  float part[VW];
  vstore16(value, 0, part);
  for (int i = 0; i < VW; ++i) {
    const int x = at.x + i % BLOCK, y = at.y + i / BLOCK;
    if (x < size.x && y < size.y) image[y * size.x + x] = part[i];
  }
}

kernel __attribute__((reqd_work_group_size(1, 1, 1))) void composite(COMPOSITE_ARGUMENTS) {
  const int tile = get_global_id(0);
  const int2 corner = (int2)(tile % size.z * TILE_WIDTH, tile / size.z * TILE_HEIGHT);
  const uint asked = sparse ? wanted[tile] : ~0u;
  if (asked == 0) return;
  Pixels sums[BLOCKS];
  uint alive = 0;
  for (int i = 0; i < BLOCKS; ++i) {
    const int2 at = corner + block_corner(i);
    clear_pixels(&sums[i]);
    /* Pixels outside the image get transmittance 0, so they count as finished. */
    sums[i].T = KEEP((fV)(1.0f), inside_image(at, size));
    if (at.x < size.x && at.y < size.y) alive |= 1u << i;
  }
  alive &= asked;
  const uint made = alive;
  const uint end = tile_start[tile + 1];
  float4 batch[SPLAT_VECTORS * TILE_BATCH];
  for (uint p = tile_start[tile]; p < end && alive != 0; p += TILE_BATCH) {
    const int count = (int)min((uint)TILE_BATCH, end - p);
    load_batch(batch, count, list + p, splats);
    for (int k = 0; k < count; ++k) {
      const float4 s0 = batch[SPLAT_VECTORS * k], s1 = batch[SPLAT_VECTORS * k + 1];
#if WITH_DEPTH
      const float4 s2 = batch[SPLAT_VECTORS * k + 2];
#else
      const float4 s2 = (float4)(0.0f);
#endif
#if WITH_COLOR
      const float4 color = batch[SPLAT_VECTORS * k + 3];
#else
      const float4 color = (float4)(0.0f);
#endif
      BlockMiddles middles;
      uint reached = reach_blocks(&middles, (float2)((float)corner.x, (float)corner.y) - s0.xy, s0.z, s0.w, s1.x, s1.y,
                                  s2.xy) & alive;
      if (reached == 0) continue;
      const fV bend = block_bend(s0.z, s0.w, s1.x), tilt = s2.x * BLOCK_X + s2.y * BLOCK_Y;
      do {
        const int i = last_block(reached);
        reached ^= 1u << i;
        add_splat(&sums[i], block_exponent(&middles, i, bend), block_ratio(&middles, i, tilt), s1.z, s2.z, color);
      } while (reached != 0);
    }
    for (int i = 0; i < BLOCKS; ++i) {
      if ((alive >> i & 1u) != 0 && largest(sums[i].T) < MIN_TRANSMITTANCE) alive ^= 1u << i;
    }
  }
  const int pixels = size.x * size.y;
  for (int i = 0; i < BLOCKS; ++i) {
    if ((made >> i & 1u) == 0) continue;
    const Pixels* s = &sums[i];
    const int2 at = corner + block_corner(i);
    store_block(alpha_out, at, size, 1.0f - s->T);
#if WITH_COLOR
    store_block(color_out, at, size, s->r);
    store_block(color_out + pixels, at, size, s->g);
    store_block(color_out + 2 * pixels, at, size, s->b);
#endif
#if WITH_DEPTH
    const fV depth = final_depth(s);
    store_block(depth_out, at, size, depth);
#if WITH_SIGMA
    store_block(sigma_out, at, size, final_sigma(s, depth, sigma_model));
#endif
#endif
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
  if (sparse && wanted[tile] == 0) return; /* for all items of the group, so no barrier is missed */
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
      batch_color[lane] = splats[SPLAT_VECTORS * g + 3];
#endif
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    const int going_on = unfinished;
    if (going_on) {
      for (int i = 0; i < count; ++i) {
        const float4 s0 = batch0[i], s1 = batch1[i], s2 = batch2[i];
        const float dx = (float)x - s0.x, dy = (float)y - s0.y;
        const float e = s1.y - s1.x * dy * dy - dx * (s0.z * dx + s0.w * dy);
        add_splat(&sums, e, 1.0f - s2.y * dy - s2.x * dx, s1.z, s2.z,
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
  const fV depth = final_depth(&sums);
  depth_out[at] = depth;
#if WITH_SIGMA
  sigma_out[at] = final_sigma(&sums, depth, sigma_model);
#endif
#endif
}

#endif
