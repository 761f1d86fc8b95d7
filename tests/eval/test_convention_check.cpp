// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/convention_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

using testing::HasSubstr;

const Camera camera_160{160, 120, 130.0, 128.0, 79.0, 60.5};

// Depth of a room with a block in it, seen from T_world_camera; the scene has no symmetry.
DepthImage room_depth(const SE3& T_world_camera) {
  const Eigen::Vector3d low(-2.0, -1.2, -2.0);
  const Eigen::Vector3d high(1.7, 1.5, 3.0);
  const Eigen::Vector3d block_low(-0.3, 0.5, 1.6);
  const Eigen::Vector3d block_high(0.8, 1.5, 2.3);
  const Eigen::Vector3d eye = T_world_camera.translation();
  DepthImage depth(camera_160.height, camera_160.width);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const Eigen::Vector3d ray = T_world_camera.rotation() * camera_160.ray(x, y);
      double room = std::numeric_limits<double>::infinity();
      double enter = 0.0;
      double leave = std::numeric_limits<double>::infinity();
      for (int axis = 0; axis < 3; ++axis) {
        room = std::min(room, ((ray[axis] > 0.0 ? high : low)[axis] - eye[axis]) / ray[axis]);
        const double a = (block_low[axis] - eye[axis]) / ray[axis];
        const double b = (block_high[axis] - eye[axis]) / ray[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      depth(y, x) = static_cast<float>(enter > 0.0 && enter < leave ? std::min(enter, room) : room);
    }
  }
  return depth;
}

SE3 hand_held(int i) {
  const double t = i / 30.0;
  const double wobble = 0.05 * std::sin(9.0 * t);
  return SE3::exp((Vector6d() << 0.5 * std::sin(1.5 * t), 0.2 * std::sin(2.0 * t) + wobble, 0.3 * std::sin(t * t),
                   0.25 * std::sin(1.7 * t), 0.4 * std::sin(1.1 * t + 0.3) + wobble, 0.1 * std::sin(2.3 * t))
                      .finished());
}

struct World {
  ConventionInput input;
  std::vector<DepthImage> images;
};

template <typename Path>
World make_world(int n, const Path& path) {
  World world;
  for (int i = 0; i < n; ++i) {
    world.input.T_world_camera.push_back(path(i));
    world.images.push_back(room_depth(path(i)));
  }
  world.input.camera = camera_160;
  world.input.depth_scale = 1000.0;
  world.input.depth = [images = world.images](std::size_t i) { return images[i]; };
  return world;
}

const World& room() {
  static const World world = make_world(60, hand_held);
  return world;
}

SE3 reflected_by_matrices(const SE3& T) {
  const Eigen::Matrix4d F = Eigen::Vector4d(1, -1, 1, 1).asDiagonal();
  return SE3::from_matrix(F * T.matrix() * F);
}

TEST(CheckConventions, AgreesWithRightData) {
  const ConventionReport r = check_conventions(room().input);
  EXPECT_TRUE(r.as_declared) << r.verdict;
  EXPECT_EQ(r.gap, 20);
  EXPECT_LT(r.winner_error_m, 0.01);
  EXPECT_THAT(r.verdict, HasSubstr("agree"));
  for (const ConventionFinding& f : r.findings) EXPECT_TRUE(f.decided && f.as_declared) << f.text;
  EXPECT_EQ(r.rows.size(), 2U * 2U * 3U * 5U);
  for (std::size_t i = 1; i < r.rows.size(); ++i) EXPECT_LE(r.rows[i - 1].relative_error, r.rows[i].relative_error);
}

TEST(CheckConventions, FindsAFlippedFy) {
  ConventionInput input = room().input;
  input.fy_sign = -1;
  const ConventionReport r = check_conventions(input);
  EXPECT_FALSE(r.as_declared);
  EXPECT_EQ(r.winner.fy_sign, 1);
  EXPECT_THAT(r.verdict, HasSubstr("fy: the data want +128.0, the file says -128.0"));
}

TEST(CheckConventions, FindsReflectedPosesAsTheOtherSignOfFy) {
  ConventionInput input = room().input;
  for (auto& pose : input.T_world_camera) *pose = reflected_by_matrices(*pose);
  const ConventionReport r = check_conventions(input);
  EXPECT_THAT(r.verdict, HasSubstr("fy: the data want -128.0, the file says +128.0"));
  EXPECT_THAT(r.verdict, HasSubstr("reflect the poses"));
  input.fy_sign = -1;  // as in ICL-NUIM: with a negative fy declared the poses are right
  EXPECT_TRUE(check_conventions(input).as_declared);
}

