// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Runs of train that are stopped and resumed, or that must be refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>

#include "apps/cli/train/train_views.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "odosplat/splat/gaussian_view.hpp"
#include "odosplat/splat/map_file.hpp"
#include "odosplat/splat/map_training.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Training : public testing::Test {
 protected:
  void SetUp() override {
    write_tiny_sequence(scratch_ / "seq", 24);
    const RunResult made =
        run_odosplat({"cloud", sequence_, "--every", "3", "--voxel", "0.05", "--noise", "0.002", "--out", cloud_});
    ASSERT_EQ(made.status, 0) << made.err;
  }
  std::vector<std::string> words(const std::string& out, std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"train",
                                 sequence_,
                                 "--every",
                                 "3",
                                 "--cloud",
                                 cloud_,
                                 "--out",
                                 out,
                                 "--iterations",
                                 "120",
                                 "--checkpoint-every",
                                 "10"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  ScratchFolder scratch_;
  std::string sequence_ = scratch_ / "seq";
  std::string cloud_ = scratch_ / "cloud.ply";
};

TEST_F(Training, KeepsTheCheckpointOfAnEarlierRun) {
  const std::string map = scratch_ / "map.ply";
  write_text(map + ".checkpoint", "of an earlier run");
  const RunResult run = run_odosplat(words(map));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read_text(map + ".checkpoint.old"), "of an earlier run");
  EXPECT_FALSE(fs::exists(map + ".checkpoint"));
}

// A program that uses the library gets the same map that the command writes.
TEST_F(Training, TheLibraryMakesTheSameMap) {
  const std::string map = scratch_ / "map.ply";
  ASSERT_EQ(run_odosplat(words(map)).status, 0);
  apps::SequenceViews views({Sequence::open(sequence_)}, 3, {});
  TrainerOptions options = TrainerOptions::preset("default", views.count());
  options.iterations = 120;
  const TrainedMap made = odosplat::train_map(compute::Context::open(), read_point_cloud(cloud_), views,
                                              InitializeOptions::preset("default"), options);
  const Map written = read_map(map);
  EXPECT_EQ(made.map.gaussians.positions, written.gaussians.positions);
  EXPECT_EQ(made.map.gaussians.sh, written.gaussians.sh);
  EXPECT_EQ(made.map.header.places.size(), written.header.places.size());
  ASSERT_TRUE(made.map.header.sigma && written.header.sigma);
  EXPECT_EQ(made.map.header.sigma->spread, written.header.sigma->spread);
  EXPECT_EQ(made.map.header.rasterizer.order, written.header.rasterizer.order);
  EXPECT_EQ(made.training.iterations, 120);
  // Only the command knows the training frames and the usual number of steps.
  std::vector<std::string> notes = written.header.notes;
  std::erase_if(notes, [](const std::string& note) {
    return note.starts_with("training_frames ") || note.starts_with("quality_verdict ");
  });
  std::vector<std::string> library_notes = made.map.header.notes;
  std::erase_if(library_notes, [](const std::string& note) { return note.starts_with("quality_verdict "); });
  EXPECT_EQ(library_notes, notes);
  // The map can be used directly and written.
  write_map(scratch_ / "again.ply", made.map);
  EXPECT_EQ(read_map(scratch_ / "again.ply").gaussians.opacity_logits, made.map.gaussians.opacity_logits);
  EXPECT_EQ(GaussianView(compute::Context::open(), made.map).name(), "gaussian");
}

// The random shapes and colours of the paper's preset: the library uses the same seeds as the command.
TEST_F(Training, TheLibraryMakesTheSameMapByThePapersRecipe) {
  const std::string map = scratch_ / "map.ply";
  ASSERT_EQ(run_odosplat(words(map, {"--preset", "paper", "--budget", "2000"})).status, 0);
  apps::SequenceViews views({Sequence::open(sequence_)}, 3, {});
  TrainerOptions options = TrainerOptions::preset("paper", views.count());
  options.iterations = 120;
  options.densify.budget = 2000;
  InitializeOptions initial = InitializeOptions::preset("paper");
  initial.budget = 2000;
  const TrainedMap made =
      odosplat::train_map(compute::Context::open(), read_point_cloud(cloud_), views, initial, options);
  EXPECT_EQ(made.map.gaussians.positions, read_map(map).gaussians.positions);
  EXPECT_EQ(made.map.gaussians.rotations, read_map(map).gaussians.rotations);
}

