// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace odosplat {

/// Which columns of a point cloud hold what, from 0.
struct CloudColumns {
  using Triple = std::array<std::size_t, 3>;

  std::optional<Triple> point;
  std::optional<Triple> color;
  std::optional<Triple> normal;
};

/// Finds x y z, red green blue (diffuse_red .., r g b) and nx ny nz (normal_x .., normalx ..) among the names of a
/// file's columns, in letters of either size; the first of two equal names counts. An empty name is no column.
CloudColumns find_cloud_columns(const std::vector<std::string>& names);

}  // namespace odosplat
