// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <vector>

#include "odosplat/synth/path.hpp"
#include "odosplat/synth/scene.hpp"

namespace odosplat {

/// A small closed room for tests: x 0..4, y 0..3, z 0..2.5 m, every surface with a strong multi-scale texture of its
/// own, two boxes and a ball in it for occlusion. Unlit: colours do not depend on the view. Takes about half a second.
Scene make_box_room(std::uint64_t seed);
/// A furnished living room, x 0..6, y 0..4.6, z 0..2.6 m, floor at z = 0. Daylight through two windows and a lamp,
/// soft shadows, light reflected between surfaces. Beside furniture there are bare walls and thin things (legs, leaves,
/// a lamp's pole); behind the windows there is sky without depth. The seed changes textures, books and pictures, not
/// where the furniture stands. Takes seconds: light is computed here, once.
Scene make_living_room(std::uint64_t seed);

/// A walk through the living room for hand_held_path: 3.6 m, from the television past sofa and windows to the
/// bookshelf, turning by 180 degrees on the way. Takes at least 120 frames at 30 fps; 240 are a calm pace.
std::vector<Waypoint> living_room_walk();

/// Places in the living room from which a lidar sees most of it (what lies behind furniture stays hidden).
std::vector<SE3> living_room_scan_poses();

}  // namespace odosplat
