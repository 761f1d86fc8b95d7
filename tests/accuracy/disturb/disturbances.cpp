// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/accuracy/disturb/disturbances.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "apps/command/number_flags.hpp"
#include "tests/accuracy/disturb/disturb_image.hpp"

namespace odosplat::accuracy {

const std::vector<std::string>& image_disturbances() {
  static const std::vector<std::string> names{"noise", "gamma", "exposure", "blur", "rolling"};
  return names;
}

const std::vector<std::string>& map_disturbances() {
  static const std::vector<std::string> names{"deleted", "moved"};
  return names;
}

void add_disturbance_flags(CLI::App* command, DisturbanceOptions& options) {
  apps::add_number(command, "--noise", options.noise, {.least = 0.0, .most = 255.0},
                   "standard deviation of the noise [grey levels of 255]");
  apps::add_number(command, "--gamma", options.gamma, {.least = 0.1, .most = 10.0}, "exponent of the brightness");
  apps::add_number(command, "--exposure", options.exposure, {.least = 0.1, .most = 10.0},
                   "factor of an exposure step: 1, F, 1, 1/F and so on");
  apps::add_number(command, "--exposure-seconds", options.exposure_seconds, {.least = 0.01, .most = 1000.0},
                   "time between steps [s]");
  apps::add_number(command, "--blur", options.blur_px, {.least = 0.1, .most = 100.0}, "length of the motion blur [px]");
  apps::add_number(command, "--rolling", options.rolling, {.least = 0.0, .most = 0.9}, "amplitude of the rolling gain");
  apps::add_number(command, "--rolling-seconds", options.rolling_seconds, {.least = 0.01, .most = 1000.0},
                   "time in which it goes once over the image [s]");
  apps::add_number(command, "--deleted", options.deleted, {.least = 0.0, .most = 0.95},
                   "share of the map that is deleted");
  apps::add_number(command, "--deleted-radius", options.deleted_radius, {.least = 0.01, .most = 100.0},
                   "radius of the balls deleted [m]");
  apps::add_number(command, "--pieces", options.moved.pieces, {.least = 0, .most = 1000}, "pieces of the map moved");
  apps::add_number(command, "--piece-edge", options.moved.edge, {.least = 0.01, .most = 100.0},
                   "edge of the cubes that cut them out [m]");
  apps::add_number(command, "--piece-distance", options.moved.distance, {.least = 0.0, .most = 100.0},
                   "how far each is moved [m]");
}

std::function<ImageEdit(std::size_t frame)> image_disturbance(const std::string& name, const World& world,
                                                              const DisturbanceOptions& options, std::uint64_t seed) {
  if (name == "noise") {
    return [options, seed](std::size_t frame) -> ImageEdit {
      const std::uint64_t frame_seed = seed + 0x9E3779B97F4A7C15ULL * (frame + 1);
      return [options, frame_seed](const GrayImage& image) {
        return with_noise(image, options.noise / 255.0, frame_seed);
      };
    };
  }
  if (name == "gamma") {
    return [options](std::size_t) -> ImageEdit {
      return [options](const GrayImage& image) { return with_gamma(image, options.gamma); };
    };
  }
  if (name == "exposure") {
    return [options, &world](std::size_t frame) -> ImageEdit {
      const double gain = exposure_gain(world.time(frame) - world.time(0), options.exposure, options.exposure_seconds);
      return [gain](const GrayImage& image) { return with_gain(image, gain); };
    };
  }
  if (name == "blur") {
    return [options, &world](std::size_t frame) -> ImageEdit {
      constexpr double depth = 2.0;
      const SE3 before = world.T_world_camera(frame > 0 ? frame - 1 : frame);
      const SE3 after = world.T_world_camera(std::min(frame + 1, world.size() - 1));
      const Eigen::Vector2d direction = center_motion(world.camera(), before, after, depth);
      return
          [options, direction](const GrayImage& image) { return with_motion_blur(image, direction, options.blur_px); };
    };
  }
  if (name == "rolling") {
    return [options, &world](std::size_t frame) -> ImageEdit {
      const double phase = (world.time(frame) - world.time(0)) / options.rolling_seconds;
      return [options, phase](const GrayImage& image) { return with_rolling_gain(image, options.rolling, phase); };
    };
  }
  return {};
}

MapEdit map_disturbance(const std::string& name, const DisturbanceOptions& options, std::uint64_t seed) {
  if (name == "deleted") {
    return [options, seed](std::span<float> p) {
      return in_random_balls(p, options.deleted, options.deleted_radius, seed);
    };
  }
  if (name == "moved") {
    return [options, seed](std::span<float> p) {
      move_random_pieces(p, options.moved, seed);
      return std::vector<std::uint8_t>();
    };
  }
  return {};
}

DamagedMaps::DamagedMaps()
    : path_((std::filesystem::temp_directory_path() / ("odosplat_accuracy." + std::to_string(getpid()))).string()) {
  std::filesystem::create_directories(path_);
}

DamagedMaps::~DamagedMaps() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace odosplat::accuracy
