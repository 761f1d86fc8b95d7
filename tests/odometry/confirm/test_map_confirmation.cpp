// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/confirm/map_confirmation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <memory>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

class MapConfirmationTest : public testing::Test {
 protected:
  ViewPatches patches(const SE3& T_world_view) {
    return ViewPatches(camera_, {T_world_view, room_.render(camera_, T_world_view, {true, false})}, 0.0, options_);
  }
  FramePyramid pyramid(const GrayImage& image) { return build_frame_pyramid(camera_, image, 0.0); }

  test::BoxRoom room_;
  Camera camera_ = test::small_camera();
  ConfirmationOptions options_;
};

/// The score of one level by its definition, in double precision: the correlation of every square of the view with the
/// image at the same place, both without the plane that fits them best.
double score_by_definition(const Camera& camera, const GrayImage& rendered, const DepthImage& depth,
                           const GrayImage& image, const SE3& T_camera_view, double min_texture, int& patches) {
  Eigen::MatrixXd basis(patch_pixels, 3);
  for (int k = 0; k < patch_pixels; ++k) basis.row(k) << 1.0, k % patch_side, k / patch_side;
  const Eigen::MatrixXd projector = Eigen::MatrixXd::Identity(patch_pixels, patch_pixels) -
                                    basis * (basis.transpose() * basis).inverse() * basis.transpose();
  double sum = 0.0;
  patches = 0;
  for (int top = 0; top + patch_side <= image.rows; top += patch_side) {
    for (int left = 0; left + patch_side <= image.cols; left += patch_side) {
      Eigen::VectorXd view(patch_pixels);
      Eigen::VectorXd seen(patch_pixels);
      bool inside = true;
      for (int k = 0; k < patch_pixels; ++k) {
        const int u = left + k % patch_side;
        const int v = top + k / patch_side;
        const Eigen::Vector3d p = T_camera_view * (static_cast<double>(depth(v, u)) * camera.ray(u, v));
        const Eigen::Vector2d uv = camera.project(p);
        inside = inside && uv.minCoeff() >= 0.0 && uv.x() <= image.cols - 1 && uv.y() <= image.rows - 1;
        if (!inside) break;
        view[k] = rendered(v, u);
        seen[k] = bilinear(image, static_cast<float>(uv.x()), static_cast<float>(uv.y()));
      }
      if (!inside) continue;
      view = projector * view;
      seen = projector * seen;
      const double least = patch_side * min_texture;
      if (view.norm() < least && seen.norm() < least) continue;
      const double floor = patch_side * 0.5 / 255;
      sum += view.dot(seen) / (std::max(floor, view.norm()) * std::max(floor, seen.norm()));
      ++patches;
    }
  }
  return sum / patches;
}

TEST_F(MapConfirmationTest, AgreesWithItsDefinition) {
  const SE3 T_world_view = test::room_path(10);
  const GrayImage image = room_.gray(camera_, test::room_path(14));
  for (const int assumed : {13, 14, 15}) {
    const SE3 T_world_camera = test::room_path(assumed);
    const MapEvidence evidence = patches(T_world_view).compare(pyramid(image), T_world_camera);
    const ViewImages view = room_.render(camera_, T_world_view, {true, false});
    int count = 0;
    const double score = score_by_definition(camera_, to_gray(view.color), view.depth, image,
                                             T_world_camera.inverse() * T_world_view, options_.min_texture, count);
    EXPECT_NEAR(evidence.score, score, 1e-3) << assumed;
    EXPECT_NEAR(evidence.patches, count, 2) << assumed;
  }
}

TEST_F(MapConfirmationTest, TheRightPoseIsConfirmedFromNearbyViews) {
  const MapEvidence evidence =
      patches(test::room_path(10)).compare(pyramid(room_.gray(camera_, test::room_path(16))), test::room_path(16));
  EXPECT_EQ(evidence.verdict, Confirmation::confirmed);
  EXPECT_GT(evidence.score, 0.9);
  EXPECT_GT(evidence.probability, 0.999);
}