TEST_F(Training, KilledRunsEndWithTheSameBits) {
  const std::string whole = scratch_ / "whole.ply";
  ASSERT_EQ(run_odosplat(words(whole, {"--densify", "relocate", "--budget", "9000"})).status, 0);
  EXPECT_FALSE(fs::exists(whole + ".checkpoint"));

  Random random(7);
  const std::string map = scratch_ / "killed.ply";
  const std::string checkpoint = map + ".checkpoint";
  const auto flags = words(map, {"--densify", "relocate", "--budget", "9000", "--resume"});
  int kills = 0;
  RunResult last;
  for (int attempt = 0; attempt < 5; ++attempt) {
    // Killed after a new checkpoint was written, with a random delay of up to a few steps.
    const auto before = fs::exists(checkpoint) ? fs::last_write_time(checkpoint) : fs::file_time_type::min();
    long wait = static_cast<long>(random.uniform(0.0, 20.0));
    last = run_odosplat_and_signal(flags, SIGKILL, [&] {
      std::error_code ignored;
      const auto now = fs::last_write_time(checkpoint, ignored);
      return !ignored && now > before && --wait < 0;
    });
    if (last.status == 0) break;
    ASSERT_EQ(last.status, 128 + SIGKILL) << last.err;
    EXPECT_FALSE(fs::exists(map));
    ++kills;
  }
  EXPECT_GE(kills, 2);
  if (last.status != 0) last = run_odosplat(flags);
  ASSERT_EQ(last.status, 0) << last.err;
  EXPECT_THAT(last.err, HasSubstr("going on from iteration"));
  EXPECT_FALSE(fs::exists(checkpoint));
  EXPECT_TRUE(read_text(map) == read_text(whole)) << "the map of the run that was killed " << kills << " times differs";
}

TEST_F(Training, CtrlCSavesAndLeavesTheMapAsItWas) {
  const std::string map = scratch_ / "map.ply";
  const std::string checkpoint = map + ".checkpoint";
  write_text(map, "a map of many hours");
  const RunResult stopped = run_odosplat_and_signal(words(map), SIGINT, [&] { return fs::exists(checkpoint); });
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_EQ(read_text(map), "a map of many hours");
  EXPECT_TRUE(fs::exists(checkpoint));
  const RunResult resumed = run_odosplat(words(map, {"--resume"}));
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_FALSE(fs::exists(checkpoint));
  const std::string whole = scratch_ / "whole.ply";
  ASSERT_EQ(run_odosplat(words(whole)).status, 0);
  EXPECT_TRUE(read_text(map) == read_text(whole));
  EXPECT_THAT(read_text(map), HasSubstr("comment iterations_done 120\n"));
}

TEST_F(Training, PreparationEndsAtOnceOnASignal) {
  PointCloud large;
  Random random(3);
  for (int i = 0; i < 600000; ++i)
    large.points.emplace_back(random.uniform(0, 5), random.uniform(0, 4), random.uniform(0, 3));
  const std::string cloud = scratch_ / "large.ply";
  write_point_cloud(cloud, large);
  const std::string map = scratch_ / "map.ply";
  write_text(map, "a map of many hours");
  const auto started = std::chrono::steady_clock::now();
  auto signaled = started;
  const RunResult stopped = run_odosplat_and_signal({"train", sequence_, "--cloud", cloud, "--out", map}, SIGINT, [&] {
    signaled = std::chrono::steady_clock::now();
    return signaled - started > std::chrono::milliseconds(1500);
  });
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_LT(std::chrono::steady_clock::now() - signaled, std::chrono::seconds(1));
  EXPECT_EQ(stopped.err.find("device "), std::string::npos) << "was past preparing: " << stopped.err;
  EXPECT_EQ(read_text(map), "a map of many hours");
}

