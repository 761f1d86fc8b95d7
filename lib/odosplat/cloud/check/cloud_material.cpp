// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/check/cloud_material.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "odosplat/cloud/cloud_filters.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr std::size_t most_images = 64;  // kept in memory

PointCloud mirrored(PointCloud cloud) {
  for (Eigen::Vector3f& p : cloud.points) p.y() = -p.y();
  for (Eigen::Vector3f& n : cloud.normals) n.y() = -n.y();
  return cloud;
}

// Extent [m] of the middle 90 % of the points along the longest axis.
double extent_of(const PointCloud& cloud) {
  double longest = 0.0;
  for (int a = 0; a < 3; ++a) {
    std::vector<float> values;
    for (const Eigen::Vector3f& p : cloud.points) values.push_back(p[a]);
    std::sort(values.begin(), values.end());
    const std::size_t cut = values.size() / 20;
    longest = std::max(longest, static_cast<double>(values[values.size() - 1 - cut] - values[cut]));
  }
  return longest;
}

}  // namespace

CloudMaterial::CloudMaterial(const CloudCheckInput& input, const CloudCheckOptions& options)
    : input_(input), camera_(input.camera) {
  while (camera_.width > options.largest_width) {
    camera_ = camera_.level(1);
    ++halvings_;
  }
  given_.points = input.cloud.points;
  std::erase_if(given_.points, [](const Eigen::Vector3f& p) { return !p.allFinite(); });
  if (given_.size() < 4) throw InputError("cloud", "has too few points for the check");
  const double least = extent_of(given_) / 2000.0;
  for (double voxel = std::max(least, 1e-6); given_.size() > static_cast<std::size_t>(options.most_points);
       voxel *= 1.3) {
    given_ = voxel_downsample(given_, voxel);
  }
  given_.normals.clear();
  estimate_normals(given_, 12);
  given_spacings_ = mean_neighbor_distances(given_, 6);
  set_cloud_scale(1.0);
}

void CloudMaterial::set_cloud_scale(double factor) {
  cloud_ = given_;
  spacings_ = given_spacings_;
  for (Eigen::Vector3f& p : cloud_.points) p *= static_cast<float>(factor);
  for (float& s : spacings_) s *= static_cast<float>(factor);
  mirrored_ = mirrored(cloud_);
}

PatchWorld CloudMaterial::world(bool is_mirrored) const {
  return {is_mirrored ? &mirrored_ : &cloud_, &spacings_, camera_};
}

const GrayImage& CloudMaterial::gray(std::size_t image) {
  const auto found = images_.find(image);
  if (found != images_.end()) return found->second;
  if (images_.size() >= most_images) images_.erase(images_.begin());
  GrayImage gray = input_.gray(image);
  if (gray.cols != input_.camera.width || gray.rows != input_.camera.height) {
    throw InputError("image " + std::to_string(image), "is not of the camera's size");
  }
  for (int k = 0; k < halvings_; ++k) gray = halve(gray);
  return images_[image] = gray;
}

std::optional<SE3> CloudMaterial::pose(std::size_t image, const CloudReading& reading) const {
  const auto k = static_cast<std::ptrdiff_t>(image) + reading.id_shift;
  if (k < 0 || k >= static_cast<std::ptrdiff_t>(input_.T_world_camera.size())) return std::nullopt;
  const std::optional<SE3>& stored = input_.T_world_camera[static_cast<std::size_t>(k)];
  if (!stored) return std::nullopt;
  const SE3 T = reading.fy_sign < 0 ? reflected(*stored) : *stored;
  return reading.inverted ? T.inverse() : T;
}

}  // namespace odosplat
