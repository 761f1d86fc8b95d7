// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <vector>

#include "odosplat/synth/motion/path.hpp"
#include "odosplat/synth/render/lighting.hpp"
#include "odosplat/synth/scene/scene.hpp"
#include "odosplat/synth/scene/scene_description.hpp"

namespace odosplat {

/// A small closed room for tests: x 0..4, y 0..3, z 0..2.5 m, every surface with a different strong multi-scale
/// texture, two boxes and a ball in it for occlusion. Unlit: colours do not depend on the view. Takes about half a
/// second.
Scene make_box_room(std::uint64_t seed);

/// The room of a description, with its light (lighting.exposure is replaced by the description's). The seed changes
/// textures, books and pictures, but not the positions of furniture. Takes several seconds to compute the light.
Scene make_scene(const SceneDescription& description, std::uint64_t seed, LightingOptions lighting = {});

/// Scanner poses at the description's lidar positions (scan_places).
std::vector<SE3> scan_poses(const SceneDescription& description);

/// The built-in scene living_room: x 0..6, y 0..4.6, z 0..2.6 m. Daylight through two windows and a lamp, soft shadows.
/// It has furniture, bare walls and thin objects (legs, leaves, a lamp's pole); behind the windows there is sky without
/// depth.
Scene make_living_room(std::uint64_t seed);

/// Waypoints of its walk `demo`, for hand_held_path: 3.6 m, from the television past sofa and windows to the
/// bookshelf, turning by 180 degrees on the way. Needs at least 120 frames at 30 fps; 240 give a slow walk.
std::vector<Waypoint> living_room_walk();
std::vector<SE3> living_room_scan_poses();

}  // namespace odosplat
