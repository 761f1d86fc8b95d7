// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/edit/gaussian_shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "odosplat/cloud/cloud_filters.hpp"

namespace odosplat {
namespace {

constexpr int shape_spacing_neighbors = 6;
constexpr float most_flat_ratio = 0.5F;  // shortest over middle axis

Eigen::Vector3f axis_of(const Gaussians& gaussians, std::size_t i, int axis) {
  const float* r = &gaussians.rotations[4 * i];
  const Eigen::Quaternionf q(r[0], r[1], r[2], r[3]);
  if (!(q.norm() > 0.0F)) return Eigen::Vector3f::Unit(axis);
  return q.normalized() * Eigen::Vector3f::Unit(axis);
}

}  // namespace

Eigen::Vector3f longest_axis(const Gaussians& gaussians, std::size_t i) {
  const float* scale = &gaussians.log_scales[3 * i];
  return axis_of(gaussians, i, static_cast<int>(std::max_element(scale, scale + 3) - scale));
}

GaussianShapes gaussian_shapes(const Gaussians& gaussians) {
  gaussians.check();
  GaussianShapes shapes;
  const std::size_t n = gaussians.size();
  const auto stride = 3 * static_cast<std::size_t>(gaussians.coefficients());
  for (std::size_t i = 0; i < n; ++i) {
    std::array<float, 3> scale{};
    for (std::size_t a = 0; a < 3; ++a) scale[a] = std::exp(gaussians.log_scales[3 * i + a]);
    const auto thin = std::min_element(scale.begin(), scale.end()) - scale.begin();
    shapes.cloud.points.emplace_back(&gaussians.positions[3 * i]);
    shapes.cloud.normals.push_back(axis_of(gaussians, i, static_cast<int>(thin)));
    shapes.cloud.colors.emplace_back(sh_constant * Eigen::Vector3f(&gaussians.sh[stride * i]) +
                                     Eigen::Vector3f::Constant(0.5F));
    std::sort(scale.begin(), scale.end());
    shapes.flat.push_back(scale[0] <= most_flat_ratio * scale[1] ? 1 : 0);
    shapes.thickness.push_back(scale[0]);
    shapes.length.push_back(scale[2]);
    shapes.opacities.push_back(1.0F / (1.0F + std::exp(-gaussians.opacity_logits[i])));
  }
  shapes.spacings = mean_neighbor_distances(shapes.cloud, shape_spacing_neighbors);
  return shapes;
}

}  // namespace odosplat
