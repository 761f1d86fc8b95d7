/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Shared by the rasteriser's kernels: the vector of pixels fV (VW = 16: a block of 4 x 4; or VW = 1), exp2.
   Products are added as a * b + c, never by mad(), because PoCL fuses only the former. */
#ifndef VW
#define VW 1
#endif

#if VW == 16
typedef float16 fV;
typedef int16 iV;
#define asfV as_float16
#define asiV as_int16
#define MASK(condition) (condition)
#else
typedef float fV;
typedef int iV;
#define asfV as_float
#define asiV as_int
#define MASK(condition) (-(condition))
#endif

/* Keeps v where the mask m is set and gives 0 elsewhere, even where v is not finite. */
#define KEEP(v, m) asfV(asiV(v) & (m))
#define CHOOSE(no, yes, m) asfV((asiV(no) & ~(m)) | (asiV(yes) & (m)))

/* 2^x for -16 < x < 16, relative error below 3e-6: adding 1.5 * 2^23 rounds x to an integer, a polynomial computes 2 to
   the power of the remainder. Outside that range the result is undefined, without a trap. Not valid under
   -cl-fast-relaxed-math. */
inline fV exp2_poly(fV x) {
  const fV z = x + 12582912.0f;
  const fV f = x - (z - 12582912.0f);
  const fV p = (((0.0095701017f * f + 0.0559178603f) * f + 0.240247448f) * f + 0.693121815f) * f + 0.999999261f;
  return asfV(asiV(p) + (asiV(z) << 23));
}

/* A splat: the data of a projected Gaussian for the compositing kernels, four float4, one cache line:
   0: u, v [px], A, B
   1: C, log2 opacity, depth of the centre [m], half height [px]
   2: slope_u, slope_v [1/px], steepness (gradient of depth at the centre) [m/px], unused
   3: red, green, blue, unused (written by shade.cl, with colour only)
   log2 alpha(dx, dy) = log2 opacity - (A dx^2 + B dx dy + C dy^2), (dx, dy) = pixel - (u, v)
   depth(dx, dy) = depth / max(1 - slope_u dx - slope_v dy, MIN_PLANE_RATIO) */
#define SPLAT_VECTORS 4

/* Sums over pixels that the backward pass stores for a pair, in a slot of SLOT_FLOATS:
   0..5: h (1, dx, dy, dx^2, dx dy, dy^2), h = dL/d ln alpha of a pixel
   with depth 4 more: dL/d(depth of the centre) with the ratio fixed, and t (1, dx, dy), t = -dL/d(ratio)
   with colour 3 more: dL/d(r, g, b) */
#ifndef WITH_COLOR
#define WITH_COLOR 0
#endif
#ifndef DEPTH_MODE
#define DEPTH_MODE 0
#endif
#define DEPTH_NONE 0
#define DEPTH_EXPECTED 1
#define DEPTH_MEDIAN 2
#define DEPTH_BLENDED 3
#define DEPTH_SURFACE 4
#define WITH_DEPTH (DEPTH_MODE != DEPTH_NONE)
#define SLOT_DEPTH 6
#define SLOT_COLOR (6 + 4 * WITH_DEPTH)
#define SLOT_FLOATS (6 + 4 * WITH_DEPTH + 3 * WITH_COLOR)

#if VW == 16
/* A tile has 16 blocks of 4 x 4 pixels, row by row; a vector has the pixels of a block, row by row. Compared with
   vectors of 16 pixels of a row, a splat of a few pixels touches a third fewer of them, and finished blocks can be
   skipped separately. Within a block log2 alpha follows from its value and gradient at the block's middle and from the
   quadratic part `bend`, which is the same for all blocks. */
#define BLOCK 4
#define BLOCKS ((TILE_WIDTH / BLOCK) * (TILE_HEIGHT / BLOCK))
/* Offsets from the middle of a block to its pixels, and from a tile's first pixel to the middles of its blocks. */
#define BLOCK_X ((float16)(-1.5f, -0.5f, 0.5f, 1.5f, -1.5f, -0.5f, 0.5f, 1.5f, -1.5f, -0.5f, 0.5f, 1.5f, -1.5f, -0.5f, 0.5f, 1.5f))
#define BLOCK_Y ((float16)(-1.5f, -1.5f, -1.5f, -1.5f, -0.5f, -0.5f, -0.5f, -0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 1.5f, 1.5f, 1.5f, 1.5f))
#define MIDDLE_X ((float16)(1.5f, 5.5f, 9.5f, 13.5f, 1.5f, 5.5f, 9.5f, 13.5f, 1.5f, 5.5f, 9.5f, 13.5f, 1.5f, 5.5f, 9.5f, 13.5f))
#define MIDDLE_Y ((float16)(1.5f, 1.5f, 1.5f, 1.5f, 5.5f, 5.5f, 5.5f, 5.5f, 9.5f, 9.5f, 9.5f, 9.5f, 13.5f, 13.5f, 13.5f, 13.5f))
#define BLOCK_BITS ((int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768))

