// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/light/image_blur.hpp"

#include <Eigen/Dense>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/keyframe/keyframe_maker.hpp"
#include "tests/odometry/room_pair.hpp"

namespace odosplat {
namespace {

Eigen::Matrix2d covariance(double xx, double xy, double yy) { return (Eigen::Matrix2d() << xx, xy, xy, yy).finished(); }

class ImageBlurTest : public test::RoomPairTest {
 protected:
  ImageBlurTest() { room_.detail = 2.0; }

  /// The estimated blur of an image from the host's pose that is blurred by `target`, with a reference blurred by
  /// `host`.
  std::optional<Eigen::Matrix2d> found(const Eigen::Matrix2d& host, const Eigen::Matrix2d& target, double gain = 1.0) {
    const GrayImage sharp = room_.gray(camera_, T_world_host_);
    const FramePyramid pyramid = build_frame_pyramid(camera_, apply_blur(sharp, host));
    const std::vector<GradientImage> gradients = build_gradients(pyramid);
    PixelSelector selector({});
    const TrackingReference reference =
        build_reference(pyramid, gradients, room_.render(camera_, T_world_host_, {}), selector, {}, {});
    GrayImage image = apply_blur(sharp, target);
    image *= gain;
    const Brightness brightness{std::log(gain), 0.0};
    const auto samples = brightness_samples(reference, build_frame_pyramid(camera_, image), SE3(), brightness, 0);
    return estimate_blur(gradients.front(), samples, gain, {});
  }
};

TEST_F(ImageBlurTest, FindsHowFarAndWhichWay) {
  for (const Eigen::Matrix2d& blur : {covariance(0.8, 0.3, 0.3), covariance(0.2, -0.2, 0.9)}) {
    for (const double gain : {1.0, 0.8}) {
      const auto estimate = found(covariance(0.1, 0.0, 0.1), blur + covariance(0.1, 0.0, 0.1), gain);
      ASSERT_TRUE(estimate);
      EXPECT_LT((*estimate - blur).norm(), 0.25 * blur.norm());
    }
  }
}

TEST_F(ImageBlurTest, SharpImagesAndSharperOnesAreLeftAlone) {
  EXPECT_FALSE(found(covariance(0.1, 0.0, 0.1), covariance(0.1, 0.0, 0.1)));
  EXPECT_FALSE(found(covariance(0.1, 0.0, 0.1), covariance(0.3, 0.0, 0.2)));  // too small to be corrected
  EXPECT_FALSE(found(covariance(1.5, 0.0, 1.5), covariance(0.1, 0.0, 0.1)));
}

TEST_F(ImageBlurTest, AKernelHasTheCovarianceAskedFor) {
  const Eigen::Matrix2d wanted = covariance(3.0, -1.0, 1.5);
  GrayImage dot(41, 41, 0.0F);
  dot(20, 20) = 1.0F;
  const GrayImage blurred = apply_blur(dot, wanted);
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (int y = 0; y < dot.rows; ++y) {
    for (int x = 0; x < dot.cols; ++x) {
      const Eigen::Vector2d at(x - 20, y - 20);
      second += static_cast<double>(blurred(y, x)) * at * at.transpose();
    }
  }
  EXPECT_NEAR(cv::sum(blurred)[0], 1.0, 1e-5);
  EXPECT_LT((second - wanted).norm(), 0.05 * wanted.norm());
  const GrayImage flat(10, 12, 0.3F);
  EXPECT_LT(cv::norm(apply_blur(flat, wanted), flat, cv::NORM_INF), 1e-5);
}

TEST_F(ImageBlurTest, TheMapIsBlurredAsTheImageIs) {
  const ViewImages view = room_.render(camera_, T_world_host_, {true, true});
  const GrayImage image = apply_blur(room_.gray(camera_, T_world_host_), covariance(2.0, 0.0, 0.05));
  const auto pyramid = std::make_shared<FramePyramid>(build_frame_pyramid(camera_, image, 0.8));
  const auto rmse = [&](bool enabled) {
    KeyframeMakerOptions options;
    options.anchor.blur.enabled = enabled;
    KeyframeMaker maker(options);
    const MadeKeyframe made =
        maker.make(make_even(pyramid), build_gradients(*pyramid), {T_world_host_, view}, {}, aligner_);
    EXPECT_TRUE(made.anchored);
    return made.anchor.rmse;
  };
  EXPECT_LT(rmse(true), 0.5 * rmse(false));
}

TEST_F(ImageBlurTest, BadOptionsAreRefused) {
  for (double BlurOptions::*value :
       {&BlurOptions::huber, &BlurOptions::least, &BlurOptions::most, &BlurOptions::explained}) {
    BlurOptions options;
    options.*value = -1.0;
    EXPECT_THROW(options.check(), InputError);
  }
}

}  // namespace
}  // namespace odosplat
