// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/render/ray_caster.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/synth/content/patterns.hpp"
#include "odosplat/synth/motion/path.hpp"
#include "odosplat/synth/scene/rooms.hpp"
#include "odosplat/synth/scene/scene_builder.hpp"

namespace odosplat {
namespace {

const Camera camera{160, 120, 131.0, 129.0, 80.3, 58.7};

/// Depth of the plane normal . p = offset along a pixel's ray.
double plane_depth(const SE3& T_world_camera, double u, double v, const Eigen::Vector3d& normal, double offset) {
  const Eigen::Vector3d direction = T_world_camera.rotation_matrix() * camera.ray(u, v);
  return (offset - normal.dot(T_world_camera.translation())) / normal.dot(direction);
}

Scene single_wall(float x) {
  SceneBuilder builder;
  Material material;
  material.texture = builder.add_texture(checker_pattern(64, 2, {0.2F, 0.2F, 0.2F}, {0.8F, 0.8F, 0.8F}), {1.0F, 1.0F});
  const int m = builder.add_material(material);
  // The wall is seen from smaller x: y runs to the left, so the right edge of the image is towards -y.
  builder.add_quad({x, 50.0F, 50.0F}, {0.0F, -100.0F, 0.0F}, {0.0F, 0.0F, -100.0F}, m);
  return builder.build_unlit();
}

TEST(RayCaster, DepthOfAPlaneIsExact) {
  const Scene scene = single_wall(3.0F);
  const SE3 T_world_camera = look_at({0.3, 0.2, 1.5}, {3.0, 0.9, 1.1});
  const Rendering r = render(scene, camera, T_world_camera);
  double worst = 0.0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double expected = plane_depth(T_world_camera, u, v, Eigen::Vector3d::UnitX(), 3.0);
      worst = std::max(worst, std::abs(r.depth(v, u) - expected));
    }
  }
  EXPECT_LT(worst, 1e-5);
}

TEST(RayCaster, DepthInsideARoomIsThatOfTheNearestOfSixPlanes) {
  SceneBuilder builder;
  const int plain = builder.add_plain(0.5F, 0.5F, 0.5F);
  builder.add_box({0.0F, 0.0F, 0.0F}, {4.0F, 3.0F, 2.5F}, plain);
  const Scene scene = builder.build_unlit();
  for (int k = 0; k < 8; ++k) {
    const double angle = 0.8 * k;
    const Eigen::Vector3d eye(2.1, 1.4, 1.3);
    const Eigen::Vector3d target = eye + Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.5 * std::sin(3.0 * k));
    const SE3 T_world_camera = look_at(eye, target);
    RenderOptions options;
    options.color = false;
    const Rendering r = render(scene, camera, T_world_camera, options);
    EXPECT_TRUE(r.color.empty());
    double worst = 0.0;
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        double nearest = 1e9;
        for (int axis = 0; axis < 3; ++axis) {
          for (const double offset : {0.0, axis == 0 ? 4.0 : axis == 1 ? 3.0 : 2.5}) {
            const double z = plane_depth(T_world_camera, u, v, Eigen::Vector3d::Unit(axis), offset);
            if (z > 0.0) nearest = std::min(nearest, z);
          }
        }
        worst = std::max(worst, std::abs(r.depth(v, u) - nearest));
      }
    }
    EXPECT_LT(worst, 1e-5) << "view " << k;
  }
}

TEST(RayCaster, TextureLandsWhereItIsPut) {
  // Tiles of 1 m with two cells: cell borders every half metre from the quad's corner (y = 50, z = 50).
  const Scene scene = single_wall(2.0F);
  const SE3 T_world_camera = look_at({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0});
  const Rendering r = render(scene, camera, T_world_camera);
  int wrong = 0;
  int judged = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d p = T_world_camera * (camera.ray(u, v) * 2.0);
      const double cell_u = (50.0 - p.y()) / 0.5;
      const double cell_v = (50.0 - p.z()) / 0.5;
      const double margin = 0.08;  // of a cell: 5 pixels, for the filter
      if (std::abs(cell_u - std::round(cell_u)) < margin || std::abs(cell_v - std::round(cell_v)) < margin) continue;
      const bool dark = (static_cast<int>(std::floor(cell_u)) + static_cast<int>(std::floor(cell_v))) % 2 == 0;
      ++judged;
      if (std::abs(r.color(v, u)[0] - (dark ? 0.2F : 0.8F)) > 0.01F) ++wrong;
    }
  }
  EXPECT_GT(judged, camera.width * camera.height / 2);
  EXPECT_EQ(wrong, 0);
}

