// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/bench/bench_scene.hpp"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/splat/map_file.hpp"

namespace odosplat {
namespace {

Camera bench_camera(int width, int height) {
  const double f = 525.0 * width / 640.0;
  return {width, height, f, f, 0.5 * width - 0.5, 0.5 * height - 0.5};
}

SE3 pose_from_environment() {
  const char* text = std::getenv("ODOSPLAT_BENCH_POSE");
  if (text == nullptr) return SE3();
  std::istringstream in(text);
  Eigen::Vector3d t;
  Eigen::Vector4d q;
  for (double& v : t) in >> v;
  for (double& v : q) in >> v;
  if (!in || q.norm() < 1e-6)
    throw InputError("ODOSPLAT_BENCH_POSE", "must be tx ty tz qx qy qz qw, is " + std::string(text));
  return {Eigen::Quaterniond(q).normalized(), t};
}

}  // namespace

BenchScene random_scene(std::size_t n, int width, int height) {
  BenchScene scene{{}, bench_camera(width, height), SE3()};
  const Camera& camera = scene.camera;
  Random random(1);
  Gaussians& g = scene.gaussians;
  g.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double z = random.uniform(1.0, 5.0);
    const Eigen::Vector3d p =
        z * camera.ray(random.uniform(-0.5, camera.width - 0.5), random.uniform(-0.5, camera.height - 0.5));
    for (int k = 0; k < 3; ++k) {
      g.positions[3 * i + static_cast<std::size_t>(k)] = static_cast<float>(p[k]);
      g.log_scales[3 * i + static_cast<std::size_t>(k)] = static_cast<float>(std::log(2.0 * z / camera.fx));
      g.sh[3 * i + static_cast<std::size_t>(k)] = static_cast<float>(random.uniform(-1.0, 1.0));
    }
    g.rotations[4 * i] = 1.0F;
    g.opacity_logits[i] = 0.0F;
  }
  return scene;
}

std::optional<BenchScene> map_scene(int width, int height) {
  const char* path = std::getenv("ODOSPLAT_BENCH_MAP");
  if (path == nullptr) return std::nullopt;
  return BenchScene{read_map(path).gaussians, bench_camera(width, height), pose_from_environment()};
}

}  // namespace odosplat
