// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/compute/program.hpp"
#include "odosplat/splat/raster/device_gaussians.hpp"

namespace odosplat {

/// Weights of the terms that hold discs on the surface they were made from, each a sum over Gaussians divided by their
/// number; 0: the term is off.
struct SurfaceTermsOptions {
  double place_weight = 0.0;    // of the squared height above the anchor's plane, in the disc's sizes
  double normal_weight = 1.0;   // of 1 - cos^2 between the disc's axis and the anchor's normal
  double flatten_weight = 0.0;  // of thickness over size (third axis over the geometric mean of the others)

  bool any() const { return place_weight > 0.0 || normal_weight > 0.0 || flatten_weight > 0.0; }
  /// Throws InputError naming the field.
  void check() const;
};

/// The surface that each Gaussian is held to: [N x 8], a point of it [m, world], 1 / size^2 [1/m^2], the unit normal,
/// 0.
std::vector<float> surface_anchors(const Gaussians& discs);

/// Adds the terms' derivatives to the gradients of the image terms. Source: such terms of PGSR (Chen et al. 2024) and
/// 2DGS (Huang et al. 2024), which flatten and align by rendered normals; here the planes of the cloud are known.
class SurfaceTerms {
 public:
  SurfaceTerms(const compute::Context& context, const SurfaceTermsOptions& options);

  /// anchors as surface_anchors makes them, as many as Gaussians. Queued.
  void add(const DeviceGaussians& gaussians, const compute::Buffer<float>& anchors, DeviceGaussians& gradients);

 private:
  SurfaceTermsOptions options_;
  compute::Kernel kernel_;
};

}  // namespace odosplat
