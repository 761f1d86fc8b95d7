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

/// Reads clouds one after another and thins them while reading to one point per voxel of edge `voxel` [m]. origin [m]
/// is subtracted from each point. The memory needed depends on the thinned cloud only. Throws Interrupted after Ctrl-C.
PointCloud read_thinned(const std::vector<std::string>& files, double voxel, const Eigen::Vector3d& origin);

/// Reads one cloud, thinned as above unless voxel is 0, and without outliers if drop_outliers is true.
PointCloud read_cloud(const std::string& file, double voxel, bool drop_outliers);

/// Statistical outlier removal with its defaults, which outliers_help names; logs the number of removed points.
PointCloud without_outliers(const PointCloud& cloud);

}  // namespace odosplat::apps
