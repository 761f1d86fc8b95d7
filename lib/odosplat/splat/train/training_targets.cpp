// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/training_targets.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "odosplat/core/error.hpp"

namespace odosplat {

namespace {
// Depth with a standard deviation of this share of it has half the weight.
constexpr float uncertain_share = 0.01F;
// Near a step in depth the cloud does not show to the pixel where a surface ends, as the images do: no depth is used
// there.
constexpr int edge_radius = 2;       // [px]
constexpr float edge_share = 0.05F;  // of depth

/// Whether a hole or another surface is within edge_radius.
bool near_edge(const DepthImage& depth, int pixel) {
  const int x = pixel % depth.cols;
  const int y = pixel / depth.cols;
  const float z = depth(y, x);
  for (int v = std::max(0, y - edge_radius); v <= std::min(depth.rows - 1, y + edge_radius); ++v) {
    const float* row = depth[v];
    for (int u = std::max(0, x - edge_radius); u <= std::min(depth.cols - 1, x + edge_radius); ++u)
      if (!(row[u] > 0.0F) || std::abs(row[u] - z) > edge_share * z) return true;
  }
  return false;
}
}  // namespace

TrainingTargets::TrainingTargets(const compute::Context& context, TrainingViews& views, MapView* surface,
                                 std::size_t cache_bytes)
    : context_(context), views_(views), surface_(surface), room_(cache_bytes) {}

void TrainingTargets::load(int view, int level) {
  load_color(view, level);
  if (surface_ != nullptr) load_depth(view, level);
}

void TrainingTargets::load_color(int view, int level) {
  ColorImage image = views_.color(view);
  camera_ = views_.camera(view);
  if (image.cols != camera_.width || image.rows != camera_.height)
    throw InputError("training", "view " + std::to_string(view),
                     "its image is " + std::to_string(image.cols) + " x " + std::to_string(image.rows) +
                         ", its camera " + std::to_string(camera_.width) + " x " + std::to_string(camera_.height));
  for (int l = 0; l < level && std::min(image.cols, image.rows) >= 2; ++l) {
    image = halve(image);
    camera_ = camera_.level(1);
  }
  const auto plane = static_cast<std::size_t>(image.cols) * static_cast<std::size_t>(image.rows);
  values_.resize(3 * plane);
  bool finite = true;
  for (int y = 0; y < image.rows; ++y) {
    const cv::Vec3f* row = image[y];
    const std::size_t begin = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.cols);
    for (int x = 0; x < image.cols; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const float value = row[x][static_cast<int>(c)];
        finite = finite && std::isfinite(value);
        values_[c * plane + begin + static_cast<std::size_t>(x)] = value;
      }
    }
  }
  if (!finite)
    throw InputError("training", "view " + std::to_string(view), "its image holds values that are not finite");
  color_.resize(context_, values_.size());
  color_.upload(values_);
}

TrainingTargets::Stored TrainingTargets::render_depth(int view) const {
  const ViewImages images = surface_->render(camera_, views_.T_world_camera(view), {});
  const auto pixels = static_cast<std::size_t>(images.depth.total());
  Stored stored;
  stored.depth.resize(pixels);
  stored.weight.resize(pixels);
  double largest = 0.0;
  cv::minMaxLoc(images.depth, nullptr, &largest);
  // 65535 steps up to the largest depth: a tenth of a millimetre in a room.
  stored.unit = static_cast<float>(largest / 65535.0);
  if (!(stored.unit > 0.0F)) return stored;
  for (std::size_t i = 0; i < pixels; ++i) {
    const float z = images.depth[0][i];
    if (!(z > 0.0F) || near_edge(images.depth, static_cast<int>(i))) continue;
    stored.depth[i] = static_cast<std::uint16_t>(std::lround(z / stored.unit));
    const float relative = images.sigma.empty() ? 0.0F : images.sigma[0][i] / (uncertain_share * z);
    stored.weight[i] = static_cast<std::uint8_t>(std::lround(255.0F / (1.0F + relative * relative)));
  }
  return stored;
}

void TrainingTargets::load_depth(int view, int level) {
  const std::pair<int, int> key(view, level);
  const auto found = cache_.find(key);
  Stored fresh = found == cache_.end() ? render_depth(view) : Stored();
  const Stored& stored = found == cache_.end() ? fresh : found->second;
  values_.resize(stored.depth.size());
  std::transform(stored.depth.begin(), stored.depth.end(), values_.begin(),
                 [&](std::uint16_t steps) { return stored.unit * static_cast<float>(steps); });
  depth_.resize(context_, values_.size());
  depth_.upload(values_);
  std::transform(stored.weight.begin(), stored.weight.end(), values_.begin(),
                 [](std::uint8_t weight) { return static_cast<float>(weight) / 255.0F; });
  weight_.resize(context_, values_.size());
  weight_.upload(values_);
  if (found != cache_.end() || fresh.bytes() > room_) return;
  room_ -= fresh.bytes();
  cache_.emplace(key, std::move(fresh));
}

}  // namespace odosplat
