// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>

#include "odosplat/map/map_view.hpp"
#include "odosplat/synth/render/ray_caster.hpp"

namespace odosplat {

struct SceneViewOptions {
  int samples = 4;       // colour samples per pixel, in 1..64
  float sigma = 0.001F;  // [m] standard deviation reported for every depth (the depth itself is exact), > 0

  /// Throws InputError naming the field.
  void check() const;
};

/// The scene itself as a perfect map: exact depth, and the ray caster's colour, from any pose. For tests of code that
/// uses maps. Shares ownership of the scene.
class SceneView : public MapView {
 public:
  explicit SceneView(std::shared_ptr<const Scene> scene, const SceneViewOptions& options = {});

  ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override;
  std::string name() const override { return "scene"; }

 private:
  std::shared_ptr<const Scene> scene_;
  SceneViewOptions options_;
};

}  // namespace odosplat
