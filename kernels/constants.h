/* SPDX-License-Identifier: Apache-2.0
   Copyright 2026 The odosplat authors
   Constants shared by C++ and OpenCL. Plain macros only, as both compilers read this file. */
#ifndef ODOSPLAT_CONSTANTS_H
#define ODOSPLAT_CONSTANTS_H

/* Tiles of the rasteriser [px]. 16 pixels are one float16 or two float8. */
#define TILE_WIDTH 16
#define TILE_HEIGHT 16

/* A Gaussian contributes to a pixel only if its alpha there is at least 1/255 (Kerbl et al. 2023); log2 of that. */
#define MIN_ALPHA (1.0f / 255.0f)
#define LOG2_MIN_ALPHA (-7.99435344f)
/* Upper limit of alpha, so that transmittance never becomes zero and its logarithm stays finite. */
#define MAX_ALPHA 0.99f
/* Compositing of a pixel ends when its transmittance falls below this. */
#define MIN_TRANSMITTANCE 1.0e-4f
/* Gaussians whose centre is nearer than this are not drawn [m]. */
#define NEAR_DEPTH 0.05f
/* Added to both variances of a projected Gaussian [px^2], so that no Gaussian falls between pixel centres. */
#define DILATION 0.3f
/* Added likewise before the slope of a Gaussian's depth is computed [px^2]: limits the slope of Gaussians seen
   edge-on. */
#define PLANE_DILATION 0.02f
/* Depth mode surface: if the standard deviation of depth along the ray is more than this share of the mean depth, two
   surfaces project into the pixel, and the median is used instead of the mean, which is more accurate at depth
   edges. */
#define SURFACE_SPREAD 0.02f
/* The ray-plane depth of a Gaussian at a pixel is at most its centre depth divided by this. */
#define MIN_PLANE_RATIO 0.25f
/* For centres outside the image, the projection's Jacobian is evaluated at most this share of half the image beyond its
   border. */
#define JACOBIAN_MARGIN 0.3f
/* Lower limit of det before / det after dilation in the compensated opacity. */
#define COMPENSATION_FLOOR 0.005f
/* Items per group in kernels with one item per Gaussian or per pair. */
#define ITEM_GROUP 64
/* Splats that a group of the pixel shell keeps in local memory at a time. */
#define PIXEL_BATCH 64
/* Gaussians whose pose gradients are summed by one item. */
#define POSE_CHUNK 1024

/* Radix sort over chunks: bits per pass, and number of values of a digit. */
#define RADIX_BITS 11
#define RADIX_SIZE 2048
/* Radix sort over groups: bits per pass, number of values of a digit, keys per item and per group. */
#define RADIX_GROUP_BITS 4
#define RADIX_DIGITS 16
#define RADIX_ITEM_KEYS 8
#define RADIX_GROUP_KEYS (SCAN_GROUP * RADIX_ITEM_KEYS)
/* Scan over groups: items per group, and values that a group scans at once. */
#define SCAN_GROUP 256
#define SCAN_BLOCK (4 * SCAN_GROUP)

#endif