TEST_F(MapConfirmationTest, LightAndShadingDoNotCount) {
  const GrayImage image = room_.gray(camera_, test::room_path(10));
  GrayImage other = image.clone();
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      other(v, u) = 0.5F * image(v, u) + 0.1F + 0.002F * static_cast<float>(u) - 0.001F * static_cast<float>(v);
    }
  }
  const ViewPatches view = patches(test::room_path(10));
  EXPECT_NEAR(view.compare(pyramid(other), test::room_path(10)).score,
              view.compare(pyramid(image), test::room_path(10)).score, 0.05);
}

TEST_F(MapConfirmationTest, AnotherRoomIsContradicted) {
  test::BoxRoom other;
  other.detail = 1.7;
  for (const int k : {0, 40, 80, 120, 160, 200}) {
    const MapEvidence evidence =
        patches(test::room_path(k)).compare(pyramid(other.gray(camera_, test::room_path(k))), test::room_path(k));
    EXPECT_EQ(evidence.verdict, Confirmation::contradicted) << k;
  }
}

TEST_F(MapConfirmationTest, InvertedColoursAreContradicted) {
  GrayImage negative;
  room_.gray(camera_, test::room_path(0)).convertTo(negative, CV_32F, -1.0, 1.0);
  const MapEvidence evidence = patches(test::room_path(0)).compare(pyramid(negative), test::room_path(0));
  EXPECT_EQ(evidence.verdict, Confirmation::contradicted);
  EXPECT_LT(evidence.score, -0.9);
}

TEST_F(MapConfirmationTest, WhiteNoiseIsContradicted) {
  Random random(3);
  GrayImage noise(camera_.height, camera_.width);
  for (float& value : noise) value = static_cast<float>(random.uniform());
  EXPECT_EQ(patches(test::room_path(0)).compare(pyramid(noise), test::room_path(0)).verdict,
            Confirmation::contradicted);
}

TEST_F(MapConfirmationTest, ClearTextureThatTheMapDoesNotShowSpeaksAgainst) {
  // The left part is the map's to the pixel, as of a place that is in part like another one.
  test::BoxRoom other;
  other.detail = 1.7;
  const SE3 T_world_camera = test::room_path(10);
  const ViewPatches view = patches(T_world_camera);
  for (const double share : {0.0, 0.15, 0.6}) {
    GrayImage image = room_.gray(camera_, T_world_camera);
    const auto width = static_cast<int>(share * camera_.width);
    const cv::Rect part(camera_.width - width, 0, width, camera_.height);
    if (width > 0) other.gray(camera_, T_world_camera)(part).copyTo(image(part));
    const MapEvidence evidence = view.compare(pyramid(image), T_world_camera);
    EXPECT_NEAR(evidence.against, 0.7 * share, 0.3 * share + 0.05) << share;
    EXPECT_GT(confirmation_probability(evidence.score, evidence.patches, 0.0, options_), 0.99) << share;
    EXPECT_EQ(evidence.verdict, share < 0.5 ? Confirmation::confirmed : Confirmation::undecided) << share;
  }
}

TEST_F(MapConfirmationTest, NoiseAndBlurDoNotSpeakAgainst) {
  const SE3 T_world_camera = test::room_path(10);
  const ViewPatches view = patches(T_world_camera);
  GrayImage noisy = room_.gray(camera_, T_world_camera);
  GrayImage blurred;
  cv::blur(noisy, blurred, {7, 1});
  Random random(3);
  for (float& value : noisy) value += static_cast<float>(0.05 * random.normal());
  EXPECT_LT(view.compare(pyramid(noisy), T_world_camera).against, 0.1);
  EXPECT_LT(view.compare(pyramid(blurred), T_world_camera).against, 0.1);
}