TEST(CheckConventions, FindsInvertedPoses) {
  ConventionInput input = room().input;
  for (auto& pose : input.T_world_camera) *pose = pose->inverse();
  const ConventionReport r = check_conventions(input);
  EXPECT_TRUE(r.winner.inverted);
  EXPECT_THAT(r.verdict, HasSubstr("poses: the data want inverted, the file says as stored"));
}

TEST(CheckConventions, FindsShiftedIds) {
  for (const int shift : {-1, 1}) {
    ConventionInput input = room().input;
    const std::vector<std::optional<SE3>> right = input.T_world_camera;
    const int n = static_cast<int>(right.size());
    for (int i = 0; i < n; ++i) {
      // The pose of image i is stored at i + shift.
      const int from = i - shift;
      input.T_world_camera[static_cast<std::size_t>(i)] =
          from >= 0 && from < n ? right[static_cast<std::size_t>(from)] : std::nullopt;
    }
    const ConventionReport r = check_conventions(input);
    EXPECT_EQ(r.winner.id_shift, shift);
    EXPECT_THAT(r.verdict, HasSubstr(shift > 0 ? "id shift: the data want +1" : "id shift: the data want -1"));
  }
}

TEST(CheckConventions, FindsAWrongDepthScaleEitherWay) {
  for (const double declared : {5000.0, 256.0, 1234.0}) {
    ConventionInput input = room().input;
    input.depth_scale = declared;
    input.depth = [&](std::size_t i) { return DepthImage(room().images[i] * (1000.0 / declared)); };
    const ConventionReport r = check_conventions(input);
    EXPECT_EQ(r.winner.depth_scale, 1000.0);
    EXPECT_THAT(r.verdict, HasSubstr("depth scale: the data want 1000, the file says"));
  }
}

TEST(CheckConventions, NamesSeveralFaultsAtOnce) {
  ConventionInput input = room().input;
  input.fy_sign = -1;
  for (auto& pose : input.T_world_camera) *pose = pose->inverse();
  const ConventionReport r = check_conventions(input);
  EXPECT_THAT(r.verdict, HasSubstr("fy: the data want"));
  EXPECT_THAT(r.verdict, HasSubstr("poses: the data want"));
}

TEST(CheckConventions, DoesNotGuessWhereTheDataCannotTell) {
  // Constant velocity: the motion over 20 frames is the same at every frame, so a shift has no effect.
  const Vector6d step = (Vector6d() << 0.006, -0.004, 0.005, 0.004, 0.005, -0.003).finished();
  const World steady = make_world(40, [&](int i) { return SE3::exp(i * step); });
  const ConventionReport r = check_conventions(steady.input);
  EXPECT_TRUE(r.as_declared) << r.verdict;
  EXPECT_THAT(r.verdict, HasSubstr("id shift: not decidable"));
  EXPECT_FALSE(r.findings[2].decided);
  EXPECT_TRUE(r.findings[0].decided);

  // Pure rotation does not depend on the scale.
  const World turning = make_world(40, [](int i) { return SE3(hand_held(2 * i).rotation(), Eigen::Vector3d::Zero()); });
  const ConventionReport t = check_conventions(turning.input);
  EXPECT_TRUE(t.as_declared) << t.verdict;
  EXPECT_THAT(t.verdict, HasSubstr("depth scale: not decidable"));

  // No motion: all conventions fit, so no part is decided.
  const World still = make_world(6, [](int) { return SE3(); });
  const ConventionReport s = check_conventions(still.input);
  EXPECT_TRUE(s.as_declared) << s.verdict;
  for (const ConventionFinding& f : s.findings) EXPECT_FALSE(f.decided) << f.part;
}

TEST(CheckConventions, ADepthScaleThatShrinksTheSceneDoesNotWin) {
  // Slow motion and a noisy sensor: the smallest scene has the smallest error in metres, which must not decide; the
  // error relative to depth does.
  const World slow = make_world(60, [](int i) {
    const SE3 T = hand_held(i);
    return SE3(T.rotation(), 0.3 * T.translation());
  });
  ConventionInput input = slow.input;
  input.depth = [&](std::size_t i) {
    Random random(i);
    DepthImage depth = slow.images[i].clone();
    for (float& z : depth) z *= static_cast<float>(1.0 + 0.03 * random.normal());
    return depth;
  };
  const ConventionReport r = check_conventions(input);
  bool smaller_in_metres = false;
  for (const ConventionRow& row : r.rows) {
    smaller_in_metres |= row.convention.depth_scale > 1000.0 && row.error_m < r.winner_error_m;
  }
  EXPECT_TRUE(smaller_in_metres) << "the test does not test";
  EXPECT_TRUE(r.as_declared) << r.verdict;
}

