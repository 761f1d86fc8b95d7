// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/training_guard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "odosplat/core/error.hpp"
#include "odosplat/splat/train/initialize.hpp"
#include "odosplat/splat/train/trainer.hpp"
#include "tests/splat/corner_scene.hpp"

namespace odosplat {
namespace {

using test::CornerScene;
using test::CornerViews;
using Verdict = TrainingGuard::Verdict;

Verdict judged(TrainingGuard& guard, int level, double psnr_db, int first = 1, int steps = 50) {
  for (int i = 0; i < steps; ++i) guard.add(first + i, level, psnr_db);
  return guard.judge();
}

// Judges repeatedly until a fall counts, or `less` times fewer.
Verdict judged_long(TrainingGuard& guard, int level, double psnr_db, int less = 0) {
  Verdict verdict = Verdict::nothing;
  for (int i = less; i < TrainingGuard::patience; ++i) {
    EXPECT_EQ(verdict, Verdict::nothing);
    verdict = judged(guard, level, psnr_db);
  }
  return verdict;
}

TEST(TrainingGuard, FallsByMoreThanItsLimitAndNoLess) {
  TrainingGuard guard;
  EXPECT_EQ(guard.judge(), Verdict::nothing);
  EXPECT_EQ(judged(guard, 0, 30.0), Verdict::best);
  EXPECT_EQ(judged(guard, 0, 27.2), Verdict::nothing);
  EXPECT_EQ(judged(guard, 0, 31.0), Verdict::best);
  EXPECT_EQ(judged(guard, 0, 5.0, 1, TrainingGuard::least_steps - 1), Verdict::nothing);  // too few steps
  EXPECT_EQ(judged_long(guard, 0, 5.0, 1), Verdict::nothing);
  EXPECT_EQ(judged(guard, 0, 30.0), Verdict::nothing);  // recovered: counting restarts
  EXPECT_EQ(judged_long(guard, 0, 5.0), Verdict::fallen);
  EXPECT_EQ(guard.best_db(), 31.0);
  guard.went_back();
  EXPECT_EQ(judged(guard, 0, std::numeric_limits<double>::quiet_NaN()), Verdict::fallen);
}

TEST(TrainingGuard, FinerLevelStartsAnewUnlessItFellByTwice) {
  TrainingGuard guard;
  EXPECT_EQ(judged(guard, 1, 30.0), Verdict::best);
  TrainingGuard other = guard;
  EXPECT_EQ(judged(guard, 0, 25.0), Verdict::best);
  EXPECT_EQ(judged_long(guard, 0, 21.0), Verdict::fallen);
  EXPECT_EQ(judged_long(other, 0, 23.0), Verdict::fallen);
}

TEST(TrainingGuard, DoesNotWaitAtTheEnd) {
  TrainingGuard guard;
  EXPECT_EQ(judged(guard, 0, 30.0), Verdict::best);
  for (int i = 0; i < 50; ++i) guard.add(51 + i, 0, 20.0);
  EXPECT_EQ(guard.judge(true), Verdict::fallen);
}

TEST(TrainingGuard, WaitsWhilePaused) {
  TrainingGuard guard;
  EXPECT_EQ(judged(guard, 0, 30.0, 1), Verdict::best);
  guard.pause(100);
  EXPECT_EQ(judged(guard, 0, 5.0, 51), Verdict::nothing);
  EXPECT_EQ(judged(guard, 0, 30.5, 101), Verdict::best);
}

TEST(TrainingGuard, StateRoundTripsAndNonsenseIsRefused) {
  TrainingGuard guard;
  judged(guard, 0, 30.0);
  for (int i = 0; i < 10; ++i) guard.add(51 + i, 0, 20.0);
  TrainingGuard other;
  other.set_state(guard.state());
  EXPECT_EQ(other.state(), guard.state());
  for (std::size_t i : {0U, 1U, 3U, 4U, 6U, 7U}) {
    auto state = guard.state();
    state[i] = i == 4 ? std::numeric_limits<double>::infinity() : -7.5;
    EXPECT_THROW(other.set_state(state), InputError) << i;
  }
  EXPECT_THROW(other.set_state({}), InputError);
}

/// Full-size training of the corner whose densification removes nearly all Gaussians.
TrainerOptions destructive_options() {
  TrainerOptions options;
  options.iterations = 700;
  options.coarse_levels = 0;
  options.color_rate = 2e-2;
  options.densify.method = DensifyMethod::split;
  options.densify.from = 100;
  options.densify.interval = 100;
  options.densify.dead_opacity = 0.96;
  return options;
}

TEST(Trainer, StepThatDestroysTheMapIsUndone) {
  const auto context = compute::Context::open();
  const Gaussians initial = gaussians_from_cloud(CornerScene().cloud(0.08), {});
  CornerViews views(4);
  Trainer trainer(context, destructive_options(), initial, views);
  std::set<std::size_t> sizes;
  while (!trainer.done()) {
    trainer.step();
    sizes.insert(trainer.report().gaussians);
  }
  EXPECT_GT(sizes.size(), 1U);  // densification has changed the map
  const TrainingReport report = trainer.report();
  EXPECT_EQ(report.undone, 1);
  EXPECT_EQ(report.iterations, 700);
  EXPECT_EQ(report.gaussians, initial.size());
  EXPECT_GT(report.psnr_db, 24.0);
}

TEST(Trainer, RunThatGoesBackIsResumedWithTheSameBits) {
  const auto context = compute::Context::open();
  const Gaussians initial = gaussians_from_cloud(CornerScene().cloud(0.08), {});
  CornerViews views(4);
  Trainer whole(context, destructive_options(), initial, views);
  while (!whole.done()) whole.step();
  ASSERT_EQ(whole.report().undone, 1);
  for (const int steps : {90, 350, 600}) {  // before, during and after the fall
    Trainer first(context, destructive_options(), initial, views);
    for (int i = 0; i < steps; ++i) first.step();
    Trainer second(context, destructive_options(), initial, views);
    second.resume(first.checkpoint());
    while (!second.done()) second.step();
    EXPECT_EQ(second.gaussians().sh, whole.gaussians().sh) << steps;
    EXPECT_EQ(second.report().undone, 1);
  }
}

/// Views whose images become checkerboards after some time.
class SpoiltViews : public CornerViews {
 public:
  using CornerViews::CornerViews;
  int left = 210;  // number of valid images left
  ColorImage color(int i) override {
    ColorImage image = CornerViews::color(i).clone();
    if (left-- > 0) return image;
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x) image(y, x) = cv::Vec3f::all((x + y + left) % 2 == 0 ? 1.0F : 0.0F);
    return image;
  }
};

TEST(Trainer, FallWithoutDensificationEndsWithTheBest) {
  SpoiltViews views(3);
  TrainerOptions options;
  options.iterations = 1000;
  options.coarse_levels = 0;
  options.color_rate = 2e-2;
  Trainer trainer(compute::Context::open(), options, gaussians_from_cloud(CornerScene().cloud(0.1), {}), views);
  while (!trainer.done()) trainer.step();
  EXPECT_EQ(trainer.report().undone, 1);
  EXPECT_EQ(trainer.iteration(), 200);
}

/// A camera that moves by a few centimetres.
class TripodViews : public test::CornerViews {
 public:
  TripodViews() : CornerViews(4) {
    for (int i = 0; i < 4; ++i) images_.push_back(scene_.color(T_world_camera(i)));
  }
  SE3 T_world_camera(int i) const override {
    const SE3 T = scene_.T_world_camera(0);
    return {T.rotation(), T.translation() + Eigen::Vector3d(0.02 * i, 0.0, 0.0)};
  }
  ColorImage color(int i) override { return images_[static_cast<std::size_t>(i)]; }

 private:
  CornerScene scene_;
  std::vector<ColorImage> images_;
};

// The cameras' extent is 3 cm, and half of it is less than the size of most discs: limits derived from it alone would
// remove nearly all discs.
TEST(Trainer, CameraThatHardlyMovesLeavesTheMapWhole) {
  TripodViews views;
  const Gaussians initial = gaussians_from_cloud(CornerScene().cloud(0.04), {});
  TrainerOptions options = TrainerOptions::preset("default");
  options.iterations = 200;
  options.densify.from = 50;
  options.densify.interval = 50;
  Trainer trainer(compute::Context::open(), options, initial, views);
  while (!trainer.done()) trainer.step();
  EXPECT_EQ(trainer.report().undone, 0);
  EXPECT_GT(trainer.report().gaussians, initial.size() * 9 / 10);
  EXPECT_GT(trainer.report().psnr_db, 30.0);
}

}  // namespace
}  // namespace odosplat
