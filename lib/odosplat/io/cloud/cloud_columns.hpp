// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace odosplat {

/// Indices of the columns (from 0) with the points, colours and normals of a point cloud.
struct CloudColumns {
  using Triple = std::array<std::size_t, 3>;

  std::optional<Triple> point;
  std::optional<Triple> color;
  std::optional<Triple> normal;
};

/// Finds x y z, red green blue (diffuse_red .., r g b) and nx ny nz (normal_x .., normalx ..) among the names of a
/// file's columns, in upper or lower case; of two equal names the first is used. Empty names are ignored.
CloudColumns find_cloud_columns(const std::vector<std::string>& names);

}  // namespace odosplat
