// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/edit/crop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "odosplat/core/error.hpp"
#include "odosplat/splat/gaussian_view.hpp"
#include "odosplat/splat/kept_gaussians.hpp"
#include "tests/splat/corner_scene.hpp"
#include "tests/splat/edit/room_map.hpp"

namespace odosplat {
namespace {

using testing::HasSubstr;

std::size_t count(const std::vector<bool>& keep) {
  return static_cast<std::size_t>(std::count(keep.begin(), keep.end(), true));
}

TEST(KeptGaussians, AreThoseAskedForWithAllTheirValues) {
  const Gaussians all = test::room_map().gaussians;
  std::vector<bool> keep(all.size(), false);
  keep[3] = keep[10] = true;
  const Gaussians kept = kept_gaussians(all, keep);
  kept.check();
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(test::centre(kept, 1), test::centre(all, 10));
  EXPECT_EQ(kept.opacity_logits[0], all.opacity_logits[3]);
  EXPECT_EQ(kept.log_scales[5], all.log_scales[32]);
  EXPECT_EQ(kept.rotations[7], all.rotations[43]);
  EXPECT_EQ(kept.sh[kept.sh.size() / 2], all.sh[10 * 12]);
  EXPECT_THROW(kept_gaussians(all, {true}), InputError);
}

TEST(KeptGaussians, LookTheSameWithMoreHarmonics) {
  Gaussians few = test::room_map().gaussians;
  const Gaussians many = with_sh_degree(few, 3);
  many.check();
  EXPECT_EQ(many.sh[48 * 5], few.sh[12 * 5]);
  EXPECT_EQ(many.sh[48 * 5 + 11], few.sh[12 * 5 + 11]);
  EXPECT_EQ(many.sh[48 * 5 + 12], 0.0F);
  EXPECT_THROW(with_sh_degree(many, 1), InputError);
  const std::size_t n = few.size();
  append_gaussians(few, many);
  few.check();
  EXPECT_EQ(few.size(), 2 * n);
  EXPECT_EQ(few.sh_degree, 3);
  EXPECT_EQ(few.sh[48 * 5], few.sh[48 * (n + 5)]);
}

TEST(CropBox, PutsEveryGaussianOnOneSide) {
  const Gaussians room = test::room_map().gaussians;
  const CropBox box{{-1.0, -1.0, -1.0}, {2.0, 4.0, 4.0}, SE3()};
  const std::vector<bool> inside = in_box(room, box);
  EXPECT_GT(count(inside), room.size() / 4);
  EXPECT_LT(count(inside), room.size() * 3 / 4);
  for (std::size_t i = 0; i < room.size(); ++i) EXPECT_EQ(inside[i], test::centre(room, i).x() <= 2.0F);
}

TEST(CropBox, StandsAsItsPoseSays) {
  // A quarter turn about z and a shift: the box's x is the world's y.
  const SE3 T_world_box(so3_exp({0.0, 0.0, 1.5707963267948966}), {1.0, 0.0, 0.0});
  const CropBox box{{0.0, -0.5, 0.0}, {3.0, 0.5, 1.0}, T_world_box};
  EXPECT_TRUE(box.contains({0.6, 2.5, 0.5}));
  EXPECT_TRUE(box.contains({1.4, 0.1, 0.9}));
  EXPECT_FALSE(box.contains({2.5, 0.2, 0.5}));
  EXPECT_FALSE(box.contains({1.0, -0.1, 0.5}));
  EXPECT_THROW(in_box({}, {{0, 0, 0}, {1, 0, 1}, SE3()}), InputError);
}

TEST(ViewWeights, AddUpToTheImagesAlpha) {
  const Map room = test::room_map();
  const auto context = compute::Context::open();
  const EditView& view = test::room_views()[5];
  ViewWeights weights(context, room.gaussians, room.header.rasterizer);
  const std::vector<float> w = weights.in(view.camera, view.T_world_camera);
  GaussianView drawn(context, room);
  const cv::Mat1f alpha = drawn.render(view.camera, view.T_world_camera, {false, true}).alpha;
  const double sum = std::accumulate(w.begin(), w.end(), 0.0);
  double pixels = 0.0;
  for (const float a : alpha) pixels += static_cast<double>(a);
  EXPECT_NEAR(sum, pixels, 1e-3 * pixels);
  EXPECT_EQ(weights.in(view.camera, view.T_world_camera), w);
  EXPECT_TRUE(ViewWeights(context, {}, {}).in(view.camera, view.T_world_camera).empty());
}

TEST(SeenBy, LeavesOutWhatIsHiddenOrOutsideAndTheViewsUnchanged) {
  Map room = test::room_map();
  const std::size_t n = room.gaussians.size();
  // Walls of an untrained map let light through.
  for (std::size_t i = 0; i < n; ++i) {
    room.gaussians.opacity_logits[i] = 4.0F;
    for (std::size_t a = 0; a < 2; ++a) room.gaussians.log_scales[3 * i + a] += 0.5F;
  }
  for (int k = 0; k < 50; ++k) {
    const float y = 0.5F + 0.04F * static_cast<float>(k);
    test::add_ball(room.gaussians, {4.6F, y, 1.2F}, 0.02F, 0.9F);  // behind the wall x = 4
  }
  const auto context = compute::Context::open();
  const std::vector<EditView> views(test::room_views().begin(), test::room_views().begin() + 4);
  const std::vector<bool> seen = seen_by(context, room.gaussians, room.header.rasterizer, views, 0.0);
  EXPECT_EQ(std::count(seen.begin() + static_cast<std::ptrdiff_t>(n), seen.end(), true), 0);
  EXPECT_GT(count(seen), n / 10);
  EXPECT_LT(count(seen), n * 2 / 3);
  EXPECT_EQ(seen_by(context, room.gaussians, room.header.rasterizer, views, 0.0), seen);
  const Map cropped{kept_gaussians(room.gaussians, seen), room.header};
  GaussianView before(context, room);
  GaussianView after(context, cropped);
  for (const EditView& view : views) {
    const ViewImages a = before.render(view.camera, view.T_world_camera, {true, false});
    const ViewImages b = after.render(view.camera, view.T_world_camera, {true, false});
    EXPECT_GT(test::psnr_db(b.color, a.color), 45.0);
  }
  const std::vector<bool> wider = seen_by(context, room.gaussians, room.header.rasterizer, views, 0.15);
  EXPECT_GT(count(wider), count(seen));
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_TRUE(!seen[i] || wider[i]);
  EXPECT_EQ(count(seen_by(context, room.gaussians, {}, {}, 1.0)), 0U);
  EXPECT_THROW(seen_by(context, room.gaussians, {}, views, -1.0), InputError);
}

}  // namespace
}  // namespace odosplat
