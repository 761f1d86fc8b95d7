// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "apps/input/map_views.hpp"

namespace odosplat::accuracy {

/// Marks (1) the points in balls of `radius` [m] around randomly chosen points; balls are added until at least `share`
/// (0..1) of all points are marked. positions [N x 3], flat.
std::vector<std::uint8_t> in_random_balls(std::span<const float> positions, double share, double radius,
                                          std::uint64_t seed);

/// Options for moving pieces of a map.
struct MoveOptions {
  int pieces = 6;         // fewer if there is no space for so many
  double edge = 0.7;      // [m] of the cubes that are cut out around randomly chosen points, at least two edges apart
  double distance = 0.3;  // [m] that each piece is moved as a whole, in its own random direction
};
/// Moves the pieces. Returns how many points were moved.
std::size_t move_random_pieces(std::span<float> positions, const MoveOptions& options, std::uint64_t seed);

/// An edit of a map: receives positions [N x 3], may change them, and returns a mark (1) for each row to remove; empty:
/// no row is removed.
using MapEdit = std::function<std::vector<std::uint8_t>(std::span<float> positions)>;

/// Writes edited copies of the map of Gaussians and of the cloud that the flags name to `folder`, and returns flags
/// that name the copies, so that every method reads the damaged map from a file. The map's header, with its model of
/// sigma, is copied. share: share of points moved or removed, in the map of Gaussians if there is one, else in the
/// cloud.
apps::MapFlags edited_map(const apps::MapFlags& flags, const MapEdit& edit, const std::string& folder, double& share);

}  // namespace odosplat::accuracy
