// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/map/map_view.hpp"

namespace odosplat {

struct SurfelOptions {
  double radius = 0.0;  // [m] of every surfel; 0: radius_spacings times the cloud's spacing
  // DSL uses discs of 1 cm on clouds with a spacing of 1 cm. On a square grid the discs leave no gaps from 0.62 on;
  // larger ones extend farther beyond the edges of surfaces.
  double radius_spacings = 0.7;
  int neighbors = 12;          // points of the plane fitted around each point (noise; normal where the cloud has none)
  double min_depth = 0.05;     // [m] nearer surfels are ignored
  double sigma_share = 0.001;  // least sigma as a share of the depth

  void check() const;
};

/// A cloud rendered as surfels: every point is a disc, all of one radius, and a pixel shows the nearest disc along its
/// ray. Source: the prior map of DSL (Ye, Huang, Liu 2020, "Monocular direct sparse localization in a prior 3D surfel
/// map"): points with normals and one radius, rendered into vertex and normal maps. Differences from DSL:
///   - Rays are intersected with discs exactly, on the CPU; no graphics card is used.
///   - The radius follows the cloud's spacing (median over the cloud of the mean distance to a point's six nearest
///     neighbours).
///   - A surfel whose disc lies between pixel centres is shown at the pixel nearest to its centre.
///   - Discs are visible from both sides, so normals need no consistent orientation.
/// Normals are the cloud's; points without one get that of a plane fitted by principal components.
///
/// sigma: sqrt(a^2 + b^2), where a is the residual along the ray of the plane fitted around the surfel and b is
/// sigma_share times the depth; DSL has no sigma. alpha: 1 where there is depth. colour: the surfel's, 0 in holes;
/// empty if the cloud has none. Uses all threads; bit-identical for any number of threads.
class SurfelView : public MapView {
 public:
  /// The cloud is in the map's world frame [m] and may be empty; points that are not finite are left out.
  explicit SurfelView(const PointCloud& cloud, const SurfelOptions& options = {});

  ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override;
  std::string name() const override { return "surfel"; }

  double radius() const { return radius_; }  // [m] of the discs, 0 for an empty cloud

 private:
  SurfelOptions options_;
  PointCloud cloud_;              // with normals
  std::vector<float> residuals_;  // [m] of the fitted planes
  double radius_ = 0.0;
};

}  // namespace odosplat
