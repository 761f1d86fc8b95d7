// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/splat/raster_scenes.hpp"

#include <cmath>

#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

void push(Gaussians& g, const Eigen::Vector3d& position, const Eigen::Vector3d& log_scale, const Eigen::Vector4d& wxyz,
          double logit, Random& random) {
  for (int i = 0; i < 3; ++i) g.positions.push_back(static_cast<float>(position[i]));
  for (int i = 0; i < 3; ++i) g.log_scales.push_back(static_cast<float>(log_scale[i]));
  for (int i = 0; i < 4; ++i) g.rotations.push_back(static_cast<float>(wxyz[i]));
  g.opacity_logits.push_back(static_cast<float>(logit));
  for (int k = 0; k < g.coefficients(); ++k) {
    const double size = k == 0 ? 1.2 : 0.4;
    for (int c = 0; c < 3; ++c) g.sh.push_back(static_cast<float>(random.uniform(-size, size)));
  }
}

Eigen::Vector4d random_quaternion(Random& random) {
  return 0.7 * Eigen::Vector4d(random.normal(), random.normal(), random.normal(), random.normal());
}

// Point at depth z on the camera's ray through (u, v), in the world.
Eigen::Vector3d at_pixel(const RasterScene& scene, double u, double v, double z) {
  return scene.T_world_camera * (z * scene.camera.ray(u, v));
}

}  // namespace

Camera odd_camera() {
  Camera camera;
  camera.width = 37;
  camera.height = 29;
  camera.fx = 40.0;
  camera.fy = 43.0;
  camera.cx = 17.3;
  camera.cy = 14.9;
  return camera;
}

SE3 oblique_pose() {
  Vector6d xi;
  xi << 0.3, -0.2, 0.5, 0.4, -0.7, 0.2;
  return SE3::exp(xi);
}

RasterScene overlapping_scene(std::size_t n, int sh_degree, std::uint64_t seed) {
  RasterScene scene{"overlapping", {}, odd_camera(), oblique_pose()};
  scene.gaussians.sh_degree = sh_degree;
  Random random(seed);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d p =
        at_pixel(scene, random.uniform(-5.0, 42.0), random.uniform(-5.0, 34.0), random.uniform(0.8, 4.0));
    const Eigen::Vector3d s(random.uniform(-3.6, -1.8), random.uniform(-3.6, -1.8), random.uniform(-5.5, -2.5));
    push(scene.gaussians, p, s, random_quaternion(random), random.uniform(-3.0, 3.0), random);
  }
  return scene;
}

RasterScene surrounding_scene() {
  RasterScene scene{"surrounding", {}, odd_camera(), oblique_pose()};
  scene.gaussians.sh_degree = 1;
  Random random(5);
  for (int i = 0; i < 120; ++i) {
    // Depths on both sides of the camera's plane, half of them within 0.3 m of it, and positions far to the sides.
    const double z = i % 2 == 0 ? random.uniform(-0.3, 0.3) : random.uniform(-3.0, 3.0);
    const Eigen::Vector3d p(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), z);
    const Eigen::Vector3d s(random.uniform(-4.0, -0.5), random.uniform(-4.0, -0.5), random.uniform(-4.0, -0.5));
    push(scene.gaussians, scene.T_world_camera * p, s, random_quaternion(random), random.uniform(-2.0, 2.0), random);
  }
  return scene;
}

RasterScene needle_scene() {
  RasterScene scene{"needles", {}, odd_camera(), oblique_pose()};
  scene.gaussians.sh_degree = 0;
  Random random(6);
  for (int i = 0; i < 120; ++i) {
    const Eigen::Vector3d p =
        at_pixel(scene, random.uniform(0.0, 36.0), random.uniform(0.0, 28.0), random.uniform(1.0, 4.0));
    const double thin = random.uniform(-8.5, -6.0);
    const Eigen::Vector3d needle(random.uniform(-3.0, -1.0), thin, thin - 0.5);
    const Eigen::Vector3d disc(random.uniform(-3.0, -1.5), random.uniform(-3.0, -1.5), thin);
    push(scene.gaussians, p, i % 2 == 0 ? needle : disc, random_quaternion(random), random.uniform(-1.0, 9.0), random);
  }
  return scene;
}

RasterScene empty_scene() { return {"empty", {}, odd_camera(), oblique_pose()}; }

RasterScene single_scene() {
  RasterScene scene = overlapping_scene(1, 2, 9);
  scene.name = "single";
  const Eigen::Vector3d p = at_pixel(scene, 20.0, 11.0, 2.0);
  for (int i = 0; i < 3; ++i) scene.gaussians.positions[static_cast<std::size_t>(i)] = static_cast<float>(p[i]);
  scene.gaussians.opacity_logits[0] = 1.0f;
  return scene;
}

std::vector<RasterScene> all_scenes() {
  return {overlapping_scene(400, 3, 1),
          overlapping_scene(90, 1, 2),
          surrounding_scene(),
          needle_scene(),
          empty_scene(),
          single_scene()};
}

HostImages render(Rasterizer& rasterizer, const compute::Context& context, const RasterScene& scene,
                  const RenderRequest& request) {
  DeviceGaussians gaussians;
  gaussians.upload(context, scene.gaussians);
  RenderOutput output;
  rasterizer.forward(gaussians, scene.camera, scene.T_world_camera, request, output);
  return {output.color.download(), output.depth.download(), output.alpha.download(), output.sigma.download()};
}

const compute::Context& test_context() {
  static const compute::Context context = compute::Context::open();
  return context;
}

Rasterizer make_rasterizer(Shell shell, bool compensated, DepthKind kind, BlendOrder order) {
  RasterizerOptions options;
  options.shell = shell;
  options.compensated = compensated;
  options.depth_kind = kind;
  options.order = order;
  return Rasterizer(test_context(), options);
}

std::size_t count_different(const std::vector<double>& a, const std::vector<float>& b,
                            const std::vector<double>& margin, double band, double tolerance) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (margin[i % margin.size()] <= band) continue;
    if (!(std::abs(a[i] - static_cast<double>(b[i])) <= tolerance)) ++different;
  }
  return different;
}

}  // namespace odosplat
