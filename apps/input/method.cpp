// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/method.hpp"

#include "odosplat/core/error.hpp"

namespace odosplat::apps {

const std::vector<MethodPreset>& method_presets() {
  static const std::vector<MethodPreset> presets{
      {"gaussian", ViewKind::gaussians, DepthMode::surface, true, DepthUse::pose_aware_prior},
      {"paper", ViewKind::gaussians, DepthMode::blended, false, DepthUse::interval},
      {"interpolation", ViewKind::interpolation, DepthMode::surface, false, DepthUse::interval},
      {"surfel", ViewKind::surfels, DepthMode::surface, false, DepthUse::pose_aware},
      {"rgbd", ViewKind::sensor, DepthMode::surface, false, DepthUse::free},
  };
  return presets;
}

std::string method_names() {
  std::string names;
  const std::vector<MethodPreset>& presets = method_presets();
  for (std::size_t i = 0; i < presets.size(); ++i) {
    if (i > 0) names += i + 1 < presets.size() ? ", " : " or ";
    names += presets[i].name;
  }
  return names;
}

const MethodPreset& method_preset(const std::string& name) {
  for (const MethodPreset& preset : method_presets()) {
    if (name == preset.name) return preset;
  }
  throw InputError("--method", "must be " + method_names() + ", is " + name);
}

OdometryOptions odometry_options(const MethodPreset& preset, std::optional<bool> anchor) {
  OdometryOptions options;
  options.keyframe.anchor.enabled = anchor.value_or(preset.anchor);
  // Confirmation belongs to method gaussian only: the methods for comparison are run as published, whatever --anchor
  // says.
  options.confirmation.enabled = preset.anchor;
  options.keyframe.window_points.depth_use = preset.depth_use;
  // Without an anchor, the marginal prior of removed keyframes keeps the window at its accumulated drift if points move
  // with their keyframe (docs/rules.md). It would help methods whose planes are fixed in the world, but is off for all
  // of them, to keep the methods comparable.
  options.marginalization.enabled = options.keyframe.anchor.enabled;
  return options;
}

std::unique_ptr<Odometry> start_odometry(const Camera& camera, MapView& map, const OdometryOptions& options,
                                         Relocalizer* relocalizer, const std::optional<SE3>& T_world_camera_start,
                                         bool prepare) {
  if (prepare && T_world_camera_start) map.render(camera, *T_world_camera_start, {true, true});
  if (prepare && relocalizer != nullptr) relocalizer->prepare();
  if (!T_world_camera_start) return std::make_unique<Odometry>(camera, map, options, *relocalizer);
  auto odometry = std::make_unique<Odometry>(camera, map, options, *T_world_camera_start);
  odometry->set_relocalizer(relocalizer);
  return odometry;
}

}  // namespace odosplat::apps
