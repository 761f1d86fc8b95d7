// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/surface_terms.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "kernels/constants.h"
#include "odosplat/core/error.hpp"

namespace odosplat {

void SurfaceTermsOptions::check() const {
  const auto good = [](double weight) { return weight >= 0.0 && std::isfinite(weight); };
  require(good(place_weight), "place_weight", "at least 0");
  require(good(normal_weight), "normal_weight", "at least 0");
  require(good(flatten_weight), "flatten_weight", "at least 0");
}

std::vector<float> surface_anchors(const Gaussians& discs) {
  std::vector<float> anchors(8 * discs.size(), 0.0F);
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const float* q = &discs.rotations[4 * i];
    const Eigen::Quaternionf rotation(q[0], q[1], q[2], q[3]);
    if (!(rotation.norm() > 0.0F)) continue;
    const Eigen::Vector3f normal = rotation.normalized() * Eigen::Vector3f::UnitZ();
    const float size = std::exp(std::max(discs.log_scales[3 * i], discs.log_scales[3 * i + 1]));
    float* anchor = &anchors[8 * i];
    for (std::size_t a = 0; a < 3; ++a) {
      anchor[a] = discs.positions[3 * i + a];
      anchor[4 + a] = normal[static_cast<Eigen::Index>(a)];
    }
    anchor[3] = 1.0F / (size * size);
  }
  return anchors;
}

SurfaceTerms::SurfaceTerms(const compute::Context& context, const SurfaceTermsOptions& options)
    : options_((options.check(), options)),
      kernel_(compute::Program(context, {"surface_terms.cl"}).kernel("surface_terms", "loss")) {}

void SurfaceTerms::add(const DeviceGaussians& gaussians, const compute::Buffer<float>& anchors,
                       DeviceGaussians& gradients) {
  require(anchors.size() == 8 * gaussians.size(), "anchors", "one for each Gaussian");
  const auto scaled = [&](double weight) { return static_cast<float>(weight / static_cast<double>(gaussians.size())); };
  kernel_(compute::Range::linear(gaussians.size(), ITEM_GROUP), static_cast<std::int32_t>(gaussians.size()),
          gaussians.positions, gaussians.log_scales, gaussians.rotations, anchors, scaled(options_.place_weight),
          scaled(options_.normal_weight), scaled(options_.flatten_weight), gradients.positions, gradients.log_scales,
          gradients.rotations);
}

}  // namespace odosplat