TEST(CheckConventions, BelievesNothingThatDoesNotFit) {
  ConventionInput input = room().input;
  input.depth = [](std::size_t i) {
    Random random(i);
    DepthImage depth(120, 160);
    for (float& z : depth) z = static_cast<float>(random.uniform(1.0, 4.0));
    return depth;
  };
  const ConventionReport r = check_conventions(input);
  EXPECT_FALSE(r.believable);
  EXPECT_FALSE(r.as_declared);
  EXPECT_THAT(r.verdict, HasSubstr("no convention fits"));
}

TEST(CheckConventions, CopesWithShortSequencesAndMissingPoses) {
  ConventionInput input = room().input;
  input.T_world_camera.resize(4);
  EXPECT_EQ(check_conventions(input).gap, 1);
  EXPECT_TRUE(check_conventions(input).as_declared);
  input = room().input;
  for (std::size_t i = 0; i < 60; i += 7) input.T_world_camera[i] = std::nullopt;
  EXPECT_TRUE(check_conventions(input).as_declared);
}

TEST(CheckConventions, ShrinksTheGapUntilImagesOverlap) {
  // 9 degrees per frame: after 20 frames the camera looks in the opposite direction.
  const World spin = make_world(60, [](int i) {
    return SE3(so3_exp(Eigen::Vector3d(0.02 * std::sin(0.3 * i), 0.157 * i, 0.0)),
               Eigen::Vector3d(0.3 * std::sin(0.2 * i), 0.1 * std::cos(0.15 * i), 0.2 * std::sin(0.11 * i)));
  });
  ConventionOptions options;
  options.depth_scales = {1000.0};
  options.min_overlap = 0.6;
  const ConventionReport r = check_conventions(spin.input, options);
  EXPECT_LT(r.gap, 20);
  EXPECT_TRUE(r.as_declared) << r.verdict;
}

TEST(CheckConventions, AGapWithoutOverlapIsNotTakenForAMisfit) {
  // So fast that after 20 frames images overlap by chance under wrong conventions, but not under the right one.
  const World fast = make_world(60, [](int i) {
    return SE3(so3_exp(Eigen::Vector3d(0.02 * std::sin(0.3 * i), 0.1 * i, 0.0)),
               Eigen::Vector3d(0.8 * std::sin(0.2 * i), 0.1 * std::cos(0.15 * i), 0.9 * std::sin(0.11 * i)));
  });
  const ConventionReport r = check_conventions(fast.input);
  EXPECT_TRUE(r.gap_reduced);
  EXPECT_LT(r.gap, 20);
  EXPECT_TRUE(r.as_declared) << r.verdict;
}

TEST(CheckConventions, AMisfitIsNotHiddenBySmallerGaps) {
  // A wrong focal length, whose effect would be small for little motion.
  ConventionInput input = room().input;
  input.camera.fx *= 1.4;
  input.camera.fy *= 1.4;
  ConventionOptions options;
  options.max_error = 0.01;
  const ConventionReport r = check_conventions(input, options);
  EXPECT_FALSE(r.gap_reduced) << r.verdict;
  EXPECT_FALSE(r.believable) << r.verdict;
}

TEST(CheckConventions, RefusesWhatCannotBeJudged) {
  ConventionInput input = room().input;
  input.T_world_camera.assign(60, std::nullopt);
  EXPECT_THROW(check_conventions(input), InputError);
  input = room().input;
  input.depth = [](std::size_t) { return DepthImage(10, 10, 1.0F); };
  EXPECT_THROW(check_conventions(input), InputError);
  input.depth = [](std::size_t) { return DepthImage(120, 160, 0.0F); };
  EXPECT_THROW(check_conventions(input), InputError);
  input = room().input;
  input.fy_sign = 0;
  EXPECT_THROW(check_conventions(input), InputError);
}

TEST(CheckConventions, SameBitsWhateverTheThreads) {
  const int before = threads();
  set_threads(1);
  const ConventionReport one = check_conventions(room().input);
  set_threads(3);
  const ConventionReport three = check_conventions(room().input);
  set_threads(before);
  ASSERT_EQ(one.rows.size(), three.rows.size());
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    EXPECT_EQ(one.rows[i].convention, three.rows[i].convention);
    EXPECT_EQ(one.rows[i].error_m, three.rows[i].error_m);
  }
}

TEST(ConventionTable, ShowsTheWinnerAndTheDeclaredRow) {
  ConventionInput input = room().input;
  input.fy_sign = -1;
  const ConventionReport r = check_conventions(input);
  const std::string table = convention_table(r, camera_160, 1);
  EXPECT_THAT(table, HasSubstr("*    +128.0  as stored         0         1000"));
  EXPECT_THAT(table, HasSubstr(" d   -128.0  as stored         0         1000"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
}

}  // namespace
}  // namespace odosplat
