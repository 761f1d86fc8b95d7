// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/map/map_view.hpp"

namespace odosplat {

/// "Spacing" is the mean distance of a point to its six nearest neighbours, limited to four times the cloud's median.
/// Values in brackets are those of DEMO (see InterpolationView) where it has a corresponding parameter.
struct InterpolationOptions {
  int neighbors = 12;            // points of the plane fitted around each point (normal, noise)
  double min_depth = 0.05;       // [m] nearer points are ignored (DEMO: 0.5 m)
  double disc_spacings = 1.0;    // radius of the discs used for occlusion and pixel coverage (DEMO: no such test)
  double hidden_spacings = 1.5;  // a point is occluded if it lies farther than this behind a disc, in spacings ...
  double hidden_share = 0.01;    // ... plus this share of its depth
  double max_radius_px = 34.0;   // [px] largest distance of a point used at a pixel (DEMO: 0.07 focal lengths, 34 px)
  double max_radius_spacings = 2.5;  // the same in projected spacings, at least 1.5 px; the smaller of the two applies
  double max_gap_spacings = 2.0;     // largest distance of a point from another's plane (DEMO: 2 m in depth) ...
  double max_gap_share = 0.01;       // ... plus this share of the depth
  double sigma_share = 0.001;        // least sigma as a share of the depth

  void check() const;
};

/// Depth by interpolation between the points of the cloud, the alternative to a map of Gaussians.
/// Source: the depth association of DEMO (Zhang, Kaess, Singh 2014, "Real-time depth enhanced monocular odometry",
/// section V): of the points projected into the view the three nearest to the pixel, the plane through them, and its
/// intersection with the pixel's ray. In inverse depth that is linear interpolation, which is how it is computed.
/// Differences from DEMO, to get the best depth that a cloud allows:
///   - Points can be occluded by a nearer surface (discs along the cloud's normals in a z-buffer).
///   - The cloud is not thinned to 5 px; radius and depth gap are measured in the cloud's own spacing.
///   - A pixel that no disc covers is a hole, and so is one outside the border of a surface by more than 0.75 spacings.
///   - Where the three nearest points lie on a line, the next ones are tried, and finally the plane fitted around the
///     nearest point is used.
///
/// sigma: sqrt(a^2 + b^2), where a is the residual of the fitted planes along the ray times the interpolation's gain
/// sqrt(sum b_i^2) (b_i: barycentric weights), and b is sigma_share times the depth. alpha: 1 where there is depth.
/// colour: of the nearest point, 0 in holes; empty if the cloud has none. Uses all threads; bit-identical for any
/// number of threads.
class InterpolationView : public MapView {
 public:
  /// The cloud is in the map's world frame [m] and may be empty; points that are not finite are left out.
  explicit InterpolationView(const PointCloud& cloud, const InterpolationOptions& options = {});

  ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override;
  std::string name() const override { return "interpolation"; }

 private:
  InterpolationOptions options_;
  PointCloud cloud_;
  std::vector<float> spacings_;   // [m]
  std::vector<float> residuals_;  // [m] of the fitted planes
};

}  // namespace odosplat
