// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "odosplat/cloud/check/cloud_report.hpp"

namespace odosplat {

/// The cloud and the camera with which patches are compared.
struct PatchWorld {
  const PointCloud* cloud = nullptr;             // with normals [m, world]
  const std::vector<float>* spacings = nullptr;  // [m] one per point
  Camera camera;                                 // of the reduced images
};

/// Images, poses and cloud of a check, reduced in size: the cloud is thinned and has normals and spacings; images are
/// halved until they are no wider than CloudCheckOptions::largest_width, and a limited number is kept in memory.
class CloudMaterial {
 public:
  /// input must outlive this object. Throws InputError for a cloud of fewer than 4 finite points.
  CloudMaterial(const CloudCheckInput& input, const CloudCheckOptions& options);

  /// Sets the cloud to the given one, scaled about the world's origin by `factor`. Factors do not accumulate.
  void set_cloud_scale(double factor);

  PatchWorld world(bool mirrored) const;
  /// The reduced grey image; throws InputError if the image is not of the camera's size.
  const GrayImage& gray(std::size_t image);
  /// T_world_camera of an image under a reading; none if the image has no pose.
  std::optional<SE3> pose(std::size_t image, const CloudReading& reading) const;
  std::size_t images() const { return input_.T_world_camera.size(); }

  /// Number of patches found so far.
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
