// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat {

/// The standard deviation of a rendered depth D [m], modelled as the root of the sum of the squares of
///   spread * (standard deviation of depth along the ray)   surfaces that mix in a pixel, layers that disagree
///   slope_px * (slope of the Gaussians' planes [m/px])     an error across the image on a surface seen at an angle
///   depth_share * D                                        an error that is found everywhere
///   open_share * (1 - alpha) * D                           incomplete cover of the pixel by the map
/// All factors in 0..100. The defaults are those of an uncalibrated map.
struct SigmaModel {
  float spread = 1.0F;
  float slope_px = 0.5F;
  float depth_share = 0.003F;
  float open_share = 0.0F;

  /// The spread alone, as it is.
  static SigmaModel plain_spread() { return {1.0F, 0.0F, 0.0F, 0.0F}; }
  /// Throws InputError naming the field.
  void check() const;
  /// Lines "sigma_spread 1" ... for the header of a map, and back: what the lines do not name keeps its default.
  /// from_lines throws InputError for a value that is no number or negative.
  std::vector<std::string> to_lines() const;
  static SigmaModel from_lines(const std::vector<std::string>& lines);
};

}  // namespace odosplat
