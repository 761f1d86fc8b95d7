// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/map/interpolation_view.hpp"
#include "odosplat/splat/gaussian_view.hpp"
#include "odosplat/splat/train/initialize.hpp"
#include "odosplat/splat/train/trainer.hpp"
#include "tests/splat/corner_scene.hpp"

namespace odosplat {
namespace {

using test::CornerScene;
using test::CornerViews;

/// Discs on the corner with all colours grey, so that the colours have to be learnt.
Gaussians grey_corner(double spacing) {
  PointCloud cloud = CornerScene().cloud(spacing);
  cloud.colors.clear();
  return gaussians_from_cloud(cloud, {});
}

TrainerOptions short_options(int iterations) {
  TrainerOptions options;
  options.iterations = iterations;
  options.sh_interval = iterations / 4;
  options.color_rate = 2e-2;
  return options;
}

Gaussians train(int iterations, std::uint64_t seed) {
  CornerViews views(5);
  TrainerOptions options = short_options(iterations);
  options.seed = seed;
  Trainer trainer(compute::Context::open(), options, grey_corner(0.06), views);
  while (!trainer.done()) trainer.step();
  return trainer.gaussians();
}

/// FNV-1a hash of the bits of all attributes.
std::uint64_t hash(const Gaussians& g) {
  std::uint64_t h = 0xcbf29ce484222325ULL;
  for (const auto* part : {&g.positions, &g.log_scales, &g.rotations, &g.opacity_logits, &g.sh}) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(part->data());
    for (std::size_t i = 0; i < part->size() * sizeof(float); ++i) h = (h ^ bytes[i]) * 0x100000001b3ULL;
  }
  return h;
}

double median_error(const DepthImage& depth, const DepthImage& truth) {
  std::vector<float> errors;
  for (int y = 0; y < truth.rows; ++y)
    for (int x = 0; x < truth.cols; ++x)
      if (depth(y, x) > 0.0F && truth(y, x) > 0.0F) errors.push_back(std::abs(depth(y, x) - truth(y, x)));
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return static_cast<double>(*middle);
}

TEST(Trainer, LearnsColourAndKeepsDepth) {
  const CornerScene scene;
  const auto context = compute::Context::open();
  CornerViews views(6);
  const Gaussians initial = grey_corner(0.04);
  InterpolationView surface(CornerScene().cloud(0.04));
  Trainer trainer(context, short_options(180), initial, views, &surface);
  double first = 0.0;
  double last = 0.0;
  while (!trainer.done()) {
    const TrainingStep step = trainer.step();
    ASSERT_TRUE(std::isfinite(step.value.loss));
    if (step.iteration <= 6) first += step.value.loss / 6.0;
    if (step.iteration > 174) last += step.value.loss / 6.0;
  }
  EXPECT_LT(last, 0.25 * first);

  // Evaluated at a pose between the training poses.
  const SE3 T_world_camera = scene.T_world_camera(5);
  const auto before =
      GaussianView(context, initial, GaussianViewOptions()).render(scene.camera, T_world_camera, {true, false});
  const auto after = GaussianView(context, trainer.gaussians(), GaussianViewOptions())
                         .render(scene.camera, T_world_camera, {true, false});
  const ColorImage color = scene.color(T_world_camera);
  EXPECT_GT(test::psnr_db(after.color, color), test::psnr_db(before.color, color) + 8.0);
  EXPECT_GT(test::psnr_db(after.color, color), 24.0);
  double valid_before = 0.0;
  double valid_after = 0.0;
  const DepthImage truth = scene.depth(T_world_camera);
  const double rmse_before = test::depth_rmse(before.depth, truth, valid_before);
  const double rmse_after = test::depth_rmse(after.depth, truth, valid_after);
  // Half of this small image is within a disc's size of the edge between wall and floor, where discs of one colour
  // grow.
  EXPECT_LT(rmse_after, 1.3 * rmse_before);
  EXPECT_LT(median_error(after.depth, truth), 0.0015);
  EXPECT_GE(valid_after, valid_before - 0.002);

  const TrainingReport report = trainer.report();
  EXPECT_EQ(report.iterations, 180);
  EXPECT_EQ(report.gaussians, initial.size());
  EXPECT_GT(report.psnr_db, 24.0);
  EXPECT_GT(report.seconds, 0.0);
  EXPECT_NEAR(report.iterations_per_second * report.seconds, 180.0, 1e-6);
}

// Discs that start 4 mm in front of the wall, an error that colours alone hardly show.
TEST(Trainer, DepthTermBringsDepthToTheSurface) {
  const CornerScene scene;
  const auto context = compute::Context::open();
  CornerViews views(6);
  const PointCloud cloud = scene.cloud(0.05);
  Gaussians initial = gaussians_from_cloud(cloud, {});
  for (std::size_t i = 0; i < initial.size(); ++i)
    for (std::size_t a = 0; a < 3; ++a)
      initial.positions[3 * i + a] += 0.004F * cloud.normals[i][static_cast<Eigen::Index>(a)];
  InterpolationView surface(cloud);
  double error[2] = {0.0, 0.0};
  for (const bool with_surface : {false, true}) {
    Trainer trainer(context, short_options(240), initial, views, with_surface ? &surface : nullptr);
    while (!trainer.done()) trainer.step();
    EXPECT_EQ(trainer.report().depth_error > 0.0, with_surface);
    GaussianView view(context, trainer.gaussians(), GaussianViewOptions());
    for (int k = 1; k < 10; k += 2) {
      const SE3 T_world_camera = scene.T_world_camera(k);
      error[with_surface] +=
          0.2 * median_error(view.render(scene.camera, T_world_camera, {}).depth, scene.depth(T_world_camera));
    }
  }
  EXPECT_LT(error[1], 0.5 * error[0]);
}

TEST(Trainer, SameSeedSameBits) {
  const std::uint64_t one = hash(train(24, 42));
  EXPECT_EQ(one, hash(train(24, 42)));
  EXPECT_NE(one, hash(train(24, 43)));
}

// Run by ThreadsDoNotChangeBits in a separate process, because PoCL reads its number of threads only once.
TEST(Trainer, DISABLED_PrintsHash) {
  std::printf("hash=%016llx\n", static_cast<unsigned long long>(hash(train(24, 42))));
}

TEST(Trainer, ThreadsDoNotChangeBits) {
  std::array<char, 4096> program{};
  ASSERT_GT(readlink("/proc/self/exe", program.data(), program.size() - 1), 0);
  std::vector<std::string> hashes;
  for (const std::string threads : {"1", "3"}) {
    const std::string command = "POCL_MAX_PTHREAD_COUNT=" + threads + " \"" + program.data() +
                                "\" --gtest_also_run_disabled_tests --gtest_filter=Trainer.DISABLED_PrintsHash";
    FILE* pipe = popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::array<char, 512> line{};
    while (fgets(line.data(), line.size(), pipe) != nullptr)
      if (std::string(line.data()).starts_with("hash=")) hashes.emplace_back(line.data());
    EXPECT_EQ(pclose(pipe), 0);
  }
  ASSERT_EQ(hashes.size(), 2U);
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Trainer, EveryRoundSeesEachViewOnce) {
  CornerViews views(5);
  Trainer trainer(compute::Context::open(), short_options(15), grey_corner(0.15), views);
  std::vector<std::vector<int>> rounds(3);
  while (!trainer.done()) {
    const TrainingStep step = trainer.step();
    rounds[static_cast<std::size_t>((step.iteration - 1) / 5)].push_back(step.view);
  }
  for (const auto& round : rounds) EXPECT_THAT(round, testing::UnorderedElementsAre(0, 1, 2, 3, 4));
  EXPECT_TRUE(rounds[0] != rounds[1] || rounds[1] != rounds[2]);
}

TEST(Trainer, GoesFromCoarseToFine) {
  CornerViews views(2);
  TrainerOptions options = short_options(10);
  options.coarse_levels = 2;
  options.coarse_share = 0.4F;
  Trainer trainer(compute::Context::open(), options, grey_corner(0.15), views);
  std::vector<int> levels;
  while (!trainer.done()) levels.push_back(trainer.step().level);
  EXPECT_THAT(levels, testing::ElementsAre(2, 2, 1, 1, 0, 0, 0, 0, 0, 0));
}

TEST(Trainer, KeepsThicknessOfDiscs) {
  CornerViews views(2);
  const Gaussians initial = grey_corner(0.1);
  Trainer trainer(compute::Context::open(), short_options(6), initial, views);
  while (!trainer.done()) trainer.step();
  const Gaussians trained = trainer.gaussians();
  bool moved = false;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    EXPECT_EQ(trained.log_scales[3 * i + 2], initial.log_scales[3 * i + 2]);
    moved = moved || trained.log_scales[3 * i] != initial.log_scales[3 * i];
  }
  EXPECT_TRUE(moved);
}

