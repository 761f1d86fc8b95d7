// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/fit_input.hpp"

#include <map>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "apps/command/interrupt.hpp"
#include "odosplat/camera/register_depth.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat::apps {
namespace {

/// Depth as of the colour image's time, where the depth image has another one.
DepthImage depth_at_image(const Sequence& sequence, std::size_t i) {
  const std::optional<SE3> T_world_depth = sequence.T_world_depth(i);
  if (!T_world_depth || !sequence.T_world_camera(i)) return {};
  const SE3 T_camera_depth = sequence.T_world_camera(i)->inverse() * *T_world_depth;
  DepthImage depth = sequence.depth(i);
  if (T_camera_depth.log().norm() < 1e-6) return depth;
  return registered_depth(depth, sequence.camera(), T_camera_depth, sequence.camera());
}

// A fit asks for the images of its pairs in every round. Those of 48 pairs of 800 x 600 pixels, for all stages, are
// fewer.
constexpr std::size_t most_kept_bytes = std::size_t{512} << 20U;

/// Grey or depth images, kept until they fill the memory; those that come later are made anew each time.
class KeptImages {
 public:
  /// bytes_left: of the memory, may be shared by several of these.
  explicit KeptImages(std::shared_ptr<std::size_t> bytes_left) : bytes_left_(std::move(bytes_left)) {}

  template <typename Make>
  cv::Mat1f get(std::size_t i, const Make& make) {
    if (const auto found = images_.find(i); found != images_.end()) return found->second;
    const cv::Mat1f image = make();
    const std::size_t bytes = image.total() * image.elemSize();
    if (bytes <= *bytes_left_) {
      *bytes_left_ -= bytes;
      images_.emplace(i, image);
    }
    return image;
  }

 private:
  std::shared_ptr<std::size_t> bytes_left_;
  std::map<std::size_t, cv::Mat1f> images_;
};

}  // namespace

CameraFitInput camera_fit_input(const Sequence& sequence) {
  constexpr int widest = 800;  // [px]
  int level = 0;
  while (sequence.camera().width >> level > widest) ++level;
  CameraFitInput input;
  input.camera = sequence.camera().level(level);
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    input.times.push_back(sequence.time(i));
    input.T_world_camera.push_back(sequence.T_world_camera(i));
    input.has_depth.push_back(sequence.has_depth(i));
  }
  const auto bytes_left = std::make_shared<std::size_t>(most_kept_bytes);
  input.gray = [&sequence, level, kept = std::make_shared<KeptImages>(bytes_left)](std::size_t i) -> GrayImage {
    if (interrupted()) throw Interrupted();
    return kept->get(i, [&] {
      GrayImage gray = sequence.gray(i);
      for (int k = 0; k < level; ++k) gray = halve(gray);
      return gray;
    });
  };
  const cv::Size size(input.camera.width, input.camera.height);
  input.depth = [&sequence, size, kept = std::make_shared<KeptImages>(bytes_left)](std::size_t i,
                                                                                   const CameraState&) -> DepthImage {
    if (interrupted()) throw Interrupted();
    if (!sequence.has_depth(i)) return {};
    return kept->get(i, [&] {
      DepthImage depth = depth_at_image(sequence, i);
      if (!depth.empty() && depth.size() != size) cv::resize(depth, depth, size, 0.0, 0.0, cv::INTER_NEAREST);
      return depth;
    });
  };
  return input;
}

}  // namespace odosplat::apps
