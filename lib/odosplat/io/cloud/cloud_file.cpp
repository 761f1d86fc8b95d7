// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud/cloud_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "odosplat/core/log.hpp"
#include "odosplat/io/cloud/cloud_scan.hpp"
#include "odosplat/io/cloud/ply.hpp"

namespace odosplat {
namespace {

using PropertyNames = std::array<const char*, 3>;
using Vectors = std::vector<Eigen::Vector3f>;

// Collects batches into a cloud, which has colours and normals for all points or for none.
class Collector {
 public:
  explicit Collector(const std::string& name) : name_(name) {}

  void add(const CloudBatch& batch) {
    for (const Eigen::Vector3d& point : batch.points) cloud_.points.push_back(round_point(name_, point));
    cloud_.colors.insert(cloud_.colors.end(), batch.colors.begin(), batch.colors.end());
    cloud_.normals.insert(cloud_.normals.end(), batch.normals.begin(), batch.normals.end());
  }

  PointCloud finish() {
    const auto without = static_cast<std::size_t>(
        std::count_if(cloud_.normals.begin(), cloud_.normals.end(), [](const auto& n) { return n.isZero(0.0F); }));
    if (without > 0) {
      if (without < cloud_.size()) {
        log_warning(name_ + ": " + std::to_string(without) + " of " + std::to_string(cloud_.size()) +
                    " points have no normal; all normals are left out");
      }
      cloud_.normals = {};
    }
    return std::move(cloud_);
  }

 private:
  const std::string& name_;
  PointCloud cloud_;
};

std::vector<float> axis_of(const Vectors& vectors, int axis) {
  std::vector<float> column(vectors.size());
  for (std::size_t i = 0; i < vectors.size(); ++i) column[i] = vectors[i][axis];
  return column;
}

std::vector<std::uint8_t> bytes_of(const Vectors& colors, int axis) {
  std::vector<std::uint8_t> column(colors.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const float value = std::min(std::max(colors[i][axis], 0.0F), 1.0F);
    column[i] = static_cast<std::uint8_t>(std::lround(255.0F * value));
  }
  return column;
}

}  // namespace

PointCloud read_point_cloud(const std::string& path) {
  Collector collector(path);
  scan_cloud(path, [&](const CloudBatch& batch) { collector.add(batch); });
  return collector.finish();
}

PointCloud parse_point_cloud(const std::string& name, const std::string& bytes) {
  Collector collector(name);
  scan_cloud_bytes(name, bytes, [&](const CloudBatch& batch) { collector.add(batch); });
  return collector.finish();
}

void write_point_cloud(const std::string& path, const PointCloud& cloud, const std::vector<std::string>& notes) {
  PlyElement vertex;
  vertex.name = "vertex";
  const PropertyNames axes{"x", "y", "z"};
  const PropertyNames normal_axes{"nx", "ny", "nz"};
  const PropertyNames channels{"red", "green", "blue"};
  for (int a = 0; a < 3; ++a) vertex.add(axes[static_cast<std::size_t>(a)], axis_of(cloud.points, a));
  for (int a = 0; a < 3 && cloud.has_normals(); ++a) {
    vertex.add(normal_axes[static_cast<std::size_t>(a)], axis_of(cloud.normals, a));
  }
  for (int a = 0; a < 3 && cloud.has_colors(); ++a) {
    vertex.add(channels[static_cast<std::size_t>(a)], bytes_of(cloud.colors, a));
  }
  Ply ply;
  ply.comments = {"odosplat point cloud, metres"};
  ply.comments.insert(ply.comments.end(), notes.begin(), notes.end());
  ply.elements = {std::move(vertex)};
  write_ply(path, ply);
}

}  // namespace odosplat