TEST(Trainer, GrowthIsLimited) {
  CornerViews views(2);
  const Gaussians initial = grey_corner(0.1);
  TrainerOptions options = short_options(40);
  options.scale_rate = 5e-2;
  options.largest_growth = 1.2;
  Trainer trainer(compute::Context::open(), options, initial, views);
  while (!trainer.done()) trainer.step();
  const Gaussians trained = trainer.gaussians();
  float most = 0.0F;
  for (std::size_t i = 0; i < initial.log_scales.size(); ++i)
    most = std::max(most, trained.log_scales[i] - initial.log_scales[i]);
  EXPECT_NEAR(most, std::log(1.2F), 1e-6F);  // the limit is reached and not exceeded
}

TEST(Trainer, PaperPresetTrains) {
  CornerViews views(3);
  TrainerOptions options = TrainerOptions::preset("paper");
  EXPECT_EQ(options.iterations, 20000);
  options.iterations = 60;
  InitializeOptions shape = InitializeOptions::preset("paper");
  EXPECT_EQ(shape.shape, InitialShape::round);
  PointCloud cloud = CornerScene().cloud(0.06);
  Trainer trainer(compute::Context::open(), options, gaussians_from_cloud(cloud, shape), views);
  const double first = trainer.step().value.loss;
  double last = first;
  while (!trainer.done()) last = trainer.step().value.loss;
  EXPECT_LT(last, first);
}

