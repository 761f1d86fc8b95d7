// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/keyframe_maker.hpp"

#include <algorithm>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/keyframe_policy.hpp"

namespace odosplat {

void AnchorOptions::check() const {
  require(noise > 0.0, "anchor.noise", "positive");
  require(strength > 0.0, "anchor.strength", "positive");
  require(min_inliers >= 0.0 && min_inliers <= 1.0, "anchor.min_inliers", "in [0, 1]");
  require(min_coverage >= 0.0 && min_coverage <= 1.0, "anchor.min_coverage", "in [0, 1]");
  require(max_rmse > 0.0, "anchor.max_rmse", "positive");
  require(render_again_flow > 0.0, "anchor.render_again_flow", "positive");
  require(reset_flow >= render_again_flow, "anchor.reset_flow", "at least render_again_flow");
}

void KeyframeMakerOptions::check() const {
  selector.check();
  reference.check();
  plane.check();
  window_points.check();
  anchor.check();
  require(smoothing >= 0.0 && smoothing <= 1.5, "keyframe.smoothing", "0 to 1.5 px");
  require(min_points >= 20, "keyframe.min_points", "at least 20");
}

KeyframeMaker::KeyframeMaker(const KeyframeMakerOptions& options)
    : options_(options),
      reference_selector_(options.selector),
      window_selector_(options.selector),
      map_reference_selector_(options.selector),
      anchor_selector_(options.selector) {
  options_.check();
}

MadeKeyframe KeyframeMaker::make(const FramePyramid& pyramid, const ViewImages& view, const SE3& T_world_camera,
                                 const Brightness& brightness, const Tracker& tracker) {
  MadeKeyframe made;
  if (view.depth.empty()) return made;
  made.map_share = static_cast<double>(cv::countNonZero(view.depth)) / static_cast<double>(view.depth.total());
  const auto gradients = build_gradients(pyramid);
  auto keyframe = std::make_shared<Keyframe>();
  keyframe->T_world_camera = T_world_camera;
  keyframe->brightness = brightness;
  keyframe->gradient = gradients.front();
  TrackingReference reference =
      build_reference(pyramid, gradients, view, reference_selector_, options_.reference, options_.plane);
  if (reference.empty() || static_cast<int>(reference.levels.front().size()) < options_.min_points) return made;
  keyframe->reference = std::make_shared<TrackingReference>(std::move(reference));
  keyframe->points =
      make_window_points(pyramid.cameras.front(), gradients, view, T_world_camera, options_.window_points.points,
                         window_selector_, options_.window_points, options_.plane);
  made.keyframe = keyframe;
  if (options_.anchor.enabled && !view.color.empty()) add_anchor(made, pyramid, view, tracker);
  return made;
}

void KeyframeMaker::add_anchor(MadeKeyframe& made, const FramePyramid& pyramid, const ViewImages& view,
                               const Tracker& tracker) {
  const AnchorOptions& options = options_.anchor;
  Keyframe& keyframe = *made.keyframe;
  const FramePyramid rendered = build_frame_pyramid(pyramid.cameras.front(), to_gray(view.color), options_.smoothing);
  const auto gradients = build_gradients(rendered);
  const TrackingReference reference =
      build_reference(rendered, gradients, view, map_reference_selector_, options_.reference, options_.plane);
  if (reference.empty()) return;
  // Where does the image lie in the rendered one? Levels 2 to 0: the tracked pose is good to a few pixels.
  const Alignment alignment = tracker.align(reference, pyramid, SE3(), {}, 2, 0);
  made.anchor = alignment;
  const bool good = alignment.finished && alignment.inlier_share >= options.min_inliers &&
                    alignment.coverage >= options.min_coverage && alignment.rmse <= options.max_rmse &&
                    std::abs(alignment.brightness.a) <= tracker.options().max_log_gain;
  if (!good) return;
  MapAnchor& anchor = keyframe.anchor;
  anchor.T_world_view = keyframe.T_world_camera;
  anchor.points = make_window_points(pyramid.cameras.front(), gradients, view, anchor.T_world_view,
                                     options_.window_points.anchor_points, anchor_selector_, options_.window_points,
                                     options_.plane);
  // Relative brightness of the image against the rendered one is (a_k - a_m, b_k - e^(a_k - a_m) b_m): solved for the
  // map's a_m and b_m.
  anchor.brightness.a = keyframe.brightness.a - alignment.brightness.a;
  anchor.brightness.b = (keyframe.brightness.b - alignment.brightness.b) * std::exp(-alignment.brightness.a);
  const double ratio = options.noise / std::max(options.noise, alignment.rmse);
  anchor.weight = options.strength * ratio * ratio;
  made.T_world_camera_map = anchor.T_world_view * alignment.T_target_host.inverse();
  made.map_flow = keyframe_score(reference, alignment, 0.0, {}).full_flow;
  made.anchored = !anchor.points.empty();
}

}  // namespace odosplat
