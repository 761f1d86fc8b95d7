// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odosplat/core/point_cloud.hpp"

namespace odosplat {

/// One point a voxel: the mean of the points in it (of their colours too, and of their normals, brought back to unit
/// length). Order: that of each voxel's first point. Points that are not finite are dropped. voxel_m: edge [m], > 0,
/// else InputError. Voxels are aligned to the world's origin.
PointCloud voxel_downsample(const PointCloud& cloud, double voxel_m);

/// Sets unit normals by principal components of every point and its k >= 3 nearest neighbours, replacing those there.
/// Each is turned to the nearest of the viewpoints [m, world] (where the scanner or the cameras stood); without any, so
/// that its largest component is positive: then only the line is known, not the side. Clouds of fewer than 3 points get
/// (0, 0, 1), turned alike. Throws InputError for points or viewpoints that are not finite. Uses all threads;
/// deterministic.
void estimate_normals(PointCloud& cloud, int k, const std::vector<Eigen::Vector3d>& viewpoints = {});

/// Mean distance [m] of every point to its k >= 1 nearest others (fewer where the cloud holds fewer; 0 for a single
/// point): the spacing of the cloud there. Throws InputError for points that are not finite. Uses all threads;
/// deterministic.
std::vector<float> mean_neighbor_distances(const PointCloud& cloud, int k);

/// Statistical outlier removal (Rusu et al. 2008, "Towards 3D point cloud based object maps"): drops the points whose
/// mean distance to their k nearest others is more than `deviations` standard deviations above the mean of the cloud.
/// Order is kept. deviations >= 0.
PointCloud remove_outliers(const PointCloud& cloud, int k = 8, double deviations = 3.0);

}  // namespace odosplat
