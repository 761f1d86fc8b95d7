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

/* Radix sort: bits a pass, and the size of a digit's table. */
#define RADIX_BITS 11
#define RADIX_SIZE 2048

#endif
