// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace odosplat {

/// What the images show of a cloud.
struct CloudCoverage {
  double unseen_share = 0.0;    // of the points: in no image, or hidden in all
  double images_a_point = 0.0;  // median over the points that are seen
  // Share of the directions around +x, -x, +y, -y, +z, -z of the world (a sixth of the sphere each) that an image
  // looks in, 0..1.
  std::array<double, 6> directions{};
};

/// The quality of a map, as its header has it.
struct MapQuality {
  bool good = false;
  std::string verdict;              // one line: "good: ...", "not judged: ..." or "doubtful: ...; likely cause: ..."
  double psnr_db = 0.0;             // median over the training images
  double depth_error_m = -1.0;      // likewise, negative: unknown
  double depth_error_share = -1.0;  // likewise
  int images = 0;
  int odd_images = 0;
  double consistency = 1.0;  // ColorConsistency::Value::unexplained of the geometry as given, negative: unknown
  CloudCoverage coverage;

  /// Lines "quality_NAME value" for the header of a map, and back; none if there are no such lines. from_lines throws
  /// InputError for values that are no numbers. Other lines are ignored.
  std::vector<std::string> to_lines() const;
  static std::optional<MapQuality> from_lines(const std::vector<std::string>& lines);
};

/// Names of CloudCoverage::directions, in their order.
extern const std::array<const char*, 6> direction_names;

}  // namespace odosplat