TEST_F(Training, CheckpointsThatCannotBeWrittenCostNoTraining) {
  const std::string map = scratch_ / "map.ply";
  fs::create_directory(map + ".checkpoint");  // renaming a file to a folder fails, in place of a full disk
  write_text(map + ".checkpoint/file", "");
  const RunResult result = run_odosplat(words(map));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("no checkpoint after iteration 10:"));
  EXPECT_THAT(result.err, HasSubstr("no checkpoint after iteration 110:"));  // each checkpoint is tried
  EXPECT_TRUE(fs::is_regular_file(map));
}

TEST_F(Training, MapThatCannotBeWrittenIsKeptInTheCheckpoint) {
  const std::string map = scratch_ / "map.ply";
  const std::string checkpoint = map + ".checkpoint";
  const RunResult failed = run_odosplat_and_signal(words(map), SIGCONT, [&] {
    if (!fs::exists(checkpoint)) return false;
    fs::create_directory(map);
    return true;
  });
  EXPECT_EQ(failed.status, 2) << failed.err;
  EXPECT_THAT(failed.err, HasSubstr("kept in " + checkpoint));
  ASSERT_TRUE(fs::exists(checkpoint));
  fs::remove(map);
  EXPECT_EQ(run_odosplat(words(map, {"--resume"})).status, 0);
  EXPECT_TRUE(fs::is_regular_file(map));
}

TEST_F(Training, AbsurdFlagsAreRefusedInOneLine) {
  const std::string map = scratch_ / "map.ply";
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{{"--iterations", "-5"},
                                                                                    {"--iterations", "many"},
                                                                                    {"--sh-degree", "-2"},
                                                                                    {"--sh-degree", "4"},
                                                                                    {"--depth-weight", "nan"},
                                                                                    {"--depth-weight", "inf"},
                                                                                    {"--depth-weight", "-1"},
                                                                                    {"--seed", "-1"},
                                                                                    {"--budget", "-7"},
                                                                                    {"--voxel", "nan"},
                                                                                    {"--voxel", "inf"},
                                                                                    {"--checkpoint-every", "-1"}}) {
    std::vector<std::string> all{"train", sequence_, "--cloud", cloud_, "--out", map};
    all.insert(all.end(), more.begin(), more.end());
    const RunResult result = run_odosplat(all);
    EXPECT_EQ(result.status, 2) << testing::PrintToString(more) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(map));
  }
}

TEST_F(Training, CloudThatNoImageSeesIsRefused) {
  PointCloud cloud = read_point_cloud(cloud_);
  for (Eigen::Vector3f& p : cloud.points) p.z() -= 500.0F;
  const std::string away = scratch_ / "away.ply";
  write_point_cloud(away, cloud);
  const std::string map = scratch_ / "map.ply";
  const RunResult result = run_odosplat({"train", sequence_, "--cloud", away, "--out", map});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("no image sees any of its points"));
  EXPECT_FALSE(fs::exists(map));
  EXPECT_FALSE(fs::exists(map + ".checkpoint"));
}

TEST_F(Training, DoesNotJudgeWhatWasNotTrained) {
  const std::string map = scratch_ / "map.ply";
  const RunResult none = run_odosplat({"train", sequence_, "--cloud", cloud_, "--iterations", "0", "--out", map});
  ASSERT_EQ(none.status, 0) << none.err;
  EXPECT_THAT(none.out, testing::Not(HasSubstr("PSNR 0.00")));
  EXPECT_THAT(none.out, HasSubstr("the map is not judged: no step of training"));
  EXPECT_THAT(run_odosplat({"map", "info", map}).out, HasSubstr("not judged: no step of training"));
  const RunResult single =
      run_odosplat({"train", sequence_, "--cloud", cloud_, "--iterations", "30", "--every", "1000", "--out", map});
  ASSERT_EQ(single.status, 0) << single.err;
  EXPECT_THAT(single.out, HasSubstr("the map is not judged: it was trained on 1 image only"));
}

