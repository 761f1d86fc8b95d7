// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/edit/merge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/splat/blend_order.hpp"
#include "odosplat/splat/edit/crop.hpp"
#include "odosplat/splat/edit/edited_header.hpp"
#include "odosplat/splat/gaussian_view.hpp"
#include "odosplat/splat/kept_gaussians.hpp"
#include "tests/splat/corner_scene.hpp"
#include "tests/splat/edit/room_map.hpp"

namespace odosplat {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

/// The part of a map with x in a range [m].
Map part(const Map& map, double from, double to) {
  return {kept_gaussians(map.gaussians, in_box(map.gaussians, {{from, -9.0, -9.0}, {to, 9.0, 9.0}, SE3()})),
          map.header};
}

MapHeader with_notes(const MapHeader& header, std::vector<std::string> more) {
  more.insert(more.end(), header.notes.begin(), header.notes.end());
  return MapHeader::from_notes(more);
}

struct Difference {
  double psnr_db = 1e9;       // of the worst view
  float depth_sigmas = 0.0F;  // median of the worst view
  double holes = 0.0;         // largest share of pixels with depth in a alone
};

Difference difference(const Map& a, const Map& b) {
  const auto context = compute::Context::open();
  GaussianView view_a(context, a);
  GaussianView view_b(context, b);
  Difference worst;
  for (const EditView& view : test::room_views()) {
    const ViewImages x = view_a.render(view.camera, view.T_world_camera, {true, false});
    const ViewImages y = view_b.render(view.camera, view.T_world_camera, {true, false});
    worst.psnr_db = std::min(worst.psnr_db, test::psnr_db(y.color, x.color));
    std::vector<float> sigmas;
    int holes = 0;
    for (int v = 0; v < x.depth.rows; ++v) {
      for (int u = 0; u < x.depth.cols; ++u) {
        if (!(x.depth(v, u) > 0.0F)) continue;
        if (!(y.depth(v, u) > 0.0F)) {
          ++holes;
        } else {
          sigmas.push_back(std::abs(x.depth(v, u) - y.depth(v, u)) / x.sigma(v, u));
        }
      }
    }
    worst.depth_sigmas = std::max(worst.depth_sigmas, upper_median(std::move(sigmas)));
    worst.holes = std::max(worst.holes, static_cast<double>(holes) / static_cast<double>(x.depth.total()));
  }
  return worst;
}

TEST(MergeMaps, OfOverlappingHalvesIsTheWhole) {
  const Map whole = test::room_map();
  const MergedMap merged = merge_maps({{"left", part(whole, -9.0, 2.43)}, {"right", part(whole, 1.61, 9.0)}});
  const auto n = static_cast<double>(whole.gaussians.size());
  EXPECT_NEAR(static_cast<double>(merged.map.gaussians.size()), n, 0.01 * n);
  EXPECT_EQ(merged.kept[0] + merged.kept[1], merged.map.gaussians.size());
  EXPECT_GT(merged.overlaps[0].pairs, 1000U);
  EXPECT_LT(merged.overlaps[0].sigmas, 0.01);
  EXPECT_TRUE(merged.warnings.empty());
  const Difference d = difference(whole, merged.map);
  EXPECT_GT(d.psnr_db, 45.0);
  EXPECT_LT(d.depth_sigmas, 0.05F);
  EXPECT_EQ(d.holes, 0.0);
}

TEST(MergeMaps, OfThreeParts) {
  const Map whole = test::room_map();
  const MergedMap merged =
      merge_maps({{"a", part(whole, -9, 1.5)}, {"b", part(whole, 1.0, 3.0)}, {"c", part(whole, 2.5, 9.0)}});
  const auto n = static_cast<double>(whole.gaussians.size());
  EXPECT_NEAR(static_cast<double>(merged.map.gaussians.size()), n, 0.01 * n);
  EXPECT_GT(difference(whole, merged.map).psnr_db, 45.0);
}

TEST(MergeMaps, DoesNotDoubleSurfacesOfTwoScans) {
  const Map a = test::room_map(1, 0.004);
  const Map b = test::room_map(2, 0.004);
  const MergedMap merged = merge_maps({{"a", part(a, -9.0, 2.6)}, {"b", part(b, 1.4, 9.0)}});
  EXPECT_TRUE(merged.warnings.empty()) << merged.warnings.front();
  EXPECT_GT(merged.overlaps[0].pairs, 1000U);
  EXPECT_LT(merged.overlaps[0].sigmas, 3.0);
  // As many as in one scan, or between the two; the parts together have 1.3 times as many.
  const auto least = static_cast<double>(std::min(a.gaussians.size(), b.gaussians.size()));
  const auto most = static_cast<double>(std::max(a.gaussians.size(), b.gaussians.size()));
  EXPECT_GT(static_cast<double>(merged.map.gaussians.size()), 0.98 * least);
  EXPECT_LT(static_cast<double>(merged.map.gaussians.size()), 1.02 * most);
  const Difference d = difference(a, merged.map);
  EXPECT_LT(d.depth_sigmas, 1.0F);
  EXPECT_LT(d.holes, 0.002);
}

TEST(MergeMaps, TakesTheBetterMap) {
  const Map rough = test::room_map(1, 0.004);
  Map fine = test::room_map(2, 0.001);
  std::vector<std::string> notes = fine.header.notes;
  std::erase_if(notes, [](const std::string& line) { return line.starts_with("sigma_"); });
  for (const std::string& line : SigmaModel{0.5F, 0.2F, 0.0005F, 0.01F}.to_lines()) notes.push_back(line);
  fine.header = MapHeader::from_notes(notes);
  const MergedMap merged = merge_maps({{"rough", rough}, {"fine", fine}});
  EXPECT_GT(static_cast<double>(merged.kept[1]), 0.95 * static_cast<double>(fine.gaussians.size()));
  EXPECT_LT(static_cast<double>(merged.kept[0]), 0.05 * static_cast<double>(rough.gaussians.size()));
  ASSERT_TRUE(merged.map.header.sigma);
  EXPECT_EQ(merged.map.header.sigma->spread, 1.0F);  // the more careful of both, factor by factor
  EXPECT_EQ(merged.map.header.sigma->slope_px, 0.2F);
  EXPECT_EQ(merged.map.header.sigma->depth_share, 0.002F);
}

TEST(MergeMaps, RefusesMapsOfDifferentFramesAndWarnsOfSmallShifts) {
  const Map map = test::room_map();
  for (const Eigen::Vector3f& by : {Eigen::Vector3f(0.06F, 0, 0), Eigen::Vector3f(0, 0, -0.06F)}) {
    const std::vector<MergeSource> apart{{"a.ply", map}, {"b.ply", test::moved(map, by)}};
    try {
      merge_maps(apart);
      ADD_FAILURE() << "not refused";
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), StartsWith("b.ply: its surfaces lie "));
      EXPECT_THAT(e.what(), HasSubstr("different frames (run align)"));
      EXPECT_THAT(e.what(), HasSubstr("--force"));
    }
    MergeOptions options;
    options.force = true;
    EXPECT_THAT(merge_maps(apart, options).warnings, Contains(HasSubstr("different frames")));
  }
  const MergedMap near = merge_maps({{"a", map}, {"b", test::moved(map, {0.022F, 0, 0})}});
  EXPECT_THAT(near.warnings, Contains(HasSubstr("different frames")));
  // Walls are out of reach, floor and ceiling agree.
  const MergedMap along_floor = merge_maps({{"a", map}, {"b", test::moved(map, {0.5F, 0, 0})}});
  EXPECT_THAT(along_floor.warnings, Contains("b: surfaces that face x do not meet: the maps may be of different frames "
                                             "(align)"));
  EXPECT_FALSE(along_floor.overlaps[0].unmet[2]);
  Map elsewhere = test::moved(map, {100.0F, 0, 0});
  EXPECT_THAT(merge_maps({{"a", map}, {"b", elsewhere}}).warnings, Contains(HasSubstr("holds no surface")));
}

