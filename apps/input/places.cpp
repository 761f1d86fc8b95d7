// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/places.hpp"

#include "odosplat/core/log.hpp"
#include "odosplat/core/near_origin.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "odosplat/splat/map_file.hpp"
#include "odosplat/splat/map_places.hpp"

namespace odosplat::apps {

std::vector<SE3> places_of(const MapFlags& flags, const std::string& file) {
  if (!file.empty()) {
    std::vector<SE3> poses;
    const Trajectory trajectory = read_trajectory(file);
    require_near_origin(file, trajectory);
    for (const StampedPose& pose : trajectory) poses.push_back(pose.T_world_camera);
    return thinned_places(poses);
  }
  if (!flags.map.empty()) {
    std::vector<SE3> places = read_map_header(flags.map).places;
    if (!places.empty()) return places;
  }
  std::vector<SE3> places = sampled_places(read_map_points(flags).cloud.points);
  log_info("the map does not say where it was seen from: " + std::to_string(places.size()) +
           " places are sampled in it; poses of a trajectory (--places) serve better");
  return places;
}

}  // namespace odosplat::apps
