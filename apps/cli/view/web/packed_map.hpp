// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "odosplat/splat/gaussians.hpp"

namespace odosplat::apps {

/// Gaussians packed for a page. All numbers little endian. Gaussians are ordered along a Z curve and taken in chunks of
/// 256 (the last may be shorter), so that the values of a chunk are near each other. Channels: position x y z,
/// log-scale 0 1 2, then 3 K coefficients of colour (coefficient after coefficient, R G B). A value is
/// low + (high - low) * stored / (2^bits - 1), with the range of its chunk and channel.
///   float32  [chunks x channels x 2]  low, high
///   uint32   [N]       rotation: the three smallest components of the unit quaternion (w x y z) in order, 10 bits each
///                      for -1/sqrt(2) .. 1/sqrt(2), from bit 0 on; bits 30..31: which component is the largest (it is
///                      positive)
///   uint16   [3 x N]   positions, plane after plane
///   uint8    [3 x N]   log-scales; an axis shorter than e^-7 of the longest is stored as that
///   uint8    [3 K x N] colours
///   uint8    [N]       opacity * 255
struct PackedMap {
  static constexpr std::size_t chunk = 256;

  std::size_t count = 0;
  int sh_degree = 0;
  std::string bytes;
};

/// Packs the Gaussians of these rows, with colours of degree `sh_degree` or that of the Gaussians, whichever is less.
PackedMap pack_map(const Gaussians& gaussians, const std::vector<std::size_t>& rows, int sh_degree);

}  // namespace odosplat::apps