TEST(MergeMaps, ComparesBrightness) {
  const Map map = test::room_map();
  Map bright = map;
  for (std::size_t i = 0; i < bright.gaussians.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) bright.gaussians.sh[12 * i + c] += 0.1F / sh_constant;
  }
  const MergedMap merged = merge_maps({{"a", map}, {"b", bright}});
  EXPECT_NEAR(merged.overlaps[0].gray, 0.1, 0.01);
  EXPECT_THAT(merged.warnings, Contains(HasSubstr("0.10 brighter")));
  for (std::size_t i = 0; i < bright.gaussians.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) bright.gaussians.sh[12 * i + c] += 0.3F / sh_constant;
  }
  EXPECT_THROW(merge_maps({{"a", map}, {"b", bright}}), InputError);
}

TEST(MergeMaps, RefusesWhatCannotBeOneMap) {
  const Map map = test::room_map();
  EXPECT_THROW(merge_maps({{"a", map}}), InputError);
  EXPECT_THROW(merge_maps({{"a", map}, {"b", {}}}), InputError);
  Map other = map;
  other.header = with_notes(map.header, {blend_order_line(BlendOrder::distance)});
  EXPECT_THROW(merge_maps({{"a", map}, {"b", other}}), InputError);
  MergeOptions options;
  options.force = true;
  const MergedMap forced = merge_maps({{"a", other}, {"b", map}}, options);
  EXPECT_EQ(forced.map.header.rasterizer.order, BlendOrder::distance);
  EXPECT_THAT(forced.warnings, Contains(HasSubstr("order of blending")));
}

