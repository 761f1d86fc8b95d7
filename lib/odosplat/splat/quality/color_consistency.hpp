// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/image.hpp"
#include "odosplat/splat/quality/seen_points.hpp"
#include "odosplat/splat/train/training_targets.hpp"

namespace odosplat {

/// An assumed error of poses, camera or cloud; the default: none.
struct GeometryHypothesis {
  bool inverted = false;                             // the poses are T_camera_world
  double unit = 1.0;                                 // factor by which the cloud's coordinates are larger than the
                                                     // poses'
  double focal = 1.0;                                // factor of the given focal length
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // [m, world] of the cloud from its right place in the poses' world

  /// The error in words, as a likely cause: "the poses are inverted", ...
  std::string words() const;
};

/// ColorConsistency::Value::unexplained above which images and cloud do not belong together. Chosen, not fitted: it is
/// 0.04 to 0.10 for correct data, 0.46 to 0.87 for a cloud that is turned by 90 degrees, and 0.84 to 0.88 for one in mm
/// or cm.
inline constexpr double most_unexplained = 0.25;

struct ColorConsistencyOptions {
  std::size_t points = 4000;  // of the cloud, evenly spread, >= 1
  int views = 24;             // evenly spread, >= 2
  int width = 160;            // [px] that images are reduced to, >= 16

  void check() const;
};

/// Whether cloud, poses and camera belong together, before any training: points on a surface look alike in all images
/// that see them, and like the cloud's own colours, if it has any. Images are compared with each other by grey values
/// less their surroundings' mean, which removes the exposure; with the cloud by the correlation of grey values, which
/// shows an offset even where cameras only turn in one place, so that all images have the same error.
/// Keeps the reduced images. Frames: cloud and poses in one world frame [m]. Uses all threads; deterministic.
class ColorConsistency {
 public:
  struct Value {
    // Variance within the points over the variance of all values: 0 for perfect agreement, about 1 if images and points
    // are unrelated; with coloured clouds the geometric mean of that and of the share of the images' variance that the
    // cloud's colours do not explain.
    double unexplained = 1.0;
    std::size_t points = 0;  // seen by two images or more
    double spread_px = 0.0;  // of the points in the images: standard deviation, both directions together
  };

  ColorConsistency(const PointCloud& cloud, TrainingViews& views, const ColorConsistencyOptions& options = {});
  Value of(const GeometryHypothesis& hypothesis) const;

 private:
  struct View {
    GrayImage gray;
    GrayImage detail;  // less the surroundings' mean
    Camera camera;
    SE3 T_world_camera;
  };
  ColorConsistency(const PointCloud& thinned, TrainingViews& views, const ColorConsistencyOptions& options, int);

  SeenPoints points_;
  std::vector<float> grays_;  // of the points; empty: the cloud has no colours
  std::vector<View> views_;
};

/// A hypothesis under which the images agree clearly better than with the given geometry.
struct GeometryDoubt {
  GeometryHypothesis hypothesis;
  double as_given = 1.0;  // Value::unexplained
  double instead = 1.0;
};

/// The best among inverted poses, other units of length (length_units), focal lengths from 0.75 to 1.35 of the given
/// one, and offsets up to 0.6 m, if it is clearly better and the images agree under it (most_unexplained); none
/// otherwise.
std::optional<GeometryDoubt> geometry_doubt(const ColorConsistency& consistency);

}  // namespace odosplat
