// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/raster/device_gaussians.hpp"

namespace odosplat {

void DeviceGaussians::resize(const compute::Context& context, std::size_t n, int degree) {
  sh_degree = degree;
  count = n;
  positions.resize(context, 3 * n);
  log_scales.resize(context, 3 * n);
  rotations.resize(context, 4 * n);
  opacity_logits.resize(context, n);
  sh.resize(context, 3 * n * static_cast<std::size_t>(coefficients()));
}

void DeviceGaussians::upload(const compute::Context& context, const Gaussians& gaussians) {
  gaussians.check();
  resize(context, gaussians.size(), gaussians.sh_degree);
  positions.upload(gaussians.positions);
  log_scales.upload(gaussians.log_scales);
  rotations.upload(gaussians.rotations);
  opacity_logits.upload(gaussians.opacity_logits);
  sh.upload(gaussians.sh);
}

Gaussians DeviceGaussians::download() const {
  Gaussians gaussians;
  gaussians.sh_degree = sh_degree;
  gaussians.positions = positions.download();
  gaussians.log_scales = log_scales.download();
  gaussians.rotations = rotations.download();
  gaussians.opacity_logits = opacity_logits.download();
  gaussians.sh = sh.download();
  return gaussians;
}

}  // namespace odosplat
