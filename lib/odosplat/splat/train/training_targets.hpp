// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/compute/context.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/map/map_view.hpp"

namespace odosplat {

/// The posed images that a map is trained on. Images are asked for one at a time, again in every round, so that an
/// implementation may read them from disk and keep none.
class TrainingViews {
 public:
  virtual ~TrainingViews() = default;

  virtual int count() const = 0;
  /// Camera of view i, 0 <= i < count(). Views may differ in size.
  virtual Camera camera(int i) const = 0;
  virtual SE3 T_world_camera(int i) const = 0;
  /// Image of view i, as large as its camera says, values 0..1.
  virtual ColorImage color(int i) = 0;
  /// Measured depth of view i as its camera sees it [m], if there is any (else empty): not used in training, but to
  /// calibrate the map's sigma.
  virtual DepthImage depth(int) { return {}; }
};

/// The targets of a step of training, in device memory: the image at a level of its pyramid, and the depth of the
/// surface seen from there. Depth is that of a MapView (the cloud, projected with an occlusion test); it is rendered
/// once for each view and level and kept in 3 bytes per pixel, up to cache_bytes in all (what does not fit is rendered
/// again); kept or not, it is the same to the bit. Throws InputError for an image of another size than its camera or
/// with values that are not finite. Not thread safe.
class TrainingTargets {
 public:
  /// views and surface (may be null: no depth) must outlive it.
  TrainingTargets(const compute::Context& context, TrainingViews& views, MapView* surface, std::size_t cache_bytes);

  /// Level 0 is the full image. An image too small to halve stays as it is.
  void load(int view, int level);
  /// Camera of what was loaded.
  const Camera& camera() const { return camera_; }
  const compute::Buffer<float>& color() const { return color_; }  // [3 x H x W]
  bool has_depth() const { return surface_ != nullptr; }
  const compute::Buffer<float>& depth() const { return depth_; }  // [H x W] m, 0: none
  const compute::Buffer<float>& depth_weight() const {
    return weight_;
  }  // [H x W] 0..1: less where it is uncertain, 0 at edges

 private:
  struct Stored {
    float unit = 0.0F;  // [m] of one step of `depth`
    std::vector<std::uint16_t> depth;
    std::vector<std::uint8_t> weight;
    std::size_t bytes() const { return 3 * depth.size(); }
  };
  void load_color(int view, int level);
  void load_depth(int view, int level);
  Stored render_depth(int view) const;

  compute::Context context_;
  TrainingViews& views_;
  MapView* surface_;
  std::size_t room_;  // [bytes] left of the cache
  std::map<std::pair<int, int>, Stored> cache_;
  Camera camera_;
  compute::Buffer<float> color_, depth_, weight_;
  std::vector<float> values_;
};

}  // namespace odosplat
