// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/map/interpolation_view.hpp"
#include "odosplat/splat/train/initialize.hpp"
#include "odosplat/splat/train/trainer.hpp"
#include "tests/splat/corner_scene.hpp"
#include "tests/splat/scratch.hpp"

namespace odosplat {
namespace {

using test::CornerScene;
using test::CornerViews;

bool same_bits(const Gaussians& a, const Gaussians& b) {
  const auto same = [](const std::vector<float>& x, const std::vector<float>& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) == 0;
  };
  return same(a.positions, b.positions) && same(a.log_scales, b.log_scales) && same(a.rotations, b.rotations) &&
         same(a.opacity_logits, b.opacity_logits) && same(a.sh, b.sh);
}

TEST(Checkpoint, GivesBackWhatWasPut) {
  const test::Scratch scratch;
  const std::string path = scratch / "round_trip";
  Checkpoint written;
  written.put("floats", std::vector<float>{1.0F, -0.0F, 3e-42F});
  written.put("none", std::vector<double>{});
  written.put("counts", std::vector<std::int64_t>{-1, 1LL << 40});
  written.put_text("text", std::string("a\0b\n", 4));
  written.write(path);
  const Checkpoint read = Checkpoint::read(path);
  EXPECT_THAT(read.get<float>("floats"), testing::ElementsAre(1.0F, -0.0F, 3e-42F));
  EXPECT_TRUE(read.get<double>("none").empty());
  EXPECT_THAT(read.get<std::int64_t>("counts"), testing::ElementsAre(-1, 1LL << 40));
  EXPECT_EQ(read.get_text("text"), std::string("a\0b\n", 4));
  EXPECT_THROW(read.get<float>("other"), InputError);
  EXPECT_THROW(read.get<double>("floats"), InputError);  // 12 bytes
}

TEST(Checkpoint, DamageIsFound) {
  const test::Scratch scratch;
  const std::string path = scratch / "damage";
  Checkpoint written;
  written.put("values", std::vector<float>(50, 2.5F));
  written.put_text("text", "settings");
  written.write(path);
  const std::string bytes = read_file(path);
  for (std::size_t cut = 0; cut < bytes.size(); cut += 7) {
    write_file_atomically(path, bytes.substr(0, cut));
    EXPECT_THROW(Checkpoint::read(path), InputError) << "cut at " << cut;
  }
  for (std::size_t at = 0; at < bytes.size(); at += 5) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    write_file_atomically(path, flipped);
    EXPECT_THROW(Checkpoint::read(path), InputError) << "bit at " << at;
  }
  EXPECT_THROW(Checkpoint::read(scratch / "missing"), InputError);
}

/// Options of a run in which everything has state: depth, anchors, exposures, densification.
TrainerOptions full_options(DensifyMethod method) {
  TrainerOptions options;
  options.iterations = 40;
  options.sh_interval = 10;
  options.exposure.rate = 1e-3;
  options.surface = {0.1, 0.1, 0.1};
  options.rotation_rate = 1e-3;
  options.densify.method = method;
  options.densify.budget = 3000;
  options.densify.from = 8;
  options.densify.interval = 8;
  options.densify.pull = 1e-5;
  options.densify.reset_interval = method == DensifyMethod::split ? 101 : 0;
  return options;
}

class Resume : public testing::TestWithParam<DensifyMethod> {};

