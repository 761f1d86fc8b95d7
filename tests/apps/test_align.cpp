// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Posed images in a frame and scale of their own, aligned with a cloud by the command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "odosplat/core/random.hpp"
#include "odosplat/core/similarity.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "odosplat/io/trajectory/similarity_file.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"
#include "tests/io/sequence/colmap_writer.hpp"

namespace odosplat::apps_test {
namespace {

namespace fs = std::filesystem;
using test::ColmapModel;
using testing::HasSubstr;

class Align : public testing::Test {
 protected:
  // The tiny sequence as a COLMAP model: poses and points in another frame and another unit.
  void SetUp() override {
    write_tiny_sequence(sequence_, 24);
    ASSERT_EQ(run_odosplat({"cloud", sequence_, "--every", "4", "--voxel", "0.03", "--out", cloud_}).status, 0);
    const Sequence s = Sequence::open(sequence_);
    ColmapModel model;
    const Camera& c = s.camera();
    model.cameras = {{1, 1, "PINHOLE", 160, 120, {c.fx, c.fy, c.cx + 0.5, c.cy + 0.5}}};
    Random random(5);
    for (std::size_t i = 0; i < s.size(); ++i) {
      const auto id = static_cast<std::uint32_t>(i + 1);
      const SE3 T_model_camera = to_model(*s.T_world_camera(i));
      model.images.push_back({id, T_model_camera.inverse(), 1, fs::path(s.color_file(i)).filename().string()});
      add_points(s, i, random, model.points);
    }
    fs::create_directories(colmap_ + "/sparse/0");
    fs::create_directory_symlink(sequence_ + "/rgb", colmap_ + "/images");
    write_text(colmap_ + "/sparse/0/cameras.txt", model.cameras_text());
    write_text(colmap_ + "/sparse/0/images.txt", model.images_text());
    write_text(colmap_ + "/sparse/0/points3D.txt", model.points_text());
  }

  SE3 to_model(const SE3& T_world_camera) const {
    const SE3 T = truth_.T_target_source.inverse() * T_world_camera;
    return {T.rotation(), T.translation() / truth_.scale};
  }

  // 75 points of the depth image, with noise; every tenth is at a random place.
  void add_points(const Sequence& s, std::size_t i, Random& random, PointCloud& points) const {
    const DepthImage depth = s.depth(i);
    for (int k = 0; k < 75; ++k) {
      const int u = static_cast<int>(random.below(160));
      const int v = static_cast<int>(random.below(120));
      Eigen::Vector3d p = *s.T_world_camera(i) * Eigen::Vector3d(depth(v, u) * s.camera().ray(u, v));
      for (int a = 0; a < 3; ++a) p[a] += 0.005 * random.normal();
      if (k % 10 == 0) p = Eigen::Vector3d(random.uniform(0, 4), random.uniform(0, 3), random.uniform(0, 2.5));
      points.points.push_back((truth_.T_target_source.inverse() * p / truth_.scale).cast<float>());
      points.colors.emplace_back(0.5F, 0.5F, 0.5F);
    }
  }

  RunResult align(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"align", "--poses", colmap_, "--cloud", cloud_, "--out", out_};
    words.insert(words.end(), more.begin(), more.end());
    return run_odosplat(words);
  }

  void expect_refused(const RunResult& result, const std::string& fault) const {
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(fault));
    const std::string line = result.err.substr(std::min(result.err.find("odosplat: "), result.err.size()));
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(out_ + "/rgb.txt"));
    EXPECT_FALSE(fs::exists(out_ + "/transform.txt"));
  }

  // Compares the cameras with the original ones: with noise of 5 mm on 1600 points errors of millimetres remain.
  void expect_aligned() const {
    const Sequence aligned = Sequence::open(out_);
    const Sequence s = Sequence::open(sequence_);
    ASSERT_EQ(aligned.size(), s.size());
    EXPECT_EQ(aligned.layout(), "tum");
    EXPECT_EQ(aligned.camera(), s.camera());
    for (std::size_t i = 0; i < s.size(); ++i) {
      const SE3 error = s.T_world_camera(i)->inverse() * *aligned.T_world_camera(i);
      EXPECT_LT(error.translation().norm(), 0.005);
      EXPECT_LT(error.angle(), 0.003);
      EXPECT_EQ(aligned.color(i)(60, 80), s.color(i)(60, 80));
    }
    const Similarity found = parse_similarity("transform.txt", read_text(out_ + "/transform.txt"));
    EXPECT_NEAR(found.scale / truth_.scale, 1.0, 0.003);
  }

  ScratchFolder scratch_;
  std::string sequence_ = scratch_ / "seq";
  std::string colmap_ = scratch_ / "colmap";
  std::string cloud_ = scratch_ / "cloud.ply";
  std::string out_ = scratch_ / "aligned";
  Similarity truth_{0.37, SE3::exp((Vector6d() << 1, -2, 0.5, 0.4, -1.1, 0.7).finished())};
};

