// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/keyframe/keyframe_memory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/reprojection.hpp"

namespace odosplat {
namespace {

constexpr int coarsest_level = 4;  // outside the map the camera may have drifted by many pixels

bool is_good(const Alignment& a, const KeyframeMemoryOptions& options) {
  return a.finished && a.inlier_share >= options.min_inliers && a.correlation >= options.min_correlation &&
         a.rmse <= options.max_rmse;
}

/// Infinite where fewer than half of the points that are seen from a are seen from b.
double image_motion(const Keyframe& keyframe, const Camera& camera, const SE3& T_world_a, const SE3& T_world_b) {
  const SE3 T_a_host = T_world_a.inverse() * keyframe.T_world_camera;
  const SE3 T_b_host = T_world_b.inverse() * keyframe.T_world_camera;
  double squares = 0.0;
  int from_a = 0;
  int from_both = 0;
  for (const WindowPoint& point : keyframe.points) {
    const double q = inverse_depth(point, camera, keyframe.T_world_camera);
    const auto a = reproject(camera, T_a_host, point.u, point.v, q, 0.0);
    const auto b = reproject(camera, T_b_host, point.u, point.v, q, 0.0);
    if (!a) continue;
    ++from_a;
    if (!b) continue;
    ++from_both;
    squares += (a->uv - b->uv).squaredNorm();
  }
  if (from_both == 0 || 2 * from_both < from_a) return std::numeric_limits<double>::infinity();
  return std::sqrt(squares / from_both);
}

Anchor anchor_of(const Keyframe& keyframe) {
  Anchor anchor;
  anchor.T_world_view = keyframe.T_world_camera;
  anchor.covariance = keyframe.covariance;
  anchor.brightness = keyframe.brightness;
  anchor.points = keyframe.points;
  for (WindowPoint& point : anchor.points) point.estimated = false;
  return anchor;
}

}  // namespace

void KeyframeMemoryOptions::check() const {
  require(map_share >= 0.0 && map_share <= 1.0, "memory.map_share", "in [0, 1]");
  require(max_links >= 0, "memory.max_links", "at least 0");
  require(likeness > 0.0 && known >= likeness && known <= 1.0, "memory.likeness and known",
          "0 < likeness <= known <= 1");
  require(parallax > 0.0, "memory.parallax", "positive");
  require(views >= 1, "memory.views", "at least 1");
  require(strength > 0.0, "memory.strength", "positive");
  require(min_inliers >= 0.0 && min_inliers <= 1.0, "memory.min_inliers", "in [0, 1]");
  require(min_correlation >= -1.0 && min_correlation <= 1.0, "memory.min_correlation", "in [-1, 1]");
  require(max_rmse > 0.0, "memory.max_rmse", "positive");
  require(capacity >= 1, "memory.capacity", "at least 1");
}

KeyframeMemory::KeyframeMemory(const Camera& camera, const KeyframeMemoryOptions& options)
    : camera_(camera), options_(options) {
  options_.check();
}

double KeyframeMemory::likeness(const Keyframe& keyframe, const SE3& T_world_camera) const {
  const SE3 T_camera_host = T_world_camera.inverse() * keyframe.T_world_camera;
  double sum = 0.0;
  for (const WindowPoint& point : keyframe.points) {
    const double q = inverse_depth(point, camera_, keyframe.T_world_camera);
    const auto seen = reproject(camera_, T_camera_host, point.u, point.v, q, 0.0);
    if (!seen) continue;
    const Eigen::Vector3d p = seen->z * camera_.ray(seen->uv.x(), seen->uv.y());
    const double cosine = p.normalized().dot((p - T_camera_host.translation()).normalized());
    sum += std::exp(-2.0 * (1.0 - cosine) / (options_.parallax * options_.parallax));
  }
  return keyframe.points.empty() ? 0.0 : sum / static_cast<double>(keyframe.points.size());
}

void KeyframeMemory::remember(std::shared_ptr<const Keyframe> keyframe, int links) {
  if (!options_.enabled || links > options_.max_links) return;
  const auto shows_the_same = [&](const Kept& kept) {
    return likeness(*kept.keyframe, keyframe->T_world_camera) >= options_.known;
  };
  if (std::any_of(kept_.begin(), kept_.end(), shows_the_same)) return;
  if (kept_.size() >= static_cast<std::size_t>(options_.capacity)) {
    kept_.erase(std::min_element(kept_.begin(), kept_.end(),
                                 [](const Kept& a, const Kept& b) { return a.last_use < b.last_use; }));
  }
  kept_.push_back({std::move(keyframe), links, ++uses_});
}

void KeyframeMemory::forget(const Keyframe& keyframe) {
  std::erase_if(kept_, [&keyframe](const Kept& kept) { return kept.keyframe.get() == &keyframe; });
}

std::vector<Recollection> KeyframeMemory::recall(const FramePyramid& image, const SE3& T_world_camera,
                                                 const ImageAligner& aligner) {
  std::vector<std::pair<double, Kept*>> candidates;
  for (Kept& kept : kept_) {
    const double like = likeness(*kept.keyframe, T_world_camera);
    if (like >= options_.likeness) candidates.emplace_back(like, &kept);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Recollection> found;
  double total = 0.0;
  SE3 T_world_guess = T_world_camera;
  for (const auto& [like, kept] : candidates) {
    if (found.size() >= static_cast<std::size_t>(options_.views)) break;
    const Keyframe& keyframe = *kept->keyframe;
    const Alignment alignment = aligner.align(*keyframe.reference, image,
                                              T_world_guess.inverse() * keyframe.T_world_camera, {}, coarsest_level, 0);
    if (!is_good(alignment, options_)) continue;
    T_world_guess = keyframe.T_world_camera * alignment.T_target_host.inverse();
    kept->last_use = ++uses_;
    found.push_back({anchor_of(keyframe), T_world_guess, image_motion(keyframe, camera_, T_world_camera, T_world_guess),
                     kept->links});
    found.back().anchor.weight = like * like;
    total += like * like;
  }
  for (Recollection& recollection : found) recollection.anchor.weight *= options_.strength / total;
  return found;
}

}  // namespace odosplat