TEST_F(Training, SaysWhatTheMapIsWorth) {
  const std::string map = scratch_ / "map.ply";
  const std::string report = scratch_ / "report.json";
  std::vector<std::string> longer = words(map, {"--report", report});
  std::replace(longer.begin(), longer.end(), std::string("120"), std::string("400"));
  const RunResult good = run_odosplat(longer);
  ASSERT_EQ(good.status, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("the map is good: "));
  const auto json = nlohmann::json::parse(read_text(report));
  EXPECT_EQ(json["quality"]["good"], true);
  ASSERT_EQ(json["images"].size(), 8U);
  for (const auto& image : json["images"]) {
    EXPECT_GT(image["psnr_db"], 20.0);
    EXPECT_LT(image["depth_error_m"], 0.02);
  }
  EXPECT_EQ(json["images"][1]["frame"], 3);

  const RunResult info = run_odosplat({"map", "info", map, "--json", scratch_ / "info.json"});
  ASSERT_EQ(info.status, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("good: "));
  const auto told = nlohmann::json::parse(read_text(scratch_ / "info.json"));
  EXPECT_EQ(told["gaussians"], json["gaussians"]);
  EXPECT_EQ(told["bytes"], fs::file_size(map));
  EXPECT_EQ(told["blend_order"], "distance");
  EXPECT_EQ(told["quality"]["verdict"], json["quality"]["verdict"]);
  EXPECT_GT(told["places"], 0);
  EXPECT_FALSE(told["sigma"].is_null());

  // A map without a header about its training.
  const std::string foreign = scratch_ / "map.splat";
  ASSERT_EQ(run_odosplat({"convert", map, foreign}).status, 0);
  const RunResult unknown = run_odosplat({"map", "info", foreign, "--json", scratch_ / "info.json"});
  ASSERT_EQ(unknown.status, 0) << unknown.err;
  EXPECT_THAT(unknown.out, HasSubstr("quality       unknown"));
  EXPECT_TRUE(nlohmann::json::parse(read_text(scratch_ / "info.json"))["quality"].is_null());
  EXPECT_EQ(run_odosplat({"map", "info", cloud_}).status, 2);
}

TEST_F(Training, CloudThatIsOffMakesADoubtfulMapThatTrackWarnsOf) {
  PointCloud cloud = read_point_cloud(cloud_);
  for (Eigen::Vector3f& p : cloud.points) p += Eigen::Vector3f(0.1F, 0.2F, 0.0F);
  const std::string off = scratch_ / "off.ply";
  write_point_cloud(off, cloud);
  const std::string map = scratch_ / "map.ply";
  const RunResult trained =
      run_odosplat({"train", sequence_, "--every", "3", "--cloud", off, "--out", map, "--iterations", "120"});
  ASSERT_EQ(trained.status, 0) << trained.err;
  EXPECT_THAT(trained.out, HasSubstr("the map is doubtful: "));
  EXPECT_THAT(trained.err, HasSubstr("likely cause: the cloud lies "));
  const RunResult tracked =
      run_odosplat({"track", sequence_, "--map", map, "--frames", "0:3", "--out", scratch_ / "run"});
  EXPECT_THAT(tracked.err, HasSubstr("its header says: doubtful: "));
}

TEST_F(Training, InvertedPosesAreNamed) {
  const std::string turned = scratch_ / "turned";
  fs::copy(sequence_, turned, fs::copy_options::recursive);
  Trajectory poses = read_trajectory(turned + "/groundtruth.txt");
  for (StampedPose& pose : poses) pose.T_world_camera = pose.T_world_camera.inverse();
  write_trajectory(turned + "/groundtruth.txt", poses);
  const RunResult result = run_odosplat(
      {"train", turned, "--every", "3", "--cloud", cloud_, "--out", scratch_ / "map.ply", "--iterations", "40"});
  EXPECT_THAT(result.err, HasSubstr("the poses are inverted"));
  EXPECT_TRUE(result.status == 0 || result.status == 2) << result.err;
}

