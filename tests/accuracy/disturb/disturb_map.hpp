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

/// Marks (1) the points that lie in balls of `radius` [m] around points picked at random, ball after ball until at
/// least `share` (0..1) of all are marked. positions [N x 3], flat.
std::vector<std::uint8_t> in_random_balls(std::span<const float> positions, double share, double radius,
                                          std::uint64_t seed);

/// Pieces of a map that were moved about.
struct MoveOptions {
  int pieces = 6;         // fewer where the map has no room for so many
  double edge = 0.7;      // [m] of the cubes that cut them out, around points picked at random, two edges apart
  double distance = 0.3;  // [m] that each is moved as a whole, in a direction of its own
};
/// Moves them. Returns how many points were moved.
std::size_t move_random_pieces(std::span<float> positions, const MoveOptions& options, std::uint64_t seed);

/// What is done to a map: takes positions [N x 3], may move them, and returns a mark (1) for each that goes; empty:
/// none goes.
using MapEdit = std::function<std::vector<std::uint8_t>(std::span<float> positions)>;

/// Writes copies of the map of Gaussians and of the cloud that the flags name, both edited, to `folder`, and returns
/// flags that name the copies: a damaged map is a file like any other, for every method. What the header says of the
/// depth's sigma goes along. share: of the points of the last of them, how many were moved or went.
apps::MapFlags edited_map(const apps::MapFlags& flags, const MapEdit& edit, const std::string& folder, double& share);

}  // namespace odosplat::accuracy
