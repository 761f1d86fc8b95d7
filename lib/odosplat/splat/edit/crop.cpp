// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/edit/crop.hpp"

#include <cmath>

#include "odosplat/cloud/neighbor_search.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat {

bool CropBox::contains(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d p = T_world_box.inverse() * p_world;
  return (p.array() >= least.array()).all() && (p.array() <= most.array()).all();
}

void CropBox::check() const {
  require(least.allFinite() && most.allFinite() && T_world_box.is_finite(), "box", "finite");
  require((least.array() < most.array()).all(), "box", "larger than nothing: x0 < x1, y0 < y1 and z0 < z1");
}

std::vector<bool> in_box(const Gaussians& gaussians, const CropBox& box) {
  box.check();
  std::vector<bool> inside(gaussians.size());
  for (std::size_t i = 0; i < inside.size(); ++i) {
    inside[i] = box.contains(Eigen::Vector3f(&gaussians.positions[3 * i]).cast<double>());
  }
  return inside;
}

std::vector<bool> seen_by(const compute::Context& context, const Gaussians& gaussians, const RasterizerOptions& options,
                          const std::vector<EditView>& views, double margin, const ViewNotice& notice) {
  require(margin >= 0.0 && std::isfinite(margin), "margin", "at least 0");
  const std::vector<float> weights = largest_weights(context, gaussians, options, views, notice);
  std::vector<bool> seen(gaussians.size());
  std::vector<Eigen::Vector3f> centres;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    seen[i] = weights[i] >= least_seen_px;
    if (seen[i]) centres.emplace_back(&gaussians.positions[3 * i]);
  }
  if (!(margin > 0.0) || centres.empty()) return seen;
  const NeighborSearch search(centres);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    int index = 0;
    float squared = 0.0F;
    if (seen[i]) continue;
    search.nearest(Eigen::Vector3f(&gaussians.positions[3 * i]), 1, &index, &squared);
    seen[i] = static_cast<double>(squared) <= margin * margin;
  }
  return seen;
}

}  // namespace odosplat
