/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Shared by the rasteriser's kernels: the vector of pixels fV (VW pixels of a row), exp2, rounding.
   A plain a * b + c, never mad(): PoCL fuses only the former. */
#ifndef VW
#define VW 1
#endif
#define NV (TILE_WIDTH / VW)

#if VW == 16
typedef float16 fV;
typedef int16 iV;
#define asfV as_float16
#define asiV as_int16
#define load_fV(p) vload16(0, p)
#define store_fV(v, p) vstore16(v, 0, p)
#define RAMP (float16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#define MASK(condition) (condition)
#elif VW == 8
typedef float8 fV;
typedef int8 iV;
#define asfV as_float8
#define asiV as_int8
#define load_fV(p) vload8(0, p)
#define store_fV(v, p) vstore8(v, 0, p)
#define RAMP (float8)(0, 1, 2, 3, 4, 5, 6, 7)
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

/* 2^x for -16 < x < 16, relative error below 3e-6: the magic number rounds x to an integer, a polynomial takes the rest.
   Garbage, not a trap, outside. Breaks under -cl-fast-relaxed-math. */
inline fV exp2_poly(fV x) {
  const fV z = x + 12582912.0f;
  const fV f = x - (z - 12582912.0f);
  const fV p = (((0.0095701017f * f + 0.0559178603f) * f + 0.240247448f) * f + 0.693121815f) * f + 0.999999261f;
  return asfV(asiV(p) + (asiV(z) << 23));
}

inline int int_floor(float x) {
  const int t = (int)x;
  return t - (x < (float)t);
}
inline int int_ceil(float x) {
  const int t = (int)x;
  return t + (x > (float)t);
}

/* What the compositing kernels read of a Gaussian, three float4:
   0: u, v [px], A, B;   1: C, log2 opacity, depth of the centre [m], half height [px];   2: slope_u, slope_v [1/px], -, -
   log2 alpha(dx, dy) = log2 opacity - (A dx^2 + B dx dy + C dy^2), (dx, dy) = pixel - (u, v)
   depth(dx, dy) = depth / max(1 - slope_u dx - slope_v dy, MIN_PLANE_RATIO) */
#define SPLAT_VECTORS 3

/* Sums that the backward pass keeps for a pair, in a slot of SLOT_FLOATS: with h = dL/d ln alpha of a pixel,
   0..5: h (1, dx, dy, dx^2, dx dy, dy^2); with depth 4 more: dL/d(depth of the centre) through the ratio, and
   t (1, dx, dy), t = dL/d(ratio) with its sign turned; with colour 3 more: dL/d(r, g, b). */
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
#define WITH_DEPTH (DEPTH_MODE != DEPTH_NONE)
#define SLOT_DEPTH 6
#define SLOT_COLOR (6 + 4 * WITH_DEPTH)
#define SLOT_FLOATS (6 + 4 * WITH_DEPTH + 3 * WITH_COLOR)
