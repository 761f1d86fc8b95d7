// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/SVD>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// Reads well-formed files of poses: TUM (8 values per line) or KITTI (12 values; time = line number). Separate from
/// the library's readers, so that the metrics are tested without them.
inline Trajectory read_poses(const std::string& path) {
  Trajectory trajectory;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream text(line);
    std::vector<double> v;
    for (double value = 0.0; text >> value;) v.push_back(value);
    StampedPose pose;
    if (v.size() == 8) {
      pose.time = v[0];
      pose.T_world_camera = SE3(Eigen::Quaterniond(v[7], v[4], v[5], v[6]), Eigen::Vector3d(v[1], v[2], v[3]));
    } else if (v.size() == 12) {
      Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
      for (int i = 0; i < 12; ++i) M(i / 4, i % 4) = v[static_cast<std::size_t>(i)];
      pose.time = static_cast<double>(trajectory.size());
      // Matrices written with six digits are rotations only to 1e-6: the nearest rotation is used.
      const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M.topLeftCorner<3, 3>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
      pose.T_world_camera = SE3(Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose()), M.topRightCorner<3, 1>());
    }
    trajectory.push_back(pose);
  }
  return trajectory;
}

}  // namespace odosplat
