// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "odosplat/odometry/odometry.hpp"
#include "odosplat/splat/raster/rasterizer.hpp"

namespace odosplat::apps {

/// What a method looks at for depth.
enum class ViewKind { gaussians, interpolation, surfels, sensor };

/// A way of localising that has a name: where depth comes from, and what the odometry does with it.
struct MethodPreset {
  const char* name;
  ViewKind view;
  DepthMode depth_mode;  // of Gaussians
  bool anchor;           // keyframes are aligned with the map's rendered colours
  DepthUse depth_use;    // what the window makes of the depth
};

/// gaussian       ours: Gaussians, depth by ray planes as a measurement in the planes of the world, anchor
/// paper          the paper's: Gaussians, blended depth as search interval of +-20 %, then free, no anchor
/// interpolation  the paper's ablation: the same with depth interpolated in the cloud (DEMO)
/// surfel         DSL (Ye, Huang, Liu 2020): surfels of the cloud, coplanarity (planes of the world), no anchor
/// rgbd           RGBD-DSO (Yuan et al. 2021): the sensor's depth starts a point and does not hold it, no anchor
const std::vector<MethodPreset>& method_presets();

/// InputError that lists the names if there is none of that name.
const MethodPreset& method_preset(const std::string& name);

/// "gaussian, paper, ... or rgbd", for help and errors.
std::string method_names();

/// The preset's options, with the anchor as the user wants it if he says so.
OdometryOptions odometry_options(const MethodPreset& preset, std::optional<bool> anchor);

}  // namespace odosplat::apps
