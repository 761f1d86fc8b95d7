/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Numbers that C++ and OpenCL must agree on. Plain macros only: this text goes through both compilers. */
#ifndef ODOSPLAT_CONSTANTS_H
#define ODOSPLAT_CONSTANTS_H

/* Tiles of the rasteriser [px]. 16 pixels are one float16 or two float8. */
#define TILE_WIDTH 16
#define TILE_HEIGHT 16

/* A Gaussian adds to a pixel only where its alpha reaches 1/255 (Kerbl et al. 2023); log2 of it. */
#define MIN_ALPHA (1.0f / 255.0f)
#define LOG2_MIN_ALPHA (-7.99435344f)
/* Cap of alpha, so that transmittance never becomes zero and its logarithm stays finite. */
#define MAX_ALPHA 0.99f
/* Compositing of a pixel ends when its transmittance falls below this. */
#define MIN_TRANSMITTANCE 1.0e-4f
/* Gaussians whose centre is nearer than this are not drawn [m]. */
#define NEAR_DEPTH 0.05f
/* Added to both variances of a projected Gaussian [px^2]: no Gaussian falls between pixel centres. */
#define DILATION 0.3f
/* Added likewise before the slope of a Gaussian's depth is taken [px^2]: bounds the slope of Gaussians seen edge-on. */
#define PLANE_DILATION 0.02f
/* Depth mode surface: where the spread of depth along the ray is above this share of it, two surfaces meet in the pixel,
   and the median takes the place of their mean (kt3: median error within 3 px of an edge 22 -> 7 mm). */
#define SURFACE_SPREAD 0.02f
/* The ray-plane depth of a Gaussian at a pixel is at most its centre depth divided by this. */
#define MIN_PLANE_RATIO 0.25f
/* The slope of the perspective is taken at most this share of half the image beyond its border. */
#define JACOBIAN_MARGIN 0.3f
/* Least value of det before / det after dilation in the compensated opacity. */
#define COMPENSATION_FLOOR 0.005f
/* Items of a group in kernels with one item a Gaussian or a pair. */
#define ITEM_GROUP 64
/* Splats that a group of the pixel shell holds in local memory at a time. */
#define PIXEL_BATCH 64
/* Gaussians whose pose gradients one item sums. */
#define POSE_CHUNK 1024

/* Radix sort over chunks: bits a pass, and the size of a digit's table. */
#define RADIX_BITS 11
#define RADIX_SIZE 2048
/* The same over groups: bits a pass, digits, keys of an item and of a group. */
#define RADIX_GROUP_BITS 4
#define RADIX_DIGITS 16
#define RADIX_ITEM_KEYS 8
#define RADIX_GROUP_KEYS (SCAN_GROUP * RADIX_ITEM_KEYS)
/* Scan over groups: items of a group, and values that it takes at once. */
#define SCAN_GROUP 256
#define SCAN_BLOCK (4 * SCAN_GROUP)

#endif
