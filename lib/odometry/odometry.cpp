// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/odometry.hpp"

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

enum StageIndex : std::size_t { stage_pyramid, stage_track };

}  // namespace

void OdometryOptions::check() const {
  tracker.check();
  keyframe.check();
  policy.check();
  window.check();
  optimizer.check();
  marginalisation.check();
  activation.check();
  accept.check();
  require(covariance_factor > 0.0, "covariance_factor", "positive");
}

std::string to_string(TrackStatus status) {
  switch (status) {
    case TrackStatus::ok:
      return "ok";
    case TrackStatus::relocalised:
      return "relocalised";
    case TrackStatus::lost:
      break;
  }
  return "lost";
}

Odometry::Odometry(const Camera& camera, MapView& map, const OdometryOptions& options, const SE3& T_world_camera_start)
    : camera_(camera),
      options_(options),
      T_world_camera_start_(T_world_camera_start),
      front_({options.tracker, options.policy, options.accept}),
      backend_(camera, map, front_.aligner(),
               {options.keyframe, options.window, options.optimizer, options.marginalisation, options.activation}) {
  camera_.check();
  options_.check();
  require(T_world_camera_start.is_finite(), "start pose", "finite");
}

TrackResult Odometry::track(const GrayImage& image, double time) {
  const auto start = SteadyClock::now();
  FramePyramid pyramid;
  {
    const StageTimer timer(stages_[stage_pyramid]);
    pyramid = build_frame_pyramid(camera_, image, options_.keyframe.smoothing);
  }
  TrackResult result;
  ++counts_.frames;
  if (front_.empty()) {
    // Until the first keyframe stands, the camera is where the caller said.
    add_keyframe(pyramid, time, T_world_camera_start_, {}, result);
    if (result.keyframe) {
      result.status = TrackStatus::ok;
      result.inlier_share = 1.0;
      result.coverage = 1.0;
    }
  } else {
    TrackedFrame frame;
    {
      const StageTimer timer(stages_[stage_track]);
      frame = front_.track(pyramid, time);
    }
    result.inlier_share = frame.alignment.inlier_share;
    result.coverage = frame.alignment.coverage;
    result.rmse = frame.alignment.rmse;
    if (frame.found) {
      result.status = frame.was_lost ? TrackStatus::relocalised : TrackStatus::ok;
      result.T_world_camera = frame.T_world_camera;
      result.covariance = options_.covariance_factor * frame.covariance;
      record_.add_frame(time, frame.keyframe, frame.T_keyframe_camera);
      backend_.trace(pyramid, frame.T_world_camera, frame.brightness);
      if (frame.keyframe_due) add_keyframe(pyramid, time, frame.T_world_camera, frame.brightness, result);
    }
  }
  result.map_share = map_share_;
  result.in_map = in_map_ && result.status != TrackStatus::lost;
  if (result.status == TrackStatus::lost) {
    front_.lose();
    ++counts_.lost;
  } else {
    front_.confirm(time, result.T_world_camera);
    if (result.status == TrackStatus::relocalised) ++counts_.relocalisations;
    ++counts_.posed;
  }
  result.milliseconds = milliseconds_since(start);
  return result;
}

void Odometry::add_keyframe(const FramePyramid& pyramid, double time, const SE3& T_world_camera,
                            const Brightness& brightness, TrackResult& result) {
  const KeyframeOutcome outcome =
      backend_.add({&pyramid, counts_.keyframes, counts_.frames - 1, time, T_world_camera, brightness});
  map_share_ = outcome.map_share;
  if (!outcome.made) return;
  in_map_ = outcome.in_map;
  const ReferenceFrame& keyframe = outcome.window.back();
  record_.add_keyframe(time, keyframe.T_world_camera);
  for (const ReferenceFrame& k : outcome.window) record_.move_keyframe(k.id, k.T_world_camera);
  result.T_world_camera = keyframe.T_world_camera;
  result.covariance = options_.covariance_factor * keyframe.covariance;
  result.keyframe = true;
  result.anchored = outcome.anchored;
  ++counts_.keyframes;
  if (outcome.anchored) ++counts_.anchored;
  front_.set_references(outcome.window);
}

OdometryStatistics Odometry::statistics() const {
  OdometryStatistics all = counts_;
  all.stages = stages_;
  all.stages.insert(all.stages.end(), backend_.stages().begin(), backend_.stages().end());
  return all;
}

}  // namespace odosplat
