// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/quality/map_quality.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "odosplat/core/error.hpp"
#include "odosplat/map/interpolation_view.hpp"
#include "odosplat/splat/train/initialize.hpp"
#include "tests/splat/corner_scene.hpp"

namespace odosplat {
namespace {

using test::CornerScene;
using test::CornerViews;
using testing::HasSubstr;

/// The corner's images with wrong poses or a wrong camera.
class WrongViews : public CornerViews {
 public:
  WrongViews() : CornerViews(8) {}
  bool inverted = false;
  double focal = 1.0;
  Camera camera(int i) const override {
    Camera camera = CornerViews::camera(i);
    camera.fx *= focal;
    camera.fy *= focal;
    return camera;
  }
  SE3 T_world_camera(int i) const override {
    const SE3 T = CornerViews::T_world_camera(i);
    return inverted ? T.inverse() : T;
  }
};

std::vector<ViewQuality> even_views(std::size_t n) {
  std::vector<ViewQuality> views(n);
  for (std::size_t i = 0; i < n; ++i)
    views[i] = {30.0 + 0.3 * static_cast<double>(i % 3), 0.004, 0.002 + 0.0001 * static_cast<double>(i % 4), 1.0,
                false};
  return views;
}

TEST(MarkOdd, FindsWhatDisagreesAndNothingElse) {
  auto views = even_views(20);
  mark_odd(views);
  for (const ViewQuality& view : views) EXPECT_FALSE(view.odd);
  views[3].psnr_db = 21.0;
  views[7].depth_error_share = 0.05;
  mark_odd(views);
  for (std::size_t i = 0; i < views.size(); ++i) EXPECT_EQ(views[i].odd, i == 3 || i == 7) << i;
}

TEST(JudgeMap, NamesFaultAndLikelyCause) {
  EXPECT_TRUE(judge_map(even_views(10), {}, 0.1, std::nullopt).good);
  auto low = even_views(10);
  for (ViewQuality& view : low) view.psnr_db = 12.0;
  const MapQuality unlike = judge_map(low, {}, 0.1, std::nullopt);
  EXPECT_FALSE(unlike.good);
  EXPECT_THAT(unlike.verdict, testing::StartsWith("doubtful: only 12.0 dB"));
  const MapQuality inverted =
      judge_map(low, {}, 0.9, GeometryDoubt{.hypothesis = {.inverted = true}, .as_given = 0.9, .instead = 0.1});
  EXPECT_THAT(inverted.verdict, HasSubstr("likely cause: the poses are inverted"));
  EXPECT_THAT(judge_map(even_views(10), {}, 0.34, std::nullopt).verdict,
              HasSubstr("the calibration of another camera"));
  EXPECT_TRUE(judge_map(even_views(10), {}, -1.0, std::nullopt).good);  // negative: unknown
  auto off = even_views(10);
  for (ViewQuality& view : off) view.depth_error_share = 0.1;
  EXPECT_THAT(judge_map(off, {}, 0.1, std::nullopt).verdict, HasSubstr("10.0 % off the cloud's"));
  auto moved = even_views(10);
  for (std::size_t i = 0; i < 4; ++i) moved[i].odd = true;
  EXPECT_THAT(judge_map(moved, {}, 0.1, std::nullopt).verdict, HasSubstr("4 of 10 images disagree"));
  EXPECT_FALSE(judge_map({}, {}, 0.1, std::nullopt).good);
}

TEST(JudgeMap, DoesNotJudgeWhatHasNotBeenShown) {
  for (const std::size_t n : {1U, 2U}) {
    const MapQuality few =
        judge_map(even_views(n), {}, 0.1, std::nullopt, {.iterations = 400, .usual_iterations = 400});
    EXPECT_FALSE(few.good);
    EXPECT_THAT(few.verdict, testing::StartsWith("not judged: it was trained on " + std::to_string(n) + " image"));
  }
  const MapQuality untrained =
      judge_map(even_views(10), {}, 0.1, std::nullopt, {.iterations = 0, .usual_iterations = 4000});
  EXPECT_FALSE(untrained.good);
  EXPECT_THAT(untrained.verdict, testing::StartsWith("not judged: no step of training"));
  EXPECT_THAT(judge_map(even_views(10), {}, 0.1, std::nullopt).verdict,
              HasSubstr("dB on the 10 images it was trained on"));
}

TEST(JudgeMap, NamesOnlyCausesThatTheEvidenceBears) {
  auto low = even_views(10);
  for (ViewQuality& view : low) view.psnr_db = 12.0;
  const TrainingEvidence full{.iterations = 4000, .usual_iterations = 4000, .gaussians = 9000, .points = 9000};
  const std::string unknown = judge_map(low, {}, 0.1, std::nullopt, full).verdict;
  EXPECT_THAT(unknown, HasSubstr("cause unknown"));
  EXPECT_THAT(unknown, testing::Not(HasSubstr("likely cause")));
  TrainingEvidence brief = full;
  brief.iterations = 100;
  const std::string early = judge_map(low, {}, 0.1, std::nullopt, brief).verdict;
  EXPECT_THAT(early, HasSubstr("likely cause: training stopped after 100 of the preset's 4000 iterations"));
  EXPECT_THAT(early, testing::Not(HasSubstr("camera")));
  TrainingEvidence small = full;
  small.budget = small.gaussians = 500;
  const std::string budget = judge_map(low, {}, 0.1, std::nullopt, small).verdict;
  EXPECT_THAT(budget, HasSubstr("likely cause: a budget of 500 Gaussians for a cloud of 9000 points"));
  EXPECT_THAT(budget, testing::Not(HasSubstr("poses")));
  EXPECT_THAT(judge_map(low, {}, 0.9, std::nullopt, full).verdict, HasSubstr("likely cause: a cloud of another place"));
}

TEST(MapQuality, LinesGiveBackWhatTheyWereMadeOf) {
  CloudCoverage coverage{0.25, 7.0, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}};
  const MapQuality written = judge_map(even_views(10), coverage, 0.125, std::nullopt);
  auto lines = written.to_lines();
  lines.insert(lines.begin(), "iterations 400");
  const auto read = MapQuality::from_lines(lines);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->to_lines(), written.to_lines());
  EXPECT_EQ(read->good, written.good);
  EXPECT_FALSE(MapQuality::from_lines({"iterations 400", "sigma_spread 1"}));
  EXPECT_THROW(MapQuality::from_lines({"quality_verdict good", "quality_psnr_db fine"}), InputError);
}

