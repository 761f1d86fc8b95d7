// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "odosplat/synth/motion/walk.hpp"

namespace odosplat {

/// Numbers by name, each a list: {"size": {0.9, 0.45}}.
using Numbers = std::map<std::string, std::vector<float>>;

/// The appearance of a surface: `pattern` is a row of material_patterns(), `numbers` has the parameters of that pattern
/// and those of every material.
struct MaterialDescription {
  std::string name;
  std::string pattern;
  Numbers numbers;
};

/// A piece of furniture in the room: `kind` is a row of furniture_kinds(), which defines its parameters and materials.
struct FurnitureDescription {
  std::string kind;
  Eigen::Vector3f at = Eigen::Vector3f::Zero();  // [m]
  float turn_deg = 0.0F;                         // about the vertical, counter-clockwise from above
  Numbers numbers;
  std::map<std::string, std::string> materials;  // by their place on the piece
};

/// A window: a hole in a wall with a frame in it. `at` is the distance from the wall's left end, as seen from inside.
struct WindowDescription {
  float at = 0.0F;                                     // [m]
  float width = 1.0F;                                  // [m]
  float sill = 0.9F;                                   // [m] above the floor
  float height = 1.3F;                                 // [m]
  float depth = 0.16F;                                 // [m] of the reveal
  Eigen::Vector3f daylight = Eigen::Vector3f::Ones();  // radiance of the incoming light
  std::string frame;                                   // material
};

struct WallDescription {
  std::string material;
  std::vector<WindowDescription> windows;
};

/// Image degradations of the camera of a walk; all but the noise are off by default. Command-line flags override them.
struct SensorCharacter {
  double noise = 0.004;         // standard deviation of a channel (0..1)
  double exposure_swing = 0.0;  // amplitude of gain changes, as a share of the gain
  double shutter_ms = 0.0;      // exposure time
  double readout_ms = 0.0;      // from the first row to the last
};

struct WalkDescription {
  std::string name;
  WalkOptions options;
  std::vector<Waypoint> waypoints;
  SensorCharacter sensor;
};

/// The description of a room: x 0..size.x, y 0..size.y, floor at z = 0. Metres.
struct SceneDescription {
  enum Wall { west, east, south, north };  // x = 0, x = size.x, y = 0, y = size.y

  std::string name;
  Eigen::Vector3f size = Eigen::Vector3f::Ones();
  std::string floor, ceiling, skirting;  // materials; an empty skirting: none
  std::array<WallDescription, 4> walls;
  float sky_radiance = 1.0F;
  float exposure = 1.0F;
  std::vector<MaterialDescription> materials;
  std::vector<FurnitureDescription> furniture;
  std::vector<Eigen::Vector3d> scan_places;
  std::vector<WalkDescription> walks;

  /// The walk of that name; throws InputError listing the existing walks if there is none.
  const WalkDescription& walk(const std::string& walk_name) const;
};

/// Parses a description (YAML; the files of data/scenes show every key). Everything is checked here: throws
/// InputError(`name`, key, fault) for a key that is missing, unknown or of another type, a number out of range, or an
/// unknown material, pattern or kind. The built-in scenes need no file at run time.
SceneDescription parse_scene(const std::string& name, const std::string& text);

/// Names of the built-in scenes, in order: the files of data/scenes, which are embedded in the library.
std::vector<std::string> built_in_scenes();
/// Text of a built-in scene; throws InputError listing them if there is none of that name.
std::string_view built_in_scene_text(const std::string& name);
SceneDescription built_in_scene(const std::string& name);

}  // namespace odosplat