TEST(TrainerOptions, DescribeNamesSettings) {
  const auto lines = TrainerOptions::preset("paper").describe();
  EXPECT_THAT(lines, testing::IsSupersetOf({"iterations 20000", "ssim_weight 0.2", "color_rate 0.025"}));
}

TEST(Trainer, NoIterationsIsDoneAtOnce) {
  CornerViews views(1);
  const Gaussians initial = grey_corner(0.2);
  Trainer trainer(compute::Context::open(), short_options(0), initial, views);
  EXPECT_TRUE(trainer.done());
  EXPECT_EQ(trainer.step().iteration, 0);
  EXPECT_EQ(hash(trainer.gaussians()), hash(initial));
  EXPECT_EQ(trainer.report().psnr_db, 0.0);
}

/// One view whose image the test can modify.
class OneView : public TrainingViews {
 public:
  CornerScene scene;
  ColorImage image = scene.color(scene.T_world_camera(0));
  int count() const override { return 1; }
  Camera camera(int) const override { return scene.camera; }
  SE3 T_world_camera(int) const override { return scene.T_world_camera(0); }
  ColorImage color(int) override { return image; }
};

TEST(Trainer, RefusesBadInput) {
  const auto context = compute::Context::open();
  const Gaussians initial = grey_corner(0.2);
  CornerViews none(0);
  EXPECT_THROW(Trainer(context, {}, initial, none), InputError);
  OneView view;
  EXPECT_THROW(Trainer(context, {}, Gaussians{}, view), InputError);
  view.image = view.image(cv::Rect(0, 0, 10, 10)).clone();
  Trainer small(context, {}, initial, view);
  EXPECT_THROW(small.step(), InputError);
  view.image = view.scene.color(view.scene.T_world_camera(0));
  view.image(3, 4)[1] = std::numeric_limits<float>::quiet_NaN();
  Trainer spoilt(context, {}, initial, view);
  EXPECT_THROW(spoilt.step(), InputError);
  EXPECT_THROW(TrainerOptions::preset("best"), InputError);
  TrainerOptions options;
  options.final_share = 0.0;
  EXPECT_THROW(options.check(), InputError);
}

TEST(TrainerOptionsTest, ManyViewsGetMoreIterations) {
  EXPECT_EQ(TrainerOptions::preset("default").iterations, TrainerOptions::preset("default", 100).iterations);
  EXPECT_EQ(TrainerOptions::preset("default", 1000).iterations, 8000);
  EXPECT_EQ(TrainerOptions::preset("paper", 100000).iterations, TrainerOptions::preset("paper").iterations);
}

}  // namespace
}  // namespace odosplat