TEST(CloudCoverage, CountsWhatNoImageSees) {
  const CornerViews views(4);
  PointCloud cloud = CornerScene().cloud(0.1);
  const CloudCoverage before = cloud_coverage(cloud, views);
  const std::size_t n = cloud.size();
  // The same number of points behind the cameras.
  for (std::size_t i = 0; i < n; ++i) {
    cloud.points.emplace_back(cloud.points[i].x(), cloud.points[i].y(), -5.0F - cloud.points[i].z());
    cloud.colors.push_back(cloud.colors[i]);
    cloud.normals.push_back(cloud.normals[i]);
  }
  const CloudCoverage after = cloud_coverage(cloud, views);
  EXPECT_NEAR(after.unseen_share, 0.5 + 0.5 * before.unseen_share, 0.01);
  EXPECT_GE(after.images_a_point, 1.0);
  EXPECT_GT(after.directions[4], 0.2);  // +z
  EXPECT_EQ(after.directions[5], 0.0);  // -z
  EXPECT_TRUE(any_in_view(cloud, views));
  for (Eigen::Vector3f& p : cloud.points) p.z() = -std::abs(p.z()) - 1.0F;
  EXPECT_FALSE(any_in_view(cloud, views));
}

TEST(ViewQualities, AreThoseOfTheMap) {
  CornerViews views(3);
  const auto context = compute::Context::open();
  PointCloud cloud = CornerScene().cloud(0.04);
  InterpolationView surface(cloud);
  const Gaussians gaussians = gaussians_from_cloud(cloud, {});
  const Exposures plain(context, {}, 3);
  const auto right = view_qualities(context, gaussians, views, &surface, plain, {.order = BlendOrder::distance});
  ASSERT_EQ(right.size(), 3U);
  for (const ViewQuality& view : right) {
    EXPECT_GT(view.psnr_db, 20.0);
    EXPECT_GT(view.covered, 0.9);
    EXPECT_GE(view.depth_error_m, 0.0);
    EXPECT_LT(view.depth_error_m, 0.01);
    EXPECT_LT(view.depth_error_share, 0.01);
  }
  for (Eigen::Vector3f& p : cloud.points) p.z() += 0.2F;
  InterpolationView off(cloud);
  for (const ViewQuality& view : view_qualities(context, gaussians, views, &off, plain, {})) {
    EXPECT_GT(view.depth_error_m, 0.1);
  }
  EXPECT_LT(view_qualities(context, gaussians, views, nullptr, plain, {})[0].depth_error_m, 0.0);
}

