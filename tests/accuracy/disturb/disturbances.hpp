// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/accuracy/disturb/disturb_map.hpp"
#include "tests/accuracy/play.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace odosplat::accuracy {

/// Strengths of the disturbances of a run.
struct DisturbanceOptions {
  double noise = 8.0;  // [of 255]
  double gamma = 0.6;
  double exposure = 1.5;
  double exposure_seconds = 2.0;
  double blur_px = 5.0;
  double rolling = 0.15;
  double rolling_seconds = 2.0;
  double deleted = 0.2;
  double deleted_radius = 0.3;  // [m]
  MoveOptions moved;
};

/// Names of the disturbances of images ("noise", "gamma", "exposure", "blur", "rolling") and of maps ("deleted",
/// "moved").
const std::vector<std::string>& image_disturbances();
const std::vector<std::string>& map_disturbances();

/// Declares the flags of DisturbanceOptions. options must outlive the command.
void add_disturbance_flags(CLI::App* command, DisturbanceOptions& options);

/// The edit of each frame's image; empty if `name` is not a disturbance of images. world must outlive it.
std::function<ImageEdit(std::size_t frame)> image_disturbance(const std::string& name, const World& world,
                                                              const DisturbanceOptions& options, std::uint64_t seed);

/// The edit of the map; empty if `name` is not a disturbance of maps.
MapEdit map_disturbance(const std::string& name, const DisturbanceOptions& options, std::uint64_t seed);

/// A temporary folder for damaged maps, removed by the destructor.
class DamagedMaps {
 public:
  DamagedMaps();
  ~DamagedMaps();
  DamagedMaps(const DamagedMaps&) = delete;
  DamagedMaps& operator=(const DamagedMaps&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace odosplat::accuracy
