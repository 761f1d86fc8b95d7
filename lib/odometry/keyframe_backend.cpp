// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/keyframe_backend.hpp"

#include <algorithm>

namespace odosplat {
namespace {

enum StageIndex : std::size_t { stage_render, stage_keyframe, stage_optimise };

}  // namespace

void KeyframeBackendOptions::check() const {
  keyframe.check();
  window.check();
  optimizer.check();
}

KeyframeBackend::KeyframeBackend(const Camera& camera, MapView& map, const Tracker& tracker,
                                 const KeyframeBackendOptions& options)
    : camera_(camera),
      map_(map),
      tracker_(tracker),
      options_(options),
      maker_(options.keyframe),
      optimizer_(options.optimizer) {
  options_.check();
}

KeyframeOutcome KeyframeBackend::add(const KeyframeRequest& request) {
  const AnchorOptions& anchor = options_.keyframe.anchor;
  SE3 T_world_keyframe = request.T_world_camera;
  MadeKeyframe made;
  double corrected = 0.0;
  // Seen from where the map says the camera is, if that is elsewhere: depth and colour must belong to the pixel.
  for (int attempt = 0; attempt < 3; ++attempt) {
    ViewImages view;
    {
      const StageTimer timer(stages_[stage_render]);
      view = map_.render(camera_, T_world_keyframe, {anchor.enabled, true});
    }
    const StageTimer timer(stages_[stage_keyframe]);
    made = maker_.make(*request.pyramid, view, T_world_keyframe, request.brightness, tracker_);
    if (!made.anchored) break;
    corrected = std::max(corrected, made.map_flow);
    T_world_keyframe = made.T_world_camera_map;
    if (made.map_flow <= anchor.render_again_flow) break;
  }
  KeyframeOutcome outcome;
  outcome.map_share = made.map_share;
  if (made.keyframe == nullptr) return outcome;
  outcome.made = true;
  outcome.anchored = made.anchored;
  const std::shared_ptr<Keyframe>& keyframe = made.keyframe;
  keyframe->id = request.id;
  keyframe->frame = request.frame;
  keyframe->time = request.time;
  if (made.anchored) keyframe->T_world_camera = T_world_keyframe;
  if (made.anchored && corrected > anchor.reset_flow) window_.keyframes.clear();
  const int drop = keyframe_to_drop(window_, camera_, options_.window);
  if (drop >= 0) window_.keyframes.erase(window_.keyframes.begin() + drop);
  window_.keyframes.push_back(keyframe);
  {
    const StageTimer timer(stages_[stage_optimise]);
    optimizer_.optimize(window_, camera_);
  }
  outcome.window = references();
  return outcome;
}

std::vector<ReferenceFrame> KeyframeBackend::references() const {
  std::vector<ReferenceFrame> references;
  for (const auto& k : window_.keyframes) {
    references.push_back({k->id, k->frame, k->T_world_camera, k->brightness, k->covariance, k->reference});
  }
  return references;
}

}  // namespace odosplat