TEST(RayCaster, PlainColorComesBackAsStored) {
  SceneBuilder builder;
  const int m = builder.add_plain(0.25F, 0.5F, 0.75F);
  builder.add_quad({1.0F, 9.0F, 9.0F}, {0.0F, -18.0F, 0.0F}, {0.0F, 0.0F, -18.0F}, m);
  const Rendering r = render(builder.build_unlit(), camera, look_at({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
  for (const cv::Vec3f& c : r.color) {
    ASSERT_NEAR(c[0], 0.25F, 1e-4F);
    ASSERT_NEAR(c[1], 0.5F, 1e-4F);
    ASSERT_NEAR(c[2], 0.75F, 1e-4F);
  }
}

TEST(RayCaster, SameBitsForAnyNumberOfThreads) {
  const Scene scene = make_box_room(3);
  const SE3 T_world_camera = look_at({0.5, 0.5, 1.4}, {2.5, 2.0, 0.8});
  const int before = threads();
  set_threads(1);
  const Rendering a = render(scene, camera, T_world_camera);
  set_threads(2);
  const Rendering b = render(make_box_room(3), camera, T_world_camera);
  set_threads(before);
  EXPECT_EQ(0, cv::norm(a.color, b.color, cv::NORM_INF));
  EXPECT_EQ(0, cv::norm(a.depth, b.depth, cv::NORM_INF));
  const Rendering other = render(make_box_room(4), camera, T_world_camera);
  EXPECT_GT(cv::norm(a.color, other.color, cv::NORM_INF), 0.1);
}

TEST(RayCaster, EdgesAreAveraged) {
  // A dark half plane in front of a bright wall: along the edge the mean of many pixels must correspond to the covered
  // area.
  SceneBuilder builder;
  const int dark = builder.add_plain(0.0F, 0.0F, 0.0F);
  const int bright = builder.add_plain(1.0F, 1.0F, 1.0F);
  builder.add_quad({2.0F, 9.0F, 9.0F}, {0.0F, -18.0F, 0.0F}, {0.0F, 0.0F, -18.0F}, bright);
  builder.add_quad({1.0F, 9.0F, 9.0F}, {0.0F, -8.87F, 0.9F}, {0.0F, 0.0F, -19.0F}, dark);
  RenderOptions options;
  options.samples = 16;
  const Rendering r = render(builder.build_unlit(), camera, look_at({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}), options);
  // The dark part ends at y = 0.13, z arbitrary: u = cx - fx y.
  const double edge = camera.cx - camera.fx * 0.13;
  for (int v = 10; v < 110; v += 10) {
    double covered = 0.0;
    for (int u = 0; u < camera.width; ++u) covered += 1.0 - to_linear(r.color(v, u)[0]);
    EXPECT_NEAR(covered, edge + 0.5, 0.1);
  }
}

TEST(RayCaster, EmptySceneGivesNoDepthAndBlack) {
  SceneBuilder builder;
  const Rendering r = render(builder.build_unlit(), camera, SE3());
  EXPECT_EQ(0, cv::countNonZero(r.depth));
  EXPECT_EQ(0, cv::norm(r.color, cv::NORM_INF));
}

TEST(RayCaster, RefusesWrongInput) {
  SceneBuilder builder;
  const Scene scene = builder.build_unlit();
  RenderOptions options;
  options.samples = 0;
  EXPECT_THROW(render(scene, camera, SE3(), options), InputError);
  Camera broken = camera;
  broken.fx = 0.0;
  EXPECT_THROW(render(scene, broken, SE3()), InputError);
}

}  // namespace
}  // namespace odosplat
