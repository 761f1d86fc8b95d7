// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Kinds of `odosplat view` that need no map of Gaussians, and the benchmark's figures that need no map at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/benchmark/report/benchmark_figures.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/video/video_reader.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps {
namespace {

using apps_test::run_odosplat;
using apps_test::RunResult;
using apps_test::ScratchFolder;
using apps_test::write_tiny_sequence;
using testing::HasSubstr;

TEST(ViewFly, FilmsACloudAlongAPath) {
  const ScratchFolder folder;
  write_tiny_sequence(folder / "seq", 24);
  ASSERT_EQ(run_odosplat({"cloud", folder / "seq", "--out", folder / "cloud.ply"}).status, 0);
  const std::vector<std::string> fly{"view",     "fly",
                                     "--method", "interpolation",
                                     "--cloud",  folder / "cloud.ply",
                                     "--poses",  folder / "seq/groundtruth.txt",
                                     "--camera", folder / "seq/camera.yaml",
                                     "--step",   "5"};
  std::vector<std::string> arguments = fly;
  arguments.insert(arguments.end(), {"--fps", "10", "--out", folder / "film.avi"});
  const RunResult done = run_odosplat(arguments);
  ASSERT_EQ(done.status, 0) << done.err;
  const VideoReader film((folder / "film.avi").string());
  EXPECT_EQ(film.size(), 5U);
  EXPECT_NEAR(film.times().back(), 0.4, 1e-3);
  EXPECT_EQ(film.frame_size().width, 320);
  arguments = fly;
  arguments.insert(arguments.end(), {"--out", folder / "film.gif"});
  const RunResult refused = run_odosplat(arguments);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("must end in .avi or .mp4"));
}

Trajectory path_of(double offset_m) {
  Trajectory path;
  for (int k = 0; k < 30; ++k) {
    path.push_back({k / 30.0, SE3(Eigen::Quaterniond::Identity(), {0.1 * k + offset_m, 0.0, 0.0}), ""});
  }
  return path;
}

BenchmarkResults runs_on(const std::vector<std::string>& sequences) {
  BenchmarkResults results;
  results.methods = {"gaussian", "paper"};
  for (const std::string& name : sequences) {
    SequenceFacts sequence;
    sequence.name = name;
    sequence.truth = path_of(0.0);
    results.sequences.push_back(sequence);
    RunFacts run;
    run.sequence = name;
    run.method = "gaussian";
    run.estimate = path_of(0.01);
    results.cells.push_back(run);
    run.method = "paper";
    run.fault = "crashed";
    results.cells.push_back(run);
  }
  return results;
}

TEST(BenchmarkFigures, ShowThePapersSequencesIfTheyAreThere) {
  std::vector<std::string> drawn;
  benchmark_trajectories(runs_on({"augm_4", "icl_1", "icl_2", "icl_3", "augm_2"}), drawn);
  EXPECT_THAT(drawn, testing::ElementsAre("icl_2", "icl_3", "augm_2", "augm_4"));
  benchmark_trajectories(runs_on({"a", "icl_2", "b", "c", "d"}), drawn);
  EXPECT_THAT(drawn, testing::ElementsAre("a", "icl_2", "b", "c"));
  BenchmarkResults results = runs_on({"a", "b"});
  results.cells[0].fault = "crashed";
  benchmark_trajectories(results, drawn);
  EXPECT_THAT(drawn, testing::ElementsAre("b"));
}

TEST(BenchmarkFigures, LeaveOutWhatIsMissingAndSayWhy) {
  const ScratchFolder folder;
  BenchmarkResults results = runs_on({"a"});
  const std::vector<ReportFigure> some = draw_benchmark_figures({}, results, {}, folder.path());
  ASSERT_EQ(some.size(), 4U);
  EXPECT_EQ(some[0].missing, "no sequence has both a map and a cloud");
  EXPECT_EQ(some[1].missing, "no sequence has both a map and a cloud");
  EXPECT_EQ(some[2].missing, "");
  EXPECT_TRUE(std::filesystem::exists(folder / some[2].file));
  EXPECT_TRUE(std::filesystem::exists(folder / some[3].file));
  for (const ReportFigure& figure : some) EXPECT_FALSE(figure.title.empty());
  results.cells.clear();
  for (const ReportFigure& figure : draw_benchmark_figures({}, results, {}, folder.path())) {
    EXPECT_FALSE(figure.missing.empty());
    EXPECT_TRUE(figure.file.empty());
  }
}

TEST(BenchmarkFigures, CaptionsOfStandInsSaySo) {
  const ScratchFolder folder;
  BenchmarkResults results = runs_on({"a"});
  results.stand_in = true;
  const std::vector<ReportFigure> figures = draw_benchmark_figures({}, results, {}, folder.path());
  EXPECT_THAT(figures[2].caption, HasSubstr("stand-in"));
  EXPECT_THAT(figures[3].caption, HasSubstr("stand-in"));
}

}  // namespace
}  // namespace odosplat::apps
