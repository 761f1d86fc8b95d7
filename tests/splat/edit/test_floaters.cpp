// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/edit/floaters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "odosplat/cloud/neighbor_search.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/splat/edit/edited_header.hpp"
#include "odosplat/splat/edit/gaussian_shapes.hpp"
#include "tests/splat/edit/room_map.hpp"

namespace odosplat {
namespace {

std::size_t of(const std::vector<Floater>& floaters, Floater kind) {
  return count_floaters(floaters)[static_cast<std::size_t>(kind)];
}

/// Adds floaters in the room's air, at least three spacings from any Gaussian: balls of 1 to 10 cm, every tenth as
/// large as half a metre, every tenth almost transparent.
void plant(Gaussians& gaussians, std::size_t n, std::uint64_t seed) {
  const GaussianShapes shapes = gaussian_shapes(gaussians);
  const float spacing = upper_median(shapes.spacings);
  const NeighborSearch search(shapes.cloud.points);
  Random random(seed);
  for (std::size_t k = 0; k < n;) {
    const Eigen::Vector3f at(static_cast<float>(4.0 * random.uniform()), static_cast<float>(3.0 * random.uniform()),
                             static_cast<float>(2.5 * random.uniform()));
    int index = 0;
    float squared = 0.0F;
    search.nearest(at, 1, &index, &squared);
    if (std::sqrt(squared) < 3.0F * spacing) continue;
    const auto size = static_cast<float>(0.01 + 0.09 * random.uniform());
    test::add_ball(gaussians, at, k % 10 == 0 ? 0.5F : size, k % 10 == 1 ? 0.01F : 0.7F);
    ++k;
  }
}

TEST(FindFloaters, FindsPlantedOnesAndSparesTheRest) {
  Map room = test::room_map(1, 0.004);
  const std::size_t good = room.gaussians.size();
  const std::size_t planted = good / 50;
  plant(room.gaussians, planted, 5);
  const std::vector<Floater> floaters = find_floaters(room.gaussians);
  std::size_t found = 0;
  std::size_t lost = 0;
  for (std::size_t i = 0; i < floaters.size(); ++i) {
    if (floaters[i] != Floater::none) ++(i < good ? lost : found);
  }
  EXPECT_GE(static_cast<double>(found), 0.95 * static_cast<double>(planted));
  EXPECT_LE(static_cast<double>(lost), 0.005 * static_cast<double>(good));
  EXPECT_GE(of(floaters, Floater::transparent), planted / 10);
  EXPECT_GE(of(floaters, Floater::huge), 1U);
  EXPECT_GE(of(floaters, Floater::isolated), planted / 2);
  const int before = threads();
  set_threads(1);
  EXPECT_EQ(find_floaters(room.gaussians), floaters);
  set_threads(before);
}

TEST(FindFloaters, FindsHugeOnesThatStickOutOfASurface) {
  Map room = test::room_map();
  test::add_ball(room.gaussians, {3.97F, 1.5F, 1.2F}, 0.5F, 0.7F);
  EXPECT_EQ(find_floaters(room.gaussians).back(), Floater::huge);
}

TEST(FindFloaters, SparesADistantWall) {
  Map room = test::room_map();
  const std::size_t good = room.gaussians.size();
  // A wall whose Gaussians are 60 cm apart, as of a far building: twelve spacings of the room.
  for (int y = 0; y < 12; ++y) {
    for (int z = 0; z < 8; ++z) {
      test::add_ball(room.gaussians, {20.0F, 0.6F * static_cast<float>(y), 0.6F * static_cast<float>(z)}, 0.2F, 0.9F);
    }
  }
  const std::vector<Floater> floaters = find_floaters(room.gaussians);
  for (std::size_t i = good; i < floaters.size(); ++i) EXPECT_EQ(floaters[i], Floater::none) << i - good;
}

/// A sheet of Gaussians in the middle of the room, too dense to be isolated.
std::size_t add_sheet(Gaussians& gaussians, float opacity) {
  std::size_t n = 0;
  for (int a = 0; a < 12; ++a) {
    for (int b = 0; b < 12; ++b, ++n) {
      test::add_ball(gaussians, {2.9F, 1.2F + 0.04F * static_cast<float>(a), 1.2F + 0.04F * static_cast<float>(b)},
                     0.02F, opacity);
    }
  }
  return n;
}

TEST(FindFloaters, TakesOutWhatHangsBeforeTheMeasuredSurface) {
  Map room = test::room_map();
  const std::size_t good = room.gaussians.size();
  const std::size_t sheet = add_sheet(room.gaussians, 0.9F);
  EXPECT_EQ(count_floaters(find_floaters(room.gaussians))[0], room.gaussians.size());
  const auto context = compute::Context::open();
  const std::vector<Floater> floaters = find_floaters(context, room, test::room_views());
  std::size_t lost = 0;
  for (std::size_t i = 0; i < good; ++i) lost += floaters[i] != Floater::none ? 1 : 0;
  EXPECT_GE(of(floaters, Floater::hanging), sheet * 95 / 100);
  EXPECT_LE(static_cast<double>(lost), 0.005 * static_cast<double>(good));
}

TEST(FindFloaters, WithoutDepthImagesTakesOutWhatTheMapLetsThrough) {
  Map room = test::room_map();
  const std::size_t good = room.gaussians.size();
  std::vector<EditView> views = test::room_views();
  for (EditView& view : views) view.depth = nullptr;
  const auto context = compute::Context::open();
  EXPECT_LE(of(find_floaters(context, room, views), Floater::hanging), good / 200);
  Map solid = room;
  add_sheet(solid.gaussians, 0.9F);
  EXPECT_LE(of(find_floaters(context, solid, views), Floater::hanging), good / 200);  // it may be a thing
  const std::size_t sheet = add_sheet(room.gaussians, 0.1F);
  EXPECT_GE(of(find_floaters(context, room, views), Floater::hanging), sheet * 9 / 10);
}

TEST(WithoutFloaters, SaysWhatItDid) {
  Map room = test::room_map();
  test::add_ball(room.gaussians, {2.0F, 1.5F, 1.6F}, 0.03F, 0.9F);
  const Map cleaned = without_floaters(room, find_floaters(room.gaussians));
  EXPECT_EQ(cleaned.gaussians.size() + 1, room.gaussians.size());
  const std::string n = std::to_string(room.gaussians.size());
  EXPECT_THAT(edits_of(cleaned.header),
              testing::ElementsAre("clean: 0 almost transparent, 0 huge, 1 isolated, 0 in free space of " + n +
                                   " Gaussians removed"));
  EXPECT_THROW(without_floaters(room, std::vector<Floater>(room.gaussians.size(), Floater::huge)), InputError);
  EXPECT_TRUE(find_floaters(Gaussians()).empty());
  FloaterOptions options;
  options.least_views = 0;
  EXPECT_THROW(find_floaters(room.gaussians, options), InputError);
}

}  // namespace
}  // namespace odosplat
