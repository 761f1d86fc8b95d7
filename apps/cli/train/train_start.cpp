// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/train/train_start.hpp"

#include "apps/cli/train/stages.hpp"
#include "apps/input/cloud_files.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/splat/quality/cloud_colors.hpp"

namespace odosplat::apps {
namespace {

void require_seen(const std::string& file, const PointCloud& cloud, const TrainingViews& views) {
  if (any_in_view(cloud, views)) return;
  const bool inverted = any_in_view(cloud, views, true);
  throw InputError(file, std::string("no image sees any of its points: ") +
                             (inverted ? "the poses are inverted, or not in the cloud's frame"
                                       : "poses and cloud are not in one frame, or not in metres both"));
}

}  // namespace

TrainingStart prepare_training(const std::string& file, double voxel, bool drop_outliers,
                               const InitializeOptions& initial, TrainingViews& views) {
  Stages stages("prepare", 7);
  TrainingStart p;
  stages.next("reading the cloud");
  p.cloud = read_cloud(file, voxel, drop_outliers);
  require_seen(file, p.cloud, views);
  stages.next("comparing the images at the cloud's points");
  const ColorConsistency consistency(p.cloud, views);
  constexpr std::size_t least_points = 200;  // in common: fewer say nothing
  const ColorConsistency::Value given = consistency.of({});
  p.consistency = given.points >= least_points ? given.unexplained : -1.0;
  p.doubt = geometry_doubt(consistency);
  stages.next("what the images see of the cloud");
  p.coverage = cloud_coverage(p.cloud, views);
  stages.next("colouring the cloud");
  if (!p.cloud.has_colors()) color_from_views(p.cloud, views);
  stages.next("shaping " + std::to_string(p.cloud.size()) + " Gaussians");
  p.start = gaussians_from_cloud(p.cloud, initial);
  if (initial.shape != InitialShape::discs) return p;
  stages.next("smoothing the cloud");
  const PointCloud smoothed = smoothed_cloud(p.cloud, initial);
  stages.next("the cloud's surface");
  p.surface = std::make_unique<InterpolationView>(smoothed);
  p.shared_sigma = noise_left(p.cloud, smoothed, initial);
  return p;
}

}  // namespace odosplat::apps
