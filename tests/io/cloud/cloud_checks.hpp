// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "odosplat/io/cloud/cloud_file.hpp"
#include "tests/io/cloud/cloud_bytes.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat::test {

/// The points of most test files.
inline const std::vector<FilePoint> points{{{101.5, 199.25, -3.125}, {255, 0, 51}, {0, 0, -1}},
                                           {{102.0, 198.0, 7.0}, {1, 2, 3}, {0.6F, 0.8F, 0}},
                                           {{99.0, 205.5, 0.0}, {128, 128, 128}, {1, 0, 0}}};

/// Parts that a cloud must have besides positions.
struct Parts {
  bool colors = true;
  bool normals = true;
};

/// Checks a cloud read from a file of `points`.
inline void expect_points(const PointCloud& cloud, Parts parts) {
  ASSERT_EQ(cloud.size(), points.size());
  EXPECT_EQ(cloud.has_colors(), parts.colors);
  EXPECT_EQ(cloud.has_normals(), parts.normals);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int a = 0; a < 3; ++a) {
      const auto at = static_cast<std::size_t>(a);
      EXPECT_NEAR(cloud.points[i][a], points[i].position[at], 1e-5);
      if (parts.colors) {
        EXPECT_NEAR(cloud.colors[i][a], static_cast<float>(points[i].color[at]) / 255.0F, 1e-6F);
      }
      if (parts.normals) {
        EXPECT_NEAR(cloud.normals[i][a], points[i].normal[at], 1e-6F);
      }
    }
  }
}

/// Message of the InputError for these bytes.
inline std::string fault(const std::string& name, const std::string& bytes) {
  return error_of([&] { parse_point_cloud(name, bytes); });
}

}  // namespace odosplat::test