TEST_F(Align, FromAGuessAndOnToTraining) {
  // Wrong by 5 % in scale, 6 degrees of rotation about the origin and 5 cm.
  const Similarity guess{1.05 * truth_.scale,
                         SE3::exp((Vector6d() << 0.03, 0.04, 0, 0.06, 0, -0.08).finished()) * truth_.T_target_source};
  const RunResult result = align({"--guess", similarity_text(guess)});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("scale 0.3"));
  EXPECT_THAT(result.out, HasSubstr("of 1800 points"));
  EXPECT_THAT(result.out, HasSubstr("median 0.00"));
  EXPECT_THAT(result.out, HasSubstr("24 posed images"));
  expect_aligned();
  const std::string map = scratch_ / "map.ply";
  const RunResult train =
      run_odosplat({"train", out_, "--cloud", cloud_, "--every", "8", "--iterations", "5", "--out", map});
  EXPECT_EQ(train.status, 0) << train.err;
  EXPECT_TRUE(fs::exists(map));
}

TEST_F(Align, FromPairs) {
  std::string pairs = "# poses' frame, cloud's frame\n";
  const SE3 back = truth_.T_target_source.inverse();
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 0, 0), Eigen::Vector3d(0, 3, 0), Eigen::Vector3d(4, 3, 2.5)}) {
    const Eigen::Vector3d q = back * p / truth_.scale;
    // Rounded like points picked by hand, to about 5 cm.
    for (const double v : {q.x(), q.y(), q.z()}) pairs += std::to_string(std::round(10.0 * v) / 10.0) + " ";
    for (const double v : {p.x(), p.y(), p.z()}) pairs += std::to_string(v) + " ";
    pairs += "\n";
  }
  write_text(scratch_ / "pairs.txt", pairs);
  const RunResult result = align({"--pairs", scratch_ / "pairs.txt"});
  ASSERT_EQ(result.status, 0) << result.err;
  expect_aligned();
}

TEST_F(Align, TakesPointsFromAFile) {
  // The model's points are moved to a file: without them the alignment is refused, with --points it succeeds.
  PointCloud points = Sequence::open(colmap_).sparse_points();
  write_point_cloud(scratch_ / "points.ply", points);
  fs::remove(colmap_ + "/sparse/0/points3D.txt");
  expect_refused(align({"--guess", similarity_text(truth_)}), "has no sparse points to align by; give --points");
  const RunResult result = align({"--guess", similarity_text(truth_), "--points", scratch_ / "points.ply"});
  ASSERT_EQ(result.status, 0) << result.err;
  expect_aligned();
}

TEST_F(Align, RefusesWhatCannotBeTrusted) {
  expect_refused(align({}), "cannot be aligned with");
  expect_refused(align({"--guess", "1 2 3"}), "--guess: must be \"s tx ty tz qx qy qz qw\"");
  write_text(scratch_ / "pairs.txt", "0 0 0 0 0 0\n1 0 0 1 0 0\n");
  expect_refused(align({"--pairs", scratch_ / "pairs.txt"}),
                 "pairs.txt: alignment: needs at least 3 pairs, there are 2");
  expect_refused(align({"--pairs", scratch_ / "no.txt"}), "no.txt: is missing");
  expect_refused(align({"--inlier", "0"}), "inlier: must be a number above 0");
  expect_refused(align({"--pairs", scratch_ / "pairs.txt", "--guess", "1 0 0 0 0 0 0 1"}), "excludes");
  expect_refused(run_odosplat({"align", "--poses", colmap_, "--cloud", scratch_ / "no.ply", "--out", out_}), "no.ply");
  const RunResult own = run_odosplat({"align", "--poses", sequence_, "--cloud", cloud_, "--out", sequence_});
  EXPECT_EQ(own.status, 2);
  EXPECT_THAT(own.err, HasSubstr("is also read"));
}

}  // namespace
}  // namespace odosplat::apps_test
