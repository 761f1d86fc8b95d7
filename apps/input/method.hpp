// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/odometry/odometry.hpp"
#include "odosplat/odometry/relocalise/relocalizer.hpp"
#include "odosplat/splat/raster/rasterizer.hpp"

namespace odosplat::apps {

/// Source of depth of a method.
enum class ViewKind { gaussians, interpolation, surfels, sensor };

/// A named method: its source of depth and how the odometry uses it.
struct MethodPreset {
  const char* name;
  ViewKind view;
  DepthMode depth_mode;  // of Gaussians
  bool anchor;           // align keyframes with the map's rendered colours
  DepthUse depth_use;    // how the window uses the depth
};

/// Name, source of depth, use of the depth in the window, anchor:
/// gaussian       this project's: Gaussians, depth by ray planes; prior that keeps the planes in the world; anchor
/// paper          the paper's: Gaussians, blended depth; search interval of +-20 %, then free; no anchor
/// interpolation  the paper's ablation (DEMO): depth interpolated in the cloud; otherwise as paper
/// surfel         DSL (Ye, Huang, Liu 2020): surfels of the cloud; coplanarity (planes fixed in the world); no anchor
/// rgbd           RGBD-DSO (Yuan et al. 2021): the sensor's depth; as initial value without prior; no anchor
const std::vector<MethodPreset>& method_presets();

/// InputError that lists the names if there is none of that name.
const MethodPreset& method_preset(const std::string& name);

/// "gaussian, paper, ... or rgbd", for help and error messages.
std::string method_names();

/// Options of the preset, with the anchor switched on or off if `anchor` has a value.
OdometryOptions odometry_options(const MethodPreset& preset, std::optional<bool> anchor);

/// The odometry from a start pose, or, without one, from where the relocaliser finds the first images; then it must not
/// be null. prepare: what the first image would wait for (the device's programs, the rendering of all places) is done
/// here, because in real time images would be dropped meanwhile. All but the options must outlive the result.
std::unique_ptr<Odometry> start_odometry(const Camera& camera, MapView& map, const OdometryOptions& options,
                                         Relocalizer* relocalizer, const std::optional<SE3>& T_world_camera_start,
                                         bool prepare);

}  // namespace odosplat::apps