TEST(MergeMaps, PadsHarmonicsAndIsTheSameForAnyNumberOfThreads) {
  const Map a = test::room_map(1, 0.004);
  Map b = test::room_map(2, 0.004);
  b.gaussians = with_sh_degree(b.gaussians, 2);
  const int before = threads();
  set_threads(1);
  const Map one = merge_maps({{"a", a}, {"b", b}}).map;
  set_threads(3);
  const Map three = merge_maps({{"a", a}, {"b", b}}).map;
  set_threads(before);
  EXPECT_EQ(one.gaussians.sh_degree, 2);
  one.gaussians.check();
  EXPECT_EQ(one.gaussians.positions, three.gaussians.positions);
  EXPECT_EQ(one.gaussians.sh, three.gaussians.sh);
}

TEST(MergedHeader, SaysWhereTheMapComesFrom) {
  const Map map = test::room_map();
  MapQuality good;
  good.verdict = "good: 30.0 dB";
  good.good = true;
  good.images = 10;
  MapQuality bad;
  bad.verdict = "doubtful: only 12.0 dB";
  const std::vector<std::string> frames_a{"training_frames 10 0 600 1100 kt3", "seed 1", "iterations 4000"};
  const std::vector<std::string> frames_b{"training_frames 10 500 1100 1100 kt3", "seed 2", "iterations 4000"};
  MapHeader a = with_notes(with_notes(map.header, frames_a), good.to_lines());
  MapHeader b = with_notes(with_notes(map.header, frames_b), good.to_lines());
  const MapHeader merged = merged_header({{"a.ply", a, 10, 9}, {"b.ply", with_edit(b, "crop: x"), 20, 3}});
  EXPECT_FALSE(merged.quality);
  EXPECT_THAT(merged.notes, Contains("iterations 4000"));
  EXPECT_THAT(merged.notes, Contains("source 1 seed 1"));
  EXPECT_THAT(merged.notes, Contains("source 2 seed 2"));
  EXPECT_THAT(merged.notes, Contains("source 2 edit crop: x"));
  EXPECT_THAT(merged.notes, Contains("source 2 b.ply: 3 of 20 Gaussians; quality good: 30.0 dB"));
  EXPECT_THAT(merged.notes, Contains(frames_a[0]));
  EXPECT_THAT(merged.notes, Contains(frames_b[0]));
  EXPECT_THAT(edits_of(merged), testing::ElementsAre("merge: a.ply and b.ply"));
  EXPECT_EQ(merged.places.size(), map.header.places.size());
  const MapHeader doubtful =
      merged_header({{"a.ply", a, 1, 1}, {"b.ply", with_notes(map.header, bad.to_lines()), 1, 1}});
  ASSERT_TRUE(doubtful.quality);
  EXPECT_FALSE(doubtful.quality->good);
  EXPECT_THAT(doubtful.quality->verdict, HasSubstr("b.ply is doubtful: only 12.0 dB"));
}

TEST(EditedHeader, KeepsAllAndGetsALine) {
  const MapHeader before = test::room_map().header;
  const MapHeader after = with_edit(with_edit(before, "crop: one"), "clean: two");
  EXPECT_THAT(edits_of(after), testing::ElementsAre("crop: one", "clean: two"));
  EXPECT_EQ(after.notes.size(), before.notes.size() + 2);
  EXPECT_EQ(after.places.size(), before.places.size());
  EXPECT_EQ(after.sigma->depth_share, before.sigma->depth_share);
}

}  // namespace
}  // namespace odosplat
