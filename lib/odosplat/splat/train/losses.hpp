// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/compute/program.hpp"

namespace odosplat {

enum class ColorTerm { l1, squared_l2 };

struct LossOptions {
  float ssim_weight = 0.2F;              // w in (1 - w) colour + w (1 - SSIM), 0..1
  ColorTerm color_term = ColorTerm::l1;  // mean |difference| (Kerbl et al. 2023), or its square (the paper's text)

  /// Throws InputError naming the field.
  void check() const;
};

/// The loss of one image and its parts, each a mean over all pixels and channels.
struct LossValue {
  double loss = 0.0;
  double l1 = 0.0;    // mean |rendered - target|
  double mse = 0.0;   // mean squared difference
  double ssim = 0.0;  // mean SSIM, -1..1

  /// Peak signal-to-noise ratio for the range 0..1 [dB]; at most 100, so that equal images give a number.
  double psnr_db() const;
};

/// (1 - w) colour difference + w (1 - SSIM) of two images and its gradient, on the device.
/// Source: Kerbl et al. 2023, eq. 7; SSIM: Wang et al. 2004, 11 x 11 Gaussian window of sigma 1.5 centred on the pixel,
/// constants 0.01^2 and 0.03^2, each channel on its own, mean over pixels and channels. Differs: at the image border
/// the window is cut and its weights scaled to sum one, where the public trainers pad the image with zeros. Images are
/// planar [3 x height x width], values about 0..1. The same input gives the same bits on one device. Images may be of
/// any size from 1 x 1; a size other than that of the last call makes the buffers anew. Not thread safe.
class ImageLoss {
 public:
  ImageLoss(const compute::Context& context, const LossOptions& options);

  /// Writes dloss/drendered into gradient [3 x height x width] (resized). Queued, does not wait.
  void evaluate(const compute::Buffer<float>& rendered, const compute::Buffer<float>& target, int width, int height,
                compute::Buffer<float>& gradient);
  /// The value of the last evaluate(). Waits for it. Without one: zeros.
  LossValue value() const;

 private:
  void prepare(int width, int height);

  LossOptions options_;
  compute::Context context_;
  compute::Program program_;
  compute::Kernel moments_vertical_, ssim_horizontal_, spread_vertical_, gradient_, rows_kernel_;
  compute::Buffer<float> moments_, partials_, spread_, values_, rows_;
  int width_ = 0;
  int height_ = 0;
  int stride_ = 0;
};

}  // namespace odosplat
