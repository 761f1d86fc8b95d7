// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/sequence/moved_sequence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "odosplat/io/trajectory/similarity_file.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;
using testing::HasSubstr;

TEST(SimilarityFile, ReadsWhatItWrites) {
  const Similarity S{0.37, SE3::exp((Vector6d() << 1, -2, 3, 0.5, 2.0, -1.0).finished())};
  const Similarity read = parse_similarity("t", "# comment\n" + similarity_text(S) + "\n");
  EXPECT_NEAR(read.scale, S.scale, 1e-12);
  EXPECT_LT((read.T_target_source.inverse() * S.T_target_source).log().norm(), 1e-11);
  const auto fault = [](const std::string& text) { return error_of([&] { parse_similarity("--guess", text); }); };
  EXPECT_THAT(fault("1 2 3"), HasSubstr("--guess: must be \"s tx ty tz qx qy qz qw\", holds 3 numbers"));
  EXPECT_THAT(fault("1 2 3 4 5 6 7 8 9"), HasSubstr("line 1: there are more than the 8 numbers"));
  EXPECT_THAT(fault("1 2 3 4 5 6 7 x"), HasSubstr("`x` is not a number"));
  EXPECT_THAT(fault("-1 0 0 0 0 0 0 1"), HasSubstr("the scale must be positive"));
  EXPECT_THAT(fault("1 0 0 0 0 0 0 0"), HasSubstr("the quaternion has length 0, must be near 1"));
}

TEST(SimilarityFile, ReadsPairs) {
  const PointPairs pairs = parse_point_pairs("p", "# a\n1 2 3 4 5 6\n\n 7 8 9\t10 11 12 \n");
  ASSERT_EQ(pairs.source.size(), 2U);
  EXPECT_EQ(pairs.source[1], Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(pairs.target[0], Eigen::Vector3d(4, 5, 6));
  EXPECT_THAT(error_of([] { parse_point_pairs("p.txt", "1 2 3 4 5\n"); }), HasSubstr("p.txt: line 1: expected the 6"));
  EXPECT_THAT(error_of([] { parse_point_pairs("p.txt", "1 2 3 4 5 6 7\n"); }), HasSubstr("expected the 6"));
}

TEST(MovedSequence, OpensInTheOtherWorld) {
  const TempFolder temp;
  std::string list;
  for (const char* stamp : {"1.000", "1.200", "1.400"}) {
    temp.put_image(std::string("seq/rgb/") + stamp + ".png", cv::Mat3b(12, 16, cv::Vec3b::all(40)));
    temp.put_image(std::string("seq/depth/") + stamp + ".png", cv::Mat1w(12, 16, static_cast<std::uint16_t>(1000)));
    list += std::string(stamp) + " rgb/" + stamp + ".png\n";
  }
  temp.put("seq/rgb.txt", list);
  temp.put("seq/depth.txt", "1.010 depth/1.000.png\n1.400 depth/1.400.png\n");
  temp.put("seq/groundtruth.txt", "0.99 0 0 0 0 0 0 1\n1.05 6 0 0 0 0 0 1\n1.4 1 2 3 0 0 0 1\n");
  temp.put("seq/camera.yaml",
           "width: 16\nheight: 12\nfx: 20\nfy: 21\ncx: 7.5\ncy: 5.5\ndepth_scale: 500\ndistortion: [0.1, 0, 0, 0]\n");
  const Sequence from = Sequence::open(temp / "seq");
  const Similarity moved{2.5, SE3::exp((Vector6d() << 1, -2, 3, 0.5, 2.0, -1.0).finished())};
  EXPECT_EQ(write_moved_sequence(temp / "out", from, moved), 2U);  // the second image has no pose
  const Sequence to = Sequence::open(temp / "out");
  EXPECT_EQ(to.layout(), "tum");
  ASSERT_EQ(to.size(), 2U);
  EXPECT_EQ(to.camera(), from.camera());
  EXPECT_EQ(to.camera_file().distortion, from.camera_file().distortion);
  EXPECT_EQ(to.truth().size(), 3U);
  EXPECT_EQ(to.time_text(1), "1.400");
  for (const std::size_t i : {0U, 1U}) {
    const std::size_t j = 2 * i;
    EXPECT_LT(((moved * *from.T_world_camera(j)).inverse() * *to.T_world_camera(i)).log().norm(), 1e-8);
    EXPECT_LT(((moved * *from.T_world_depth(j)).inverse() * *to.T_world_depth(i)).log().norm(), 1e-8);
    EXPECT_EQ(to.color(i)(5, 5), from.color(j)(5, 5));
    // The depth scales with the world.
    const double depth = to.depth(i)(5, 5);
    EXPECT_NEAR(depth, 2.5 * static_cast<double>(from.depth(j)(5, 5)), 1e-6);
  }
  std::filesystem::remove_all(temp / "seq/depth");
  EXPECT_EQ(write_moved_sequence(temp / "out", Sequence::open(temp / "seq"), moved), 2U);
  EXPECT_FALSE(std::filesystem::exists(temp / "out/depth.txt"));
}

TEST(MovedSequence, RefusesWhatHasNoPose) {
  const TempFolder temp;
  temp.put_image("seq/1.png", cv::Mat3b(12, 16, cv::Vec3b::all(40)));
  temp.put("seq/camera.yaml", "width: 16\nheight: 12\nfx: 20\nfy: 21\ncx: 7.5\ncy: 5.5\n");
  const Sequence sequence = Sequence::open(temp / "seq");
  EXPECT_THAT(error_of([&] { write_moved_sequence(temp / "out", sequence, {}); }), HasSubstr("no frame has a pose"));
  EXPECT_FALSE(std::filesystem::exists(temp / "out"));
}

}  // namespace
}  // namespace odosplat
