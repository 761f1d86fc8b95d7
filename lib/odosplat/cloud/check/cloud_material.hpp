// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "odosplat/cloud/check/cloud_report.hpp"

namespace odosplat {

/// A cloud and a camera that patches are looked at by.
struct PatchWorld {
  const PointCloud* cloud = nullptr;             // with normals [m, world]
  const std::vector<float>* spacings = nullptr;  // [m] one a point
  Camera camera;                                 // of the reduced images
};

/// Images, poses and cloud of a check, reduced to what it needs: the cloud thinned, with normals and spacings, the
/// images halved until they are no wider than CloudCheckOptions::largest_width, the last ones kept.
class CloudMaterial {
 public:
  /// input must live as long. InputError for a cloud of fewer than 4 finite points.
  CloudMaterial(const CloudCheckInput& input, const CloudCheckOptions& options);

  /// The cloud as it was given, times `factor` about the world's origin.
  void set_cloud_scale(double factor);

  PatchWorld world(bool mirrored) const;
  /// Of `image`, reduced; InputError if it is not of the camera's size.
  const GrayImage& gray(std::size_t image);
  /// T_world_camera of an image as a reading has it; none without a pose.
  std::optional<SE3> pose(std::size_t image, const CloudReading& reading) const;
  std::size_t images() const { return input_.T_world_camera.size(); }

  /// Patches that were found so far.
  std::size_t patches() const { return patches_; }
  void count(std::size_t patches) { patches_ += patches; }

 private:
  const CloudCheckInput& input_;
  Camera camera_;
  int halvings_ = 0;
  PointCloud given_;
  std::vector<float> given_spacings_;
  PointCloud cloud_;
  PointCloud mirrored_;
  std::vector<float> spacings_;
  std::map<std::size_t, GrayImage> images_;
  std::size_t patches_ = 0;
};

}  // namespace odosplat
