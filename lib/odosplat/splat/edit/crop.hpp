// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/se3.hpp"
#include "odosplat/splat/edit/view_weights.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// A box of any orientation: least <= T_world_box^-1 * p_world <= most, faces included.
struct CropBox {
  Eigen::Vector3d least = Eigen::Vector3d::Zero();  // [m] in the box's frame
  Eigen::Vector3d most = Eigen::Vector3d::Zero();
  SE3 T_world_box;

  bool contains(const Eigen::Vector3d& p_world) const;
  /// Throws InputError unless least < most on every axis and all is finite.
  void check() const;
};

/// Which Gaussians have their centre in the box (1 per Gaussian). Every Gaussian is on one side, so that a map is the
/// union of what is inside and what is outside.
std::vector<bool> in_box(const Gaussians& gaussians, const CropBox& box);

/// A Gaussian is seen if it makes up at least this much of one view: the sum of its blending weights [px].
inline constexpr float least_seen_px = 0.1F;

/// Which Gaussians are seen in any of the views (weight of at least least_seen_px), or have their centre within
/// `margin` [m], at least 0, of the centre of one that is. options: those of the map's header. Deterministic.
std::vector<bool> seen_by(const compute::Context& context, const Gaussians& gaussians, const RasterizerOptions& options,
                          const std::vector<EditView>& views, double margin, const ViewNotice& notice = {});

}  // namespace odosplat
