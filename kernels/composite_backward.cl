/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Gradient of the images with respect to the splats: one slot of sums for each (Gaussian, tile) pair (layout:
   raster_common.cl). Front to back as in composite.cl, with the same masks: the gradient of a pixel is G = sum_i w_i
   v_i with v = alpha gradient + depth gradient * (z - reference) + colour gradient . colour. The part of G that lies
   behind Gaussian i is the total minus the terms up to i. This needs no division by the transmittance.
   reference: for expected depth D the pixel's own D (then dD = sum w (z - D) / alpha, and the total is 0), else 0. */

typedef struct {
  fV alpha;   /* dL/dalpha of the pixel */
  fV behind;  /* sum of w v over the Gaussians not yet processed */
#if WITH_DEPTH
  fV depth, reference;
#endif
#if WITH_COLOR
  fV r, g, b;
#endif
} PixelGradients;

#if SHELL_TILE
/* Loads the block with first pixel (at % size.x, at / size.x); 0 for pixels outside the image. */
inline fV load_pixels(global const float* restrict image, int at, int4 size) {
  const int x = at % size.x, y = at / size.x;
  if (x + BLOCK <= size.x && y + BLOCK <= size.y) {
    global const float* from = image + at;
    return (fV)(vload4(0, from), vload4(0, from + size.x), vload4(0, from + 2 * size.x), vload4(0, from + 3 * size.x));
  }
  float part[VW];
  for (int i = 0; i < VW; ++i) {
    const int inside = x + i % BLOCK < size.x && y + i / BLOCK < size.y;
    part[i] = inside ? image[at + i / BLOCK * size.x + i % BLOCK] : 0.0f;
  }
  return vload16(0, part);
}
#else
#define load_pixels(image, at, size) ((image)[at])
#endif

#define GRADIENT_IMAGES                                                                                          \
  int4 size, int has_alpha, global const float *restrict color,                    \
      global const float *restrict depth, global const float *restrict alpha, global const float *restrict color_gradient, \
      global const float *restrict depth_gradient, global const float *restrict alpha_gradient

inline PixelGradients load_gradients(int at, GRADIENT_IMAGES) {
  PixelGradients p;
  const fV covered = load_pixels(alpha, at, size);
  p.alpha = (fV)(0.0f);
  if (has_alpha) p.alpha = load_pixels(alpha_gradient, at, size);
  p.behind = p.alpha * covered;
#if WITH_DEPTH
  p.depth = load_pixels(depth_gradient, at, size);
  p.reference = load_pixels(depth, at, size);
#if DEPTH_MODE == DEPTH_EXPECTED
  p.depth = KEEP(p.depth / covered, MASK(covered > 0.0f));
#elif DEPTH_MODE == DEPTH_BLENDED
  p.behind = p.behind + p.depth * p.reference;
  p.reference = (fV)(0.0f);
#endif
#endif
#if WITH_COLOR
  const int pixels = size.x * size.y;
  p.r = load_pixels(color_gradient, at, size);
  p.g = load_pixels(color_gradient + pixels, at, size);
  p.b = load_pixels(color_gradient + 2 * pixels, at, size);
  p.behind = p.behind + p.r * load_pixels(color, at, size) + p.g * load_pixels(color + pixels, at, size) +
             p.b * load_pixels(color + 2 * pixels, at, size);
#endif
  return p;
}

typedef struct {
  fV h, hx, hy, hxx, hxy, hyy;
#if WITH_DEPTH
  fV depth, t, tx, ty;
#endif
#if WITH_COLOR
  fV r, g, b;
#endif
} Sums;

inline void clear_sums(Sums* s) {
  s->h = s->hx = s->hy = s->hxx = s->hxy = s->hyy = (fV)(0.0f);
#if WITH_DEPTH
  s->depth = s->t = s->tx = s->ty = (fV)(0.0f);
#endif
#if WITH_COLOR
  s->r = s->g = s->b = (fV)(0.0f);
#endif
}