TEST_F(MapConfirmationTest, UsesTheGreyValuesThatAViewHas) {
  const SE3 T_world_camera = test::room_path(10);
  const FramePyramid image = pyramid(room_.gray(camera_, T_world_camera));
  RenderedView view{T_world_camera, room_.render(camera_, T_world_camera, {true, false})};
  const auto score = [&] { return ViewPatches(camera_, view, 0.0, options_).compare(image, T_world_camera).score; };
  const double own = score();
  view.gray = gray_of(camera_, view.images, 0.0);
  EXPECT_EQ(score(), own);
  const GrayImage blank(camera_.height, camera_.width, 0.5F);
  view.gray = std::make_shared<RenderedGray>(RenderedGray{blank, pyramid(blank)});
  EXPECT_LT(score(), 0.1);
  EXPECT_GT(own, 0.9);
}

TEST_F(MapConfirmationTest, WhereNothingCanBeComparedNothingIsSaid) {
  const FramePyramid image = pyramid(room_.gray(camera_, test::room_path(0)));
  // A wall of uniform colour, in the image and in the map.
  const GrayImage wall(camera_.height, camera_.width, 0.6F);
  RenderedView blank{SE3(), {}};
  blank.images.color = ColorImage(camera_.height, camera_.width, cv::Vec3f(0.6F, 0.6F, 0.6F));
  blank.images.depth = DepthImage(camera_.height, camera_.width, 2.0F);
  EXPECT_EQ(ViewPatches(camera_, blank, 0.0, options_).compare(pyramid(wall), SE3()).verdict, Confirmation::none);
  // A pose that sees nothing of the view, a map without depth, and a map without colours.
  RenderedView view{test::room_path(0), room_.render(camera_, test::room_path(0), {true, false})};
  const SE3 turned = test::room_path(0) * SE3(so3_exp({0.0, 3.0, 0.0}), Eigen::Vector3d::Zero());
  EXPECT_EQ(ViewPatches(camera_, view, 0.0, options_).compare(image, turned).verdict, Confirmation::none);
  view.images.depth.setTo(0.0F);
  EXPECT_EQ(ViewPatches(camera_, view, 0.0, options_).compare(image, test::room_path(0)).verdict, Confirmation::none);
  view.images.color = ColorImage();
  const MapEvidence evidence = ViewPatches(camera_, view, 0.0, options_).compare(image, test::room_path(0));
  EXPECT_EQ(evidence.verdict, Confirmation::none);
  EXPECT_EQ(evidence.probability, 0.0);
}

TEST_F(MapConfirmationTest, ProbabilityFollowsBayesRule) {
  EXPECT_EQ(confirmation_probability(0.9, 0, 0.0, options_), 0.0);
  options_.null_common = 0.03;
  options_.null_patch = 0.4;
  options_.prior = 0.5;
  // 100 squares: variance 0.0009 + 0.0016, standard deviation 0.05; the density at two standard deviations is 7.9788 *
  // exp(-2) = 1.0798.
  EXPECT_NEAR(confirmation_probability(0.1, 100, 0.0, options_), 1.0 / (1.0 + 1.0798 + 0.0005), 1e-4);
  // A place that is alike in part: odds 0.005 * 0.1 * exp(0.3 / 0.1) = 0.01004 to those of the right one.
  EXPECT_NEAR(confirmation_probability(1.0, 100, 0.3, options_), 1.0 / (1.0 + 0.01004), 1e-4);
  EXPECT_LT(confirmation_probability(-0.8, 100, 0.0, options_), 0.2);
  double last = 0.0;
  for (double score = 0.0; score <= 1.0; score += 0.05) {
    const double probability = confirmation_probability(score, 100, 0.0, options_);
    EXPECT_GE(probability, last);
    last = probability;
  }
  EXPECT_GT(confirmation_probability(0.2, 400, 0.0, options_), confirmation_probability(0.2, 40, 0.0, options_));
}

TEST_F(MapConfirmationTest, OptionsAreChecked) {
  options_.prior = 1.0;
  EXPECT_THROW(patches(SE3()), InputError);
  options_ = {};
  options_.contradicted = 0.999;
  EXPECT_THROW(patches(SE3()), InputError);
}

}  // namespace
}  // namespace odosplat
