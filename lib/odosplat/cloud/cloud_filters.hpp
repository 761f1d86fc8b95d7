// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odosplat/core/point_cloud.hpp"

namespace odosplat {

/// One point per voxel: the mean of the points in it, with the mean of their colours and of their normals (scaled to
/// unit length). Order: that of each voxel's first point. Points that are not finite are dropped. voxel_m: edge [m], >
/// 0, else InputError. Voxels are aligned to the world's origin.
PointCloud voxel_downsample(const PointCloud& cloud, double voxel_m);

/// Sets unit normals by principal components of every point and its k >= 3 nearest neighbours, replacing existing ones.
/// Each is oriented towards the nearest of the viewpoints [m, world] (positions of the scanner or the cameras). Without
/// viewpoints its largest component is made positive, because the visible side is unknown. Clouds of fewer than 3
/// points get (0, 0, 1), oriented in the same way. Throws InputError for points or viewpoints that are not finite. Uses
/// all threads; deterministic.
void estimate_normals(PointCloud& cloud, int k, const std::vector<Eigen::Vector3d>& viewpoints = {});

/// Mean distance [m] of every point to its k >= 1 nearest others (fewer if the cloud has fewer points; 0 for a single
/// point): the local spacing of the cloud. Throws InputError for points that are not finite. Uses all threads;
/// deterministic.
std::vector<float> mean_neighbor_distances(const PointCloud& cloud, int k);

/// Statistical outlier removal (Rusu et al. 2008, "Towards 3D point cloud based object maps"): drops the points whose
/// mean distance to their k nearest others is more than `deviations` standard deviations above the mean of the cloud.
/// Order is kept. deviations >= 0.
PointCloud remove_outliers(const PointCloud& cloud, int k = 8, double deviations = 3.0);

}  // namespace odosplat