TEST_P(Resume, EndsWithTheBitsOfAnUninterruptedRun) {
  const auto context = compute::Context::open();
  const PointCloud cloud = CornerScene().cloud(0.08);
  const Gaussians initial = gaussians_from_cloud(cloud, {});
  InterpolationView surface(cloud);
  CornerViews views(3);
  const TrainerOptions options = full_options(GetParam());
  Trainer whole(context, options, initial, views, &surface);
  while (!whole.done()) whole.step();

  const test::Scratch scratch;
  const std::string path = scratch / "resume";
  for (const int stop : {1, 8, 19, 33}) {
    Trainer first(context, options, initial, views, &surface);
    while (first.iteration() < stop) first.step();
    first.checkpoint().write(path);
    Trainer second(context, options, initial, views, &surface);
    second.resume(Checkpoint::read(path));
    EXPECT_EQ(second.iteration(), stop);
    while (!second.done()) second.step();
    EXPECT_TRUE(same_bits(second.gaussians(), whole.gaussians())) << "stopped after " << stop;
    EXPECT_EQ(second.report().psnr_db, whole.report().psnr_db);
    EXPECT_EQ(second.report().depth_error, whole.report().depth_error);
  }
  if (GetParam() == DensifyMethod::relocate) {
    EXPECT_GT(whole.gaussians().size(), initial.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Resume,
                         testing::Values(DensifyMethod::none, DensifyMethod::relocate, DensifyMethod::split),
                         [](const auto& method) { return name_of(method.param); });

// With a valid checksum only the values themselves show that they are wrong.
TEST(Resume, AbsurdNumbersAreRefused) {
  const auto context = compute::Context::open();
  const Gaussians initial = gaussians_from_cloud(CornerScene().cloud(0.2), {});
  CornerViews views(2);
  TrainerOptions options;
  options.iterations = 10;
  Trainer trainer(context, options, initial, views);
  trainer.step();
  const Checkpoint good = trainer.checkpoint();
  const auto refused = [&](const std::string& name, const auto& values) {
    Checkpoint bad = good;
    bad.put(name, values);
    EXPECT_THROW(trainer.resume(bad), InputError) << name;
  };
  using Whole = std::vector<std::int64_t>;
  using Real = std::vector<float>;
  refused("progress", Whole{-1, 0, 0});
  refused("progress", Whole{1LL << 40, 0, 0});
  refused("progress", Whole{1, 2, 0});
  refused("progress", Whole{1, 0, 9});
  refused("progress", Whole{});
  refused("undone", Whole{-3, 0});
  refused("adam/sh/steps", Whole{-1});
  refused("adam/sh/first", Real(3, 0.0F));
  refused("adam/positions/second", Real{});
  refused("adam/positions/steps", Whole{0});
  refused("adam/log_scales/steps", Whole{2});
  refused("adam/rotations/steps", Whole{1LL << 31});
  for (const char* name : {"positions", "log_scales", "rotations", "opacity_logits", "sh"}) {
    const std::string entry = std::string("adam/") + name + "/second";
    auto second = good.get<float>(entry);
    second.back() = -1e-9F;
    refused(entry, second);
  }
  auto exposures = good.get<double>("exposures");
  exposures.at(12) = -1.0;  // of the first view: 6 settings, 6 means, 6 means of squares, steps
  refused("exposures", exposures);
  exposures.at(12) = 0.0;
  exposures.at(18) += 1.0;
  refused("exposures", exposures);
  exposures.at(18) = 0.5;
  refused("exposures", exposures);
  refused("depth_errors", std::vector<double>{-0.5, -1.0});
  refused("guard", std::vector<double>{7.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0});
  refused("gaussians/positions", Real(3 * initial.size(), std::numeric_limits<float>::quiet_NaN()));
  refused("gaussians/opacity_logits", Real{});
  refused("gaussians/sh", Real(1, 0.0F));
  refused("largest_log_scales", Real{});
  refused("anchors", Real(8 * initial.size() + 8, 0.0F));
  refused("psnr_db", std::vector<double>{1.0});
  refused("last", std::vector<double>(6, std::numeric_limits<double>::quiet_NaN()));
  refused("guard", std::vector<double>(7, -1.0));
  trainer.resume(good);
  EXPECT_EQ(trainer.iteration(), 1);
}

TEST(Resume, AnotherRunsCheckpointIsRefused) {
  const auto context = compute::Context::open();
  const Gaussians initial = gaussians_from_cloud(CornerScene().cloud(0.15), {});
  CornerViews views(2);
  TrainerOptions options;
  options.iterations = 10;
  Trainer trainer(context, options, initial, views);
  trainer.step();
  const Checkpoint checkpoint = trainer.checkpoint();
  options.opacity_rate = 0.5;
  Trainer other_options(context, options, initial, views);
  try {
    other_options.resume(checkpoint);
    FAIL() << "taken up by a run with other settings";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("opacity_rate"));
  }
  options.opacity_rate = TrainerOptions().opacity_rate;
  Gaussians moved = initial;
  moved.positions[0] += 0.01F;
  Trainer other_start(context, options, moved, views);
  EXPECT_THROW(other_start.resume(checkpoint), InputError);
}

}  // namespace
}  // namespace odosplat
