// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/map/map_view.hpp"

namespace odosplat {

/// "Spacing" is the mean distance of a point to its six nearest neighbours, at most four times the cloud's median.
/// Values in brackets: those of DEMO, where it has the like.
struct InterpolationOptions {
  int neighbors = 12;            // points of the plane fitted around each point (normal, noise)
  double min_depth = 0.05;       // [m] nearer points are not seen (DEMO: 0.5 m)
  double disc_spacings = 1.0;    // radius of the discs that hide and that mark pixels as covered (DEMO: no such test)
  double hidden_spacings = 1.5;  // how far behind a disc a point is hidden, in spacings ...
  double hidden_share = 0.01;    // ... plus this share of its depth
  double max_radius_px = 34.0;   // [px] largest distance of a point used at a pixel (DEMO: 0.07 focal lengths, 34 px)
  double max_radius_spacings =
      2.5;                        // the same in projected spacings; the smaller of the two counts, but 1.5 px at least
  double max_gap_spacings = 2.0;  // largest distance of a point from another's plane (DEMO: 2 m in depth) ...
  double max_gap_share = 0.01;    // ... plus this share of the depth
  double sigma_share = 0.001;     // least sigma as a share of the depth

  void check() const;
};

/// Depth from the discrete cloud by interpolation, the alternative to a map of Gaussians.
/// Source: the depth association of DEMO (Zhang, Kaess, Singh 2014, "Real-time depth enhanced monocular odometry",
/// section V): of the points projected into the view the three nearest to the pixel, the plane through them, and its
/// intersection with the pixel's ray. In inverse depth that is linear interpolation, which is how it is computed.
/// Differs, so as to be as good as a cloud allows: points are hidden by nearer surface (discs on the cloud's normals
/// in a z-buffer); the cloud is not thinned to 5 px; radius and depth gap are measured in the cloud's own spacing; a
/// pixel no disc covers is a hole, and so is one beyond the border of a surface by more than 0.75 spacings; where the
/// three nearest lie on a line the next ones are tried, at last the plane fitted around the nearest point.
///
/// sigma: the residual of the fitted planes, along the ray, times the interpolation's gain sqrt(sum b_i^2), and
/// sigma_share of the depth, added as squares. alpha: 1 where there is depth. colour: of the nearest point, 0 in holes;
/// empty if the cloud has none. Uses all threads; the same bits whatever their number.
class InterpolationView : public MapView {
 public:
  /// The cloud is in the map's world frame [m]; points that are not finite are left out; it may be empty.
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
