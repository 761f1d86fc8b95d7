// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/registration_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

using testing::HasSubstr;

const Camera camera{240, 180, 200.0, 200.0, 119.5, 89.5};

// Boards in front of a wall, seen by a depth camera and a colour camera that may differ.
struct Board {
  double left, right, top, bottom;  // tangents of the rays to its edges
  float depth;                      // [m]
  float gray;
};

std::vector<Board> boards_of(std::size_t image) {
  Random random(image + 1);
  std::vector<Board> boards;
  for (int k = 0; k < 9; ++k) {
    const double u = random.uniform(-0.55, 0.45);
    const double v = random.uniform(-0.42, 0.3);
    boards.push_back({u, u + random.uniform(0.08, 0.2), v, v + random.uniform(0.08, 0.2),
                      static_cast<float>(random.uniform(1.0, 2.5)), static_cast<float>(random.uniform(0.1, 0.9))});
  }
  std::sort(boards.begin(), boards.end(), [](const Board& a, const Board& b) { return a.depth > b.depth; });
  return boards;
}

// The nearest board along a pixel's ray; nullptr: the wall.
const Board* board_at(const std::vector<Board>& boards, double x, double y) {
  const Board* nearest = nullptr;
  for (const Board& b : boards) {
    if (x >= b.left && x < b.right && y >= b.top && y < b.bottom) nearest = &b;
  }
  return nearest;
}

RegistrationInput scene(double focal_factor, double shift_x, double shift_y) {
  RegistrationInput input;
  input.camera = camera;
  input.images = 20;
  input.depth = [](std::size_t image) {
    const std::vector<Board> boards = boards_of(image);
    DepthImage depth(camera.height, camera.width);
    for (int y = 0; y < depth.rows; ++y) {
      for (int x = 0; x < depth.cols; ++x) {
        const Eigen::Vector3d ray = camera.ray(x, y);
        const Board* board = board_at(boards, ray.x(), ray.y());
        depth(y, x) = board ? board->depth : 4.0F;
      }
    }
    return depth;
  };
  input.gray = [=](std::size_t image) {
    const std::vector<Board> boards = boards_of(image);
    Random random(image + 100);
    GrayImage gray(camera.height, camera.width);
    for (int y = 0; y < gray.rows; ++y) {
      for (int x = 0; x < gray.cols; ++x) {
        const Eigen::Vector3d ray = camera.ray(x - shift_x, y - shift_y) / focal_factor;
        const Board* board = board_at(boards, ray.x(), ray.y());
        // Texture without depth edges, and noise.
        const double waves = 0.06 * std::sin(40.0 * ray.x() + 25.0 * ray.y()) + 0.05 * std::sin(70.0 * ray.y());
        gray(y, x) = (board ? board->gray : 0.5F) + static_cast<float>(waves + 0.01 * random.normal());
      }
    }
    return gray;
  };
  return input;
}

TEST(CheckRegistration, AgreesWithOneCamera) {
  const RegistrationReport r = check_registration(scene(1.0, 0.0, 0.0));
  EXPECT_EQ(r.registered, std::optional<bool>(true)) << r.text;
  EXPECT_NEAR(r.scale, 1.0, 0.005);
  EXPECT_LT(r.shift_px.norm(), 0.75);
  EXPECT_GT(r.edges, 2000U);
}

TEST(CheckRegistration, FindsAnotherFocalLength) {
  for (const double factor : {0.9, 1.06}) {
    const RegistrationReport r = check_registration(scene(factor, 0.0, 0.0));
    EXPECT_EQ(r.registered, std::optional<bool>(false)) << r.text;
    EXPECT_NEAR(r.scale, factor, 0.01) << r.text;
    EXPECT_LT(std::abs(r.scale - factor), 4.0 * r.scale_sigma);
    EXPECT_THAT(r.text, HasSubstr("not of one camera"));
  }
}

TEST(CheckRegistration, FindsACameraAside) {
  const RegistrationReport r = check_registration(scene(1.0, 6.0, -3.0));
  EXPECT_EQ(r.registered, std::optional<bool>(false)) << r.text;
  EXPECT_NEAR(r.shift_px.x(), 6.0, 0.75);
  EXPECT_NEAR(r.shift_px.y(), -3.0, 0.75);
}

TEST(CheckRegistration, LeavesASmallMisfitOpenAndSaysHowLargeItIs) {
  const RegistrationReport r = check_registration(scene(1.0, 3.0, -1.0));
  EXPECT_EQ(r.registered, std::nullopt) << r.text;
  EXPECT_NEAR(r.shift_px.x(), 3.0, 0.75);
  EXPECT_THAT(r.text, HasSubstr("not decidable whether they are from exactly the same camera"));
}

TEST(CheckRegistration, SaysNothingWhereTheImagesDoNotTell) {
  RegistrationInput flat = scene(1.0, 0.0, 0.0);
  flat.depth = [](std::size_t) { return DepthImage(camera.height, camera.width, 2.0F); };
  const RegistrationReport no_edges = check_registration(flat);
  EXPECT_EQ(no_edges.registered, std::nullopt);
  EXPECT_THAT(no_edges.text, HasSubstr("not decidable, depth has too few edges"));

  RegistrationInput unrelated = scene(1.0, 0.0, 0.0);
  unrelated.gray = [](std::size_t image) {
    Random random(image);
    GrayImage gray(camera.height, camera.width);
    for (float& g : gray) g = static_cast<float>(random.uniform(0.0, 1.0));
    return gray;
  };
  const RegistrationReport r = check_registration(unrelated);
  EXPECT_EQ(r.registered, std::nullopt) << r.text;
  EXPECT_THAT(r.text, HasSubstr("not decidable"));
}

TEST(CheckRegistration, RefusesOtherSizes) {
  RegistrationInput input = scene(1.0, 0.0, 0.0);
  input.gray = [](std::size_t) { return GrayImage(9, 9, 0.5F); };
  EXPECT_THROW(check_registration(input), InputError);
}

}  // namespace
}  // namespace odosplat