TEST(ColorConsistency, NamesWhatIsWrong) {
  const PointCloud cloud = CornerScene().cloud(0.03);
  {
    WrongViews views;
    const ColorConsistency right(cloud, views);
    EXPECT_LT(right.of({}).unexplained, 0.2);
    EXPECT_FALSE(geometry_doubt(right)) << geometry_doubt(right)->hypothesis.words();
  }
  {
    WrongViews views;
    views.inverted = true;
    const auto doubt = geometry_doubt(ColorConsistency(cloud, views));
    ASSERT_TRUE(doubt);
    EXPECT_TRUE(doubt->hypothesis.inverted) << doubt->hypothesis.words();
  }
  {
    WrongViews views;
    views.focal = 1.0 / 0.9;
    const auto doubt = geometry_doubt(ColorConsistency(cloud, views));
    ASSERT_TRUE(doubt);
    EXPECT_NEAR(doubt->hypothesis.focal, 0.9, 0.051) << doubt->hypothesis.words();
  }
  {  // a cloud of another shape: no hypothesis makes it fit
    WrongViews views;
    PointCloud other = cloud;
    for (Eigen::Vector3f& p : other.points) p = Eigen::Vector3f(p.y(), 0.7F * p.x(), 1.5F + 0.5F * p.z() * p.x());
    const auto doubt = geometry_doubt(ColorConsistency(other, views));
    EXPECT_FALSE(doubt) << doubt->hypothesis.words() << " " << doubt->instead;
  }
  for (const double times : {1000.0, 100.0}) {
    WrongViews views;
    PointCloud large = cloud;
    for (Eigen::Vector3f& p : large.points) p *= static_cast<float>(times);
    const auto doubt = geometry_doubt(ColorConsistency(large, views));
    ASSERT_TRUE(doubt) << times;
    EXPECT_EQ(doubt->hypothesis.unit, times) << doubt->hypothesis.words();
  }
  {
    WrongViews views;
    PointCloud off = cloud;
    const Eigen::Vector3f shift(0.2F, 0.1F, 0.0F);  // along the wall; towards it looks like another focal length
    for (Eigen::Vector3f& p : off.points) p += shift;
    const auto doubt = geometry_doubt(ColorConsistency(off, views));
    ASSERT_TRUE(doubt);
    // Along the wall a pixel is 3 cm; the offset in the viewing direction is hardly observable.
    const Eigen::Vector3d error = doubt->hypothesis.offset - shift.cast<double>();
    EXPECT_LT(error.head<2>().norm(), 0.05) << doubt->hypothesis.words();
  }
}

}  // namespace
}  // namespace odosplat