TEST_F(Training, PointsThatCoincideDoNotHoldItUp) {
  PointCloud cloud;
  cloud.points.assign(60000, read_point_cloud(cloud_).points.front());
  const std::string pile = scratch_ / "pile.ply";
  write_point_cloud(pile, cloud);
  const auto started = std::chrono::steady_clock::now();
  const RunResult result = run_odosplat(
      {"train", sequence_, "--every", "12", "--cloud", pile, "--out", scratch_ / "map.ply", "--iterations", "1"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_LT(std::chrono::steady_clock::now() - started, std::chrono::seconds(30));
}

TEST_F(Training, ForeignAndDamagedCheckpointsAreRefused) {
  const std::string map = scratch_ / "map.ply";
  write_text(map + ".checkpoint", "not a checkpoint");
  const RunResult damaged = run_odosplat(words(map, {"--resume"}));
  EXPECT_EQ(damaged.status, 2);
  EXPECT_THAT(damaged.err, HasSubstr("map.ply.checkpoint"));

  fs::remove(map + ".checkpoint");
  const RunResult stopped =
      run_odosplat_and_signal(words(map), SIGKILL, [&] { return fs::exists(map + ".checkpoint"); });
  ASSERT_EQ(stopped.status, 128 + SIGKILL);
  const RunResult other = run_odosplat(words(map, {"--resume", "--depth-weight", "0.3"}));
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("depth_weight"));
  EXPECT_FALSE(fs::exists(map));
}

TEST_F(Training, CloudWithoutColoursTakesThemFromTheImages) {
  PointCloud cloud = read_point_cloud(cloud_);
  cloud.colors.clear();
  const std::string bare = scratch_ / "bare.ply";
  write_point_cloud(bare, cloud);
  // Without training: colours that the images give to the points, compared with those of the cloud itself.
  for (const std::string& source : {cloud_, bare}) {
    const std::string map = source + ".map.ply";
    ASSERT_EQ(
        run_odosplat({"train", sequence_, "--every", "3", "--cloud", source, "--out", map, "--iterations", "0"}).status,
        0);
    const RunResult judged = run_odosplat(
        {"eval-depth", sequence_, "--map", map, "--every", "2", "--skip-every", "3", "--json", map + ".json"});
    ASSERT_EQ(judged.status, 0) << judged.err;
    EXPECT_GT(nlohmann::json::parse(read_text(map + ".json"))["psnr_db"], 17.0) << source;
  }
  // If no frame sees the map, there are no errors, which is not the same as errors of zero.
  for (Eigen::Vector3f& point : cloud.points) point += Eigen::Vector3f(0.0F, 5000.0F, 0.0F);
  const std::string far = scratch_ / "far.ply";
  write_point_cloud(far, cloud);
  const RunResult unseen = run_odosplat({"eval-depth", sequence_, "--method", "surfel", "--cloud", far});
  EXPECT_EQ(unseen.status, 3);
  EXPECT_THAT(unseen.err, HasSubstr("no pixel of"));
  EXPECT_THAT(unseen.out, testing::Not(HasSubstr("0.00")));
}

TEST_F(Training, EveryChoiceTrains) {
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--densify", "split"}, {"--exposure", "on"}, {"--sh-degree", "3"}, {"--preset", "paper"}}) {
    const std::string map = scratch_ / "map.ply";
    const RunResult result = run_odosplat(words(map, more));
    EXPECT_EQ(result.status, 0) << testing::PrintToString(more) << result.err;
    EXPECT_EQ(run_odosplat({"eval-depth", sequence_, "--map", map, "--skip-every", "3"}).status, 0);
  }
  EXPECT_EQ(run_odosplat(words(scratch_ / "map.ply", {"--densify", "more"})).status, 2);
  EXPECT_EQ(run_odosplat(words(scratch_ / "map.ply", {"--exposure", "often"})).status, 2);
}

}  // namespace
}  // namespace odosplat::apps_test
