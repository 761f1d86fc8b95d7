// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "odosplat/odometry/odometry.hpp"
#include "odosplat/splat/rasterizer.hpp"

namespace odosplat::apps {

/// What a method looks at for depth.
enum class ViewKind { gaussians, interpolation, surfels, sensor };

/// A way of localising that has a name: where depth comes from, and what the odometry does with it.
struct MethodPreset {
  const char* name;
  ViewKind view;
  DepthMode depth_mode;  // of Gaussians
  bool anchor;           // keyframes are aligned with the map's rendered colours
  /// true: a point keeps to the world plane that the map shows there, so its depth follows its keyframe's pose; false:
  /// it keeps the depth that it had when its keyframe was rendered.
  bool planes_in_world;
};

/// gaussian       ours: Gaussians, depth by ray planes, planes of the world, anchor
/// paper          the paper's: Gaussians, blended depth as it was when rendered, no anchor
/// interpolation  the paper's ablation: the same with depth interpolated in the cloud (DEMO)
/// surfel         DSL (Ye, Huang, Liu 2020): surfels of the cloud, coplanarity (planes of the world), no anchor
/// rgbd           RGBD-DSO (Yuan et al. 2021): the sensor's depth, which holds for its keyframe only, no anchor
const std::vector<MethodPreset>& method_presets();

/// InputError that lists the names if there is none of that name.
const MethodPreset& method_preset(const std::string& name);

/// "gaussian, paper, ... or rgbd", for help and errors.
std::string method_names();

/// The preset's options, with the anchor as the user wants it if he says so.
OdometryOptions odometry_options(const MethodPreset& preset, std::optional<bool> anchor);

}  // namespace odosplat::apps
