// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/similarity.hpp"

namespace odosplat {

struct Sim3IcpOptions {
  double radius = 1.0;       // [m] largest distance of a point's nearest neighbour at the start, > 0
  double inlier = 0.05;      // [m] distance from the cloud's surface up to which a point counts as on it, > 0
  double min_inliers = 0.7;  // share of inliers below which the result is not trusted, 0..1
  double max_change = 1.5;   // largest factor between the scale and its initial guess, > 1
  int max_points = 20000;    // points used, picked evenly from the list, >= 100
  int neighbors = 24;        // neighbours of a cloud point to which its plane is fitted, >= 3
  int iterations = 200;      // at most, >= 1

  /// Throws InputError naming the field.
  void check() const;
};

struct Sim3IcpResult {
  Similarity cloud_from_points;  // p_cloud = cloud_from_points * p
  int points = 0;                // number used
  int inliers = 0;
  double inlier_share = 0.0;  // inliers / points
  double median_m = 0.0;      // median distance of the inliers from the planes of their nearest neighbours
  double rmse_m = 0.0;        // root mean square of the same distance
  double weakest = 0.0;       // least eigenvalue of the inliers' information, see align_to_cloud
  int iterations = 0;
  bool converged = false;  // the last step moved no point by more than a hundredth of the inlier distance
  std::string fault;       // why the result is not reliable; empty if it is
};

/// Aligns points of another frame and scale with a cloud, starting from a rough guess: point-to-plane ICP (Chen and
/// Medioni 1992, "Object modelling by registration of multiple range images") over similarities.
/// Every step takes each point's nearest neighbour in the cloud within a radius, weights its distance from that
/// neighbour's plane by Tukey's function with a width proportional to the median distance, and solves for seven
/// parameters. The radius shrinks from options.radius to twice the inlier distance (or twice the spacing of the cloud,
/// whichever is larger). In addition to the usual method, the scale is estimated and the result is checked. `fault` is
/// set if
///   - fewer than min_inliers of the points lie on the cloud at the end;
///   - the scale changes by more than max_change (unrelated points collapse onto a wall);
///   - the iteration does not converge;
///   - the surfaces leave a direction undetermined: one plane, a sphere, a corridor without ends, three walls of one
///     corner (which fit at any scale about the corner). The criterion is `weakest`, the least eigenvalue of the mean
///     information matrix of the inliers, with lengths in units of their rms distance from their centre: 0 if a
///     direction is undetermined, about 0.07 in a room. Values below 0.004 are refused; noise in the normals
///     contributes up to 0.002.
/// What this cannot detect: an empty box-shaped room fits any other box of the same proportions. Four of its six sides
/// also lie on any other box of that height, which gives inlier shares of up to 0.65; the default of min_inliers is
/// above that.
///
/// points: in any unit; guess * points must be in the metric frame of the cloud. Throws InputError for fewer than 20
/// points or fewer than 100 points in the cloud, and for points that are not finite. Deterministic, whatever the number
/// of threads. Blocks; takes a few seconds for a million points in the cloud.
Sim3IcpResult align_to_cloud(const std::vector<Eigen::Vector3f>& points, const PointCloud& cloud,
                             const Similarity& guess, const Sim3IcpOptions& options = {});

}  // namespace odosplat
