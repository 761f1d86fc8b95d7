// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/point_cloud.hpp"

namespace odosplat {

/// What the views of a cloud do with it first.

/// Whether a view uses the cloud's normals. Those that it does not use are not copied.
enum class CloudNormals { used, not_used };

/// The points whose coordinates are finite, with their colours and normals.
PointCloud finite_part(const PointCloud& cloud, CloudNormals normals);

/// The spacing [m] at every point: its mean distance to its six nearest others (mean_neighbor_distances).
std::vector<float> point_spacings(const PointCloud& cloud);

}  // namespace odosplat