/* Adds the pixels' gradients by one splat to its sums and returns the transmittance after it. (dx, dy): from the
   splat's centre to the pixels; e, ratio_free: as `e` and `ratio` of add_splat in composite.cl. */
inline fV add_gradient(Sums* s, fV T, fV* behind, const PixelGradients* p, fV dx, fV dy, fV e, fV ratio_free, float depth,
                       float4 color) {
  const iV m = MASK((e >= LOG2_MIN_ALPHA) & (T >= MIN_TRANSMITTANCE));
  const fV full = exp2_poly(e);
  const fV alpha = KEEP(min(full, (fV)(MAX_ALPHA)), m);
  const fV w = alpha * T;
  const fV T_after = T - w;
  fV v = p->alpha;
#if WITH_DEPTH
  const fV ratio = max(ratio_free, (fV)(MIN_PLANE_RATIO));
  const fV inverse_ratio = 1.0f / ratio;
  const fV z = depth * inverse_ratio;
#if DEPTH_MODE != DEPTH_MEDIAN
  v = v + p->depth * (z - p->reference);
  const fV d_z = w * p->depth;
#else
  const fV d_z = KEEP(p->depth, m & MASK((T >= 0.5f) & (T_after < 0.5f)));
#endif
  const fV d_depth = d_z * inverse_ratio;
  s->depth = s->depth + d_depth;
  const fV t = KEEP(d_depth * z, MASK(ratio_free > MIN_PLANE_RATIO));
  s->t = s->t + t;
  s->tx = s->tx + t * dx;
  s->ty = s->ty + t * dy;
#endif
#if WITH_COLOR
  v = v + p->r * color.x + p->g * color.y + p->b * color.z;
  s->r = s->r + w * p->r;
  s->g = s->g + w * p->g;
  s->b = s->b + w * p->b;
#endif
  const fV wv = w * v;
  *behind = *behind - wv;
  /* dL/d ln alpha; 0 where alpha is limited to MAX_ALPHA. */
  const fV h = KEEP(wv - alpha * *behind / (1.0f - alpha), MASK(full < MAX_ALPHA));
  const fV hx = h * dx;
  s->h = s->h + h;
  s->hx = s->hx + hx;
  s->hxx = s->hxx + hx * dx;
  s->hy = s->hy + h * dy;
  s->hxy = s->hxy + hx * dy;
  s->hyy = s->hyy + h * (dy * dy);
  return T_after;
}

#define BACKWARD_ARGUMENTS                                                                                            \
  global const uint *restrict tile_start, global const uint *restrict list, global const uint *restrict slot,         \
      global const float4 *restrict splats, GRADIENT_IMAGES,                                                         \
      global float *restrict slots
#define GRADIENT_IMAGE_NAMES \
  size, has_alpha, color, depth, alpha, color_gradient, depth_gradient, alpha_gradient

#if SHELL_TILE

/* Sum of the lanes, in a fixed order. */
inline float lanes(fV v) {
  const float8 v8 = v.lo + v.hi;
  const float4 v4 = v8.lo + v8.hi;
  const float2 v2 = v4.lo + v4.hi;
  return v2.x + v2.y;
}

