// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/keyframe_backend.hpp"

#include <algorithm>
#include <utility>

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
  MapView& map = request.view != nullptr ? *request.view : map_;
  SE3 T_world_keyframe = request.T_world_camera;
  // What was rendered ahead shows what the anchor's alignment will find, only its pose is another than the frame's: a
  // keyframe that is not anchored cannot be made from it.
  std::optional<RenderedView> ahead = std::exchange(prefetched_, std::nullopt);
  if (ahead && (!anchor.enabled || request.view != nullptr ||
                view_flow(camera_, *ahead, request.T_world_camera) > anchor.render_again_flow)) {
    ahead.reset();
  }
  MadeKeyframe made;
  double corrected = 0.0;
  bool prefetched = false;
  // Seen from where the map says the camera is, if that is elsewhere: depth and colour must belong to the pixel.
  for (int attempt = 0; attempt < 3; ++attempt) {
    prefetched = attempt == 0 && ahead.has_value();
    if (prefetched) T_world_keyframe = ahead->T_world_camera;
    const ViewImages view = prefetched ? ahead->images : render(map, T_world_keyframe);
    const StageTimer timer(stages_[stage_keyframe]);
    made = maker_.make(*request.pyramid, view, T_world_keyframe, request.brightness, tracker_);
    if (prefetched && !made.anchored) {
      T_world_keyframe = request.T_world_camera;
      continue;
    }
    if (!made.anchored) break;
    corrected =
        std::max(corrected, prefetched ? view_flow(camera_, {made.T_world_camera_map, view}, request.T_world_camera)
                                       : made.map_flow);
    T_world_keyframe = made.T_world_camera_map;
    if (made.map_flow <= anchor.render_again_flow) break;
  }
  KeyframeOutcome outcome;
  outcome.map_share = made.map_share;
  outcome.map_correlation = made.anchor.correlation;
  if (made.keyframe == nullptr) return outcome;
  outcome.made = true;
  outcome.anchored = made.anchored;
  outcome.prefetched = prefetched;
  const std::shared_ptr<Keyframe>& keyframe = made.keyframe;
  keyframe->id = request.id;
  keyframe->frame = request.frame;
  keyframe->time = request.time;
  if (made.anchored) keyframe->T_world_camera = T_world_keyframe;
  if (request.fresh || (made.anchored && corrected > anchor.reset_flow)) window_.keyframes.clear();
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

void KeyframeBackend::prefetch(const SE3& T_world_camera) {
  prefetched_ = RenderedView{T_world_camera, render(map_, T_world_camera)};
}

ViewImages KeyframeBackend::render(MapView& map, const SE3& T_world_camera) {
  const StageTimer timer(stages_[stage_render]);
  return map.render(camera_, T_world_camera, {options_.keyframe.anchor.enabled, true});
}

std::vector<ReferenceFrame> KeyframeBackend::references() const {
  std::vector<ReferenceFrame> references;
  for (const auto& k : window_.keyframes) {
    references.push_back({k->id, k->frame, k->T_world_camera, k->brightness, k->covariance, k->reference});
  }
  return references;
}

}  // namespace odosplat
