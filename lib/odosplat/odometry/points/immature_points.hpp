// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <span>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/points/epipolar_search.hpp"
#include "odosplat/odometry/points/immature_point.hpp"
#include "odosplat/odometry/points/pixel_selector.hpp"

namespace odosplat {

struct ImmaturePointOptions {
  int points = 800;             // wanted of a keyframe that the map does not show at all
  double min_share = 0.02;      // share of the image without map depth below which none are sought
  double min_depth = 0.25;      // [m] a point of unknown depth is searched for from min_depth to max_depth
  double max_depth = 40.0;      // [m]
  double depth_interval = 0.2;  // half width of the interval in which points with depth from the map are searched for,
                                // as a share of that depth
  int max_outliers = 2;         // searches in a row without a match that end a point
  EpipolarSearchOptions search;

  void check() const;
};

/// The pixel of an image with its pattern; the interval of inverse depth is left to the caller.
ImmaturePoint make_immature_point(const GradientImage& gradient, const cv::Point& pixel, double gradient_weight);

/// Pixels of high gradient where `depth` has none, with the widest interval; about options.points times the share of
/// pixels without depth. gradients: of the host's image, full size first. depth: of its size, or empty for a map that
/// shows nothing. May return none.
std::vector<ImmaturePoint> make_immature_points(std::span<const GradientImage> gradients, const cv::Mat1f& depth,
                                                double gradient_weight, PixelSelector& selector,
                                                const ImmaturePointOptions& options);

/// Searches all points in one more image and takes out those that it contradicts. brightness: the target's relative to
/// the host's. Where the target's rows move, a point is searched as its row sees it at the middle of its interval.
/// Several threads; same bits for any number of them.
void trace_points(std::vector<ImmaturePoint>& points, const SE3& T_target_host, const FramePyramid& target,
                  const Brightness& brightness, const ImmaturePointOptions& options);

}  // namespace odosplat