kernel __attribute__((reqd_work_group_size(1, 1, 1))) void composite_backward(BACKWARD_ARGUMENTS) {
  const int tile = get_global_id(0);
  const int2 corner = (int2)(tile % size.z * TILE_WIDTH, tile / size.z * TILE_HEIGHT);
  const uint begin = tile_start[tile], end = tile_start[tile + 1];
  if (begin == end) return;
  PixelGradients pixels[BLOCKS];
  fV T[BLOCKS];
  uint alive = 0;
  for (int i = 0; i < BLOCKS; ++i) {
    const int2 at = corner + block_corner(i);
    if (at.x >= size.x || at.y >= size.y) continue;
    pixels[i] = load_gradients(at.y * size.x + at.x, GRADIENT_IMAGE_NAMES);
    T[i] = KEEP((fV)(1.0f), inside_image(at, size));
    alive |= 1u << i;
  }
  float4 batch[SPLAT_VECTORS * TILE_BATCH];
  uint p = begin;
  while (p < end && alive != 0) {
    const int count = (int)min((uint)TILE_BATCH, end - p);
    load_batch(batch, count, list + p, splats);
    for (int k = 0; k < count; ++k, ++p) {
      const float4 s0 = batch[SPLAT_VECTORS * k], s1 = batch[SPLAT_VECTORS * k + 1];
#if WITH_DEPTH
      const float4 s2 = batch[SPLAT_VECTORS * k + 2];
#else
      const float4 s2 = (float4)(0.0f);
#endif
#if WITH_COLOR
      const float4 rgb = batch[SPLAT_VECTORS * k + 3];
#else
      const float4 rgb = (float4)(0.0f);
#endif
      const float2 offset = (float2)((float)corner.x, (float)corner.y) - s0.xy;
      BlockMiddles middles;
      uint reached = reach_blocks(&middles, offset, s0.z, s0.w, s1.x, s1.y, s2.xy) & alive;
      const fV bend = block_bend(s0.z, s0.w, s1.x), tilt = s2.x * BLOCK_X + s2.y * BLOCK_Y;
      Sums sums;
      clear_sums(&sums);
      while (reached != 0) {
        const int i = last_block(reached);
        reached ^= 1u << i;
        const int2 middle = block_corner(i);
        const fV dx = BLOCK_X + (offset.x + ((float)middle.x + 1.5f)), dy = BLOCK_Y + (offset.y + ((float)middle.y + 1.5f));
        T[i] = add_gradient(&sums, T[i], &pixels[i].behind, &pixels[i], dx, dy, block_exponent(&middles, i, bend),
                            block_ratio(&middles, i, tilt), s1.z, rgb);
      }
      global float* out = slots + (size_t)slot[p] * SLOT_FLOATS;
      out[0] = lanes(sums.h);
      out[1] = lanes(sums.hx);
      out[2] = lanes(sums.hy);
      out[3] = lanes(sums.hxx);
      out[4] = lanes(sums.hxy);
      out[5] = lanes(sums.hyy);
#if WITH_DEPTH
      out[SLOT_DEPTH] = lanes(sums.depth);
      out[SLOT_DEPTH + 1] = lanes(sums.t);
      out[SLOT_DEPTH + 2] = lanes(sums.tx);
      out[SLOT_DEPTH + 3] = lanes(sums.ty);
#endif
#if WITH_COLOR
      out[SLOT_COLOR] = lanes(sums.r);
      out[SLOT_COLOR + 1] = lanes(sums.g);
      out[SLOT_COLOR + 2] = lanes(sums.b);
#endif
    }
    for (int i = 0; i < BLOCKS; ++i) {
      if ((alive >> i & 1u) != 0 && largest(T[i]) < MIN_TRANSMITTANCE) alive ^= 1u << i;
    }
  }
  for (; p < end; ++p) {
    global float* out = slots + (size_t)slot[p] * SLOT_FLOATS;
    for (int i = 0; i < SLOT_FLOATS; ++i) out[i] = 0.0f;
  }
}

#else

/* A pipeline: one group per tile, one item per splat. In each step item i processes pixel `step - i`, so that the
   splats are applied to every pixel in order, and every item sums its splat's pixels in order, without reductions. */
