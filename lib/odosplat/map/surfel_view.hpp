// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/map/map_view.hpp"

namespace odosplat {

struct SurfelOptions {
  double radius = 0.0;  // [m] of every surfel; 0: radius_spacings times the cloud's spacing
  // DSL: discs of 1 cm on clouds of 1 cm. On a square grid discs close from 0.62 on; larger ones reach over edges.
  double radius_spacings = 0.7;
  int neighbors = 12;          // points of the plane fitted around each point (noise; normal where the cloud has none)
  double min_depth = 0.05;     // [m] nearer surfels are not seen
  double sigma_share = 0.001;  // least sigma as a share of the depth

  void check() const;
};

/// A cloud drawn as surfels: a disc of one fixed radius on every point, the nearest disc along a pixel's ray is what
/// the pixel sees. Source: the prior map of DSL (Ye, Huang, Liu 2020, "Monocular direct sparse localization in a prior
/// 3D surfel map"), points with normals and one radius, drawn into vertex and normal maps. Differs: no graphics card;
/// rays meet discs exactly, on the CPU; the radius follows the cloud's spacing (median over the cloud of the mean
/// distance to a point's six nearest neighbours); a surfel whose disc lies between pixel centres is seen at the pixel
/// nearest to its centre; discs have two sides, so that normals need no direction. Normals are the cloud's; where it
/// has none, those of planes fitted by principal components.
///
/// sigma: the residual of the plane fitted around the surfel along the ray, and sigma_share of the depth, added as
/// squares; DSL has none. alpha: 1 where there is depth. colour: the surfel's, 0 in holes; empty if the cloud has none.
/// Uses all threads; the same bits whatever their number.
class SurfelView : public MapView {
 public:
  /// The cloud is in the map's world frame [m]; points that are not finite are left out; it may be empty.
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
