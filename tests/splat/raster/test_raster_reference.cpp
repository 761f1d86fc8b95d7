// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The double-precision reference itself: its gradients compared with finite differences of its images, with fixed
// decisions.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "odosplat/core/random.hpp"
#include "tests/splat/raster_scenes.hpp"

namespace odosplat {
namespace {

using reference::Decisions;
using reference::ImageGradients;
using reference::Images;
using reference::Scene;
using reference::Splat;

double inner(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

struct Setting {
  RasterScene scene;
  DepthMode mode;
  bool compensated;
  DepthKind kind = DepthKind::automatic;
};

class ReferenceGradient : public testing::TestWithParam<int> {};

Setting setting(int index) {
  switch (index) {
    case 0:
      return {overlapping_scene(25, 3, 21), DepthMode::expected, false};
    case 1:
      return {overlapping_scene(25, 2, 22), DepthMode::median, true};
    case 2:
      return {overlapping_scene(25, 1, 23), DepthMode::blended, true};
    case 3:
      return {overlapping_scene(25, 0, 24), DepthMode::expected, true, DepthKind::centre};
    case 4:
      return {overlapping_scene(25, 0, 25), DepthMode::blended, false, DepthKind::ray_plane};
    default:
      return {surrounding_scene(), DepthMode::expected, false};
  }
}

TEST_P(ReferenceGradient, EqualsFiniteDifferences) {
  const Setting s = setting(GetParam());
  const Camera& camera = s.scene.camera;
  RenderRequest request;
  request.depth_mode = s.mode;
  RasterizerOptions options;
  options.compensated = s.compensated;
  options.depth_kind = s.kind;
  const Scene scene(s.scene.gaussians);
  const std::vector<Splat> splats = reference::project(scene, camera, s.scene.T_world_camera, options, request);
  Decisions decisions;
  const Images images = reference::composite(splats, camera, request, nullptr, &decisions);
  Random random(31);
  ImageGradients given;
  given.color.resize(images.color.size());
  given.depth.resize(images.depth.size());
  given.alpha.resize(images.alpha.size());
  for (auto* image : {&given.color, &given.depth, &given.alpha}) {
    for (double& v : *image) v = random.uniform(-1.0, 1.0);
  }
  const auto loss = [&](const Scene& at, const SE3& T_world_camera) {
    const Images out = reference::composite(reference::project(at, camera, T_world_camera, options, request), camera,
                                            request, &decisions);
    return inner(out.color, given.color) + inner(out.depth, given.depth) + inner(out.alpha, given.alpha);
  };
  const reference::Gradients gradients = reference::project_backward(
      scene, splats, request, reference::composite_backward(splats, camera, request, decisions, given));

  const auto check = [&](const char* what, std::vector<double> Scene::*member) {
    const std::vector<double>& analytic = gradients.scene.*member;
    double size = 1e-3;
    for (double v : analytic) size = std::max(size, std::abs(v));
    for (std::size_t i = 0; i < analytic.size(); i += 1 + analytic.size() / 40) {
      const double h = 1e-5;
      Scene plus = scene, minus = scene;
      (plus.*member)[i] += h;
      (minus.*member)[i] -= h;
      const double numeric = (loss(plus, s.scene.T_world_camera) - loss(minus, s.scene.T_world_camera)) / (2.0 * h);
      EXPECT_NEAR(analytic[i], numeric, 1e-5 * size + 1e-4 * std::abs(numeric)) << what << " " << i;
    }
  };
  check("position", &Scene::positions);
  check("log scale", &Scene::log_scales);
  check("rotation", &Scene::rotations);
  check("opacity", &Scene::opacity_logits);
  check("sh", &Scene::sh);
  for (int i = 0; i < 6; ++i) {
    const double h = 1e-6;
    Vector6d xi = Vector6d::Zero();
    xi[i] = h;
    const SE3 T_camera_world = s.scene.T_world_camera.inverse();
    const double numeric = (loss(scene, (SE3::exp(xi) * T_camera_world).inverse()) -
                            loss(scene, (SE3::exp(-xi) * T_camera_world).inverse())) /
                           (2.0 * h);
    EXPECT_NEAR(gradients.pose[i], numeric, 1e-5 * gradients.pose.norm() + 1e-4 * std::abs(numeric)) << "pose " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Settings, ReferenceGradient, testing::Range(0, 6));

TEST(RasterReference, ShOfDegreeOneAndTwoHaveThePublishedForm) {
  // Signs and order of the 3DGS map format: degree 1 is (-y, z, -x), coefficient 6 is 2 zz - xx - yy.
  RasterScene scene = overlapping_scene(5, 2, 8);
  const std::vector<Splat> splats =
      reference::project(Scene(scene.gaussians), scene.camera, scene.T_world_camera, {}, {});
  for (std::size_t g = 0; g < splats.size(); ++g) {
    Eigen::Vector3d d(scene.gaussians.positions[3 * g], scene.gaussians.positions[3 * g + 1],
                      scene.gaussians.positions[3 * g + 2]);
    d = (d - scene.T_world_camera.translation()).normalized();
    EXPECT_NEAR(splats[g].basis[0], 0.28209479177387814, 1e-12);
    EXPECT_NEAR(splats[g].basis[1], -0.4886025119029199 * d.y(), 1e-12);
    EXPECT_NEAR(splats[g].basis[2], 0.4886025119029199 * d.z(), 1e-12);
    EXPECT_NEAR(splats[g].basis[3], -0.4886025119029199 * d.x(), 1e-12);
    EXPECT_NEAR(splats[g].basis[5], -1.0925484305920792 * d.y() * d.z(), 1e-12);
    EXPECT_NEAR(splats[g].basis[6], 0.31539156525252005 * (3.0 * d.z() * d.z() - 1.0), 1e-12);
  }
}

}  // namespace
}  // namespace odosplat