#define TILE_PIXELS (TILE_WIDTH * TILE_HEIGHT)
kernel __attribute__((reqd_work_group_size(PIXEL_BATCH, 1, 1))) void composite_backward(BACKWARD_ARGUMENTS) {
  local float T[TILE_PIXELS], behind[TILE_PIXELS], g_alpha[TILE_PIXELS];
#if WITH_DEPTH
  local float g_depth[TILE_PIXELS], reference[TILE_PIXELS];
#endif
#if WITH_COLOR
  local float g_r[TILE_PIXELS], g_g[TILE_PIXELS], g_b[TILE_PIXELS];
#endif
  local int unfinished;
  const int lane = (int)get_local_id(0), tile = (int)get_group_id(0);
  const int x0 = (tile % size.z) * TILE_WIDTH, y0 = (tile / size.z) * TILE_HEIGHT;
  const uint begin = tile_start[tile], end = tile_start[tile + 1];
  for (int i = lane; i < TILE_PIXELS; i += PIXEL_BATCH) {
    const int x = x0 + i % TILE_WIDTH, y = y0 + i / TILE_WIDTH;
    T[i] = 0.0f;
    behind[i] = 0.0f;
    if (x < size.x && y < size.y) {
      const PixelGradients loaded = load_gradients(y * size.x + x, GRADIENT_IMAGE_NAMES);
      T[i] = 1.0f;
      behind[i] = loaded.behind;
      g_alpha[i] = loaded.alpha;
#if WITH_DEPTH
      g_depth[i] = loaded.depth;
      reference[i] = loaded.reference;
#endif
#if WITH_COLOR
      g_r[i] = loaded.r;
      g_g[i] = loaded.g;
      g_b[i] = loaded.b;
#endif
    }
  }
  int going_on = 1;
  for (uint base = begin; base < end; base += PIXEL_BATCH) {
    const uint place = base + (uint)lane;
    const int active = place < end;
    const uint g = active ? list[place] : 0u;
    const float4 s0 = splats[SPLAT_VECTORS * g], s1 = splats[SPLAT_VECTORS * g + 1], s2 = splats[SPLAT_VECTORS * g + 2];
#if WITH_COLOR
    const float4 rgb = splats[SPLAT_VECTORS * g + 3];
#else
    const float4 rgb = (float4)(0.0f);
#endif
    Sums sums;
    clear_sums(&sums);
    if (lane == 0) unfinished = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (going_on) {
      for (int i = lane; i < TILE_PIXELS; i += PIXEL_BATCH) {
        if (T[i] >= MIN_TRANSMITTANCE) atomic_or(&unfinished, 1);
      }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    going_on = unfinished;
    if (going_on) {
      for (int step = 0; step < TILE_PIXELS + PIXEL_BATCH - 1; ++step) {
        const int i = step - lane;
        if (active && i >= 0 && i < TILE_PIXELS) {
          const float dx = (float)(x0 + i % TILE_WIDTH) - s0.x, dy = (float)(y0 + i / TILE_WIDTH) - s0.y;
          const float T_before = T[i];
          if (T_before >= MIN_TRANSMITTANCE && fabs(dy) <= s1.w) {
            PixelGradients pixel;
            pixel.alpha = g_alpha[i];
#if WITH_DEPTH
            pixel.depth = g_depth[i];
            pixel.reference = reference[i];
#endif
#if WITH_COLOR
            pixel.r = g_r[i];
            pixel.g = g_g[i];
            pixel.b = g_b[i];
#endif
            float rest = behind[i];
            T[i] = add_gradient(&sums, T_before, &rest, &pixel, dx, dy,
                                s1.y - s1.x * dy * dy - dx * (s0.z * dx + s0.w * dy), 1.0f - s2.y * dy - s2.x * dx, s1.z,
                                rgb);
            behind[i] = rest;
          }
        }
        barrier(CLK_LOCAL_MEM_FENCE);
      }
    }
    if (active) {
      global float* out = slots + (size_t)slot[place] * SLOT_FLOATS;
      out[0] = sums.h;
      out[1] = sums.hx;
      out[2] = sums.hy;
      out[3] = sums.hxx;
      out[4] = sums.hxy;
      out[5] = sums.hyy;
#if WITH_DEPTH
      out[SLOT_DEPTH] = sums.depth;
      out[SLOT_DEPTH + 1] = sums.t;
      out[SLOT_DEPTH + 2] = sums.tx;
      out[SLOT_DEPTH + 3] = sums.ty;
#endif
#if WITH_COLOR
      out[SLOT_COLOR] = sums.r;
      out[SLOT_COLOR + 1] = sums.g;
      out[SLOT_COLOR + 2] = sums.b;
#endif
    }
  }
}

#endif
