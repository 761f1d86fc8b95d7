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
  double radius = 1.0;       // [m] how far a point's nearest neighbour may be at the start, > 0
  double inlier = 0.05;      // [m] distance from the cloud's surface up to which a point counts as on it, > 0
  double min_inliers = 0.7;  // share of inliers below which the result is not trusted, 0..1
  double max_change = 1.5;   // factor by which the scale may leave the guess, > 1
  int max_points = 20000;    // points used, evenly picked from the list, >= 100
  int neighbors = 24;        // neighbours of a cloud point that make its plane, >= 3
  int iterations = 200;      // at most, >= 1

  /// Throws InputError naming the field.
  void check() const;
};

struct Sim3IcpResult {
  Similarity cloud_from_points;  // p_cloud = cloud_from_points * p
  int points = 0;                // that were used
  int inliers = 0;
  double inlier_share = 0.0;  // inliers / points
  double median_m = 0.0;      // median distance of the inliers from the planes of their nearest neighbours
  double rmse_m = 0.0;        // and its root of the mean square
  double weakest = 0.0;       // least eigenvalue of the inliers' information, see below
  int iterations = 0;
  bool converged = false;  // the last step moved no point by more than a hundredth of the inlier distance
  std::string fault;       // why the result is not to be trusted; empty: it is
};

/// Brings points of another frame and scale into a cloud's frame, from a rough guess: iterated closest points on planes
/// (Chen and Medioni 1992, "Object modelling by registration of multiple range images") over similarities.
/// Every step takes each point's nearest neighbour in the cloud within a radius, weighs its distance from that
/// neighbour's plane by Tukey's function of a width that follows the median, and solves for seven parameters. The
/// radius shrinks from options.radius to twice the inlier distance (or twice the spacing of the cloud, whichever is
/// more). Differs from the usual: a scale, and an account of whether it may be trusted. It may not (`fault` says why)
/// where fewer than min_inliers of the points come to lie on the cloud, where the scale runs away (points of no
/// relation collapse into a wall), where the steps do not end, or where the surfaces leave a direction open: one plane,
/// a sphere, a corridor without ends, three walls of one corner (all scales about the corner fit them). The last is
/// told by the least eigenvalue of the mean information matrix of the inliers, lengths in units of their rms distance
/// from their centre: 0 where a direction is open, about 0.07 in a room, refused below 0.004 (noise in the normals
/// makes up to 0.002 of it).
/// What this cannot tell: a bare box of a room fits another box of the same proportions, and four of its six sides lie
/// on any other box of that height (shares up to 0.65 were seen); hence the default of min_inliers.
///
/// points: in any unit; cloud and guess so that guess * points are metres of the cloud. At least 20 points and 100 of
/// the cloud, else InputError; InputError also for points that are not finite. Deterministic, whatever the number of
/// threads. Blocks; takes a few seconds for a million points of the cloud.
Sim3IcpResult align_to_cloud(const std::vector<Eigen::Vector3f>& points, const PointCloud& cloud,
                             const Similarity& guess, const Sim3IcpOptions& options = {});

}  // namespace odosplat
