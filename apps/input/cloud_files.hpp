// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "odosplat/core/point_cloud.hpp"

namespace odosplat::apps {

/// Help of a flag that takes a cloud, and of --remove-outliers.
inline constexpr const char* cloud_formats = "point cloud (PLY, PCD, LAS, or text: .xyz .csv .txt .asc .pts)";
inline constexpr const char* outliers_help =
    "drop points whose mean distance to their 8 nearest is over 3 standard deviations above the cloud's mean";

/// Reads clouds one after another and thins them to one point a voxel [m] of edge on the way, each point less origin
/// [m]: memory goes with the thinned cloud. Interrupted after Ctrl-C.
PointCloud read_thinned(const std::vector<std::string>& files, double voxel, const Eigen::Vector3d& origin);

/// The same for one file, unless voxel is 0: then the cloud as it is; and without outliers if wanted.
PointCloud read_cloud(const std::string& file, double voxel, bool drop_outliers);

/// Statistical outlier removal with its defaults, which outliers_help names; says on the log how many went.
PointCloud without_outliers(const PointCloud& cloud);

}  // namespace odosplat::apps
