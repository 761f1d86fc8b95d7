// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/core/image.hpp"

namespace odosplat {

/// Peak signal-to-noise ratio [dB] of two colour images of values 0..1 (peak 1), over all pixels and channels; infinite
/// for equal images. Throws InputError if sizes differ or the images are empty.
double psnr_db(const ColorImage& a, const ColorImage& b);

/// Mean structural similarity, 1 for equal images, over pixels and channels.
/// Source: Wang et al. 2004, "Image quality assessment", equation 13: Gaussian window 11x11 of sigma 1.5, K1 = 0.01,
/// K2 = 0.03, range 1. Only windows that lie wholly in the image count. Throws InputError if sizes differ or a side is
/// shorter than 11 px.
double ssim(const ColorImage& a, const ColorImage& b);

}  // namespace odosplat