/* Number of splats that a tile copies into consecutive memory before it processes them. Their places in memory are
   random: reading them one at a time between unpredictable branches would spend a third of the time waiting for
   memory. */
#define TILE_BATCH 32
inline void load_batch(float4* batch, int count, global const uint* restrict list, global const float4* restrict splats) {
  for (int k = 0; k < count; ++k) {
    global const float4* from = splats + SPLAT_VECTORS * list[k];
    batch[SPLAT_VECTORS * k] = from[0];
    batch[SPLAT_VECTORS * k + 1] = from[1];
#if WITH_DEPTH
    batch[SPLAT_VECTORS * k + 2] = from[2];
#endif
#if WITH_COLOR
    batch[SPLAT_VECTORS * k + 3] = from[3];
#endif
  }
}

inline int2 block_corner(int block) { return (int2)(block % 4 * BLOCK, block / 4 * BLOCK); }
inline int last_block(uint blocks) { return 31 - (int)clz(blocks); }
/* Mask of the pixels that lie in the image, for the block with first pixel `at`. */
inline iV inside_image(int2 at, int4 size) {
  return MASK((BLOCK_X + ((float)at.x + 1.5f) < (float)size.x) & (BLOCK_Y + ((float)at.y + 1.5f) < (float)size.y));
}
inline float largest(fV v) {
  const float8 v8 = max(v.lo, v.hi);
  const float4 v4 = max(v8.lo, v8.hi);
  const float2 v2 = max(v4.lo, v4.hi);
  return max(v2.x, v2.y);
}

/* Values of a splat at the middles of the blocks: log2 alpha, its negative gradient, divisor of depth. */
typedef struct {
  float e[BLOCKS], gx[BLOCKS], gy[BLOCKS];
#if WITH_DEPTH
  float ratio[BLOCKS];
#endif
} BlockMiddles;

/* Computes *m and returns the bits of the blocks where the splat may reach MIN_ALPHA: log2 alpha is concave, so it does
   not exceed its tangent at the block's middle. offset: from the splat's centre to the tile's first pixel. */
inline uint reach_blocks(BlockMiddles* m, float2 offset, float A, float B, float C, float log2_opacity, float2 slope) {
  const fV dx = MIDDLE_X + offset.x, dy = MIDDLE_Y + offset.y;
  const fV ax = A * dx, cy = C * dy, q = B * dy + ax;
  const fV e = log2_opacity - cy * dy - dx * q;
  const fV gx = ax + q, gy = B * dx + (cy + cy);
  const iV bits = MASK(1.5f * (fabs(gx) + fabs(gy)) + e >= LOG2_MIN_ALPHA - 1.0e-3f) & BLOCK_BITS;
  vstore16(e, 0, m->e);
  vstore16(gx, 0, m->gx);
  vstore16(gy, 0, m->gy);
#if WITH_DEPTH
  vstore16(1.0f - slope.y * dy - slope.x * dx, 0, m->ratio);
#endif
  const int8 b8 = bits.lo | bits.hi;
  const int4 b4 = b8.lo | b8.hi;
  const int2 b2 = b4.lo | b4.hi;
  return (uint)(b2.x | b2.y);
}
inline fV block_bend(float A, float B, float C) {
  return BLOCK_X * (A * BLOCK_X + B * BLOCK_Y) + C * (BLOCK_Y * BLOCK_Y);
}
/* tilt: change of the divisor within a block. */
inline fV block_ratio(const BlockMiddles* m, int block, fV tilt) {
#if WITH_DEPTH
  return m->ratio[block] - tilt;
#else
  return (fV)(1.0f);
#endif
}
inline fV block_exponent(const BlockMiddles* m, int block, fV bend) {
  return (m->e[block] - bend) - m->gy[block] * BLOCK_Y - m->gx[block] * BLOCK_X;
}
#endif
