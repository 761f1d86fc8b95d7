// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/odometry.hpp"

#include <cmath>

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
  accept.check();
  require(covariance_factor > 0.0, "covariance_factor", "positive");
  require(prefetch_images >= 0.0, "prefetch_images", "at least 0");
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
      backend_(camera, map, front_.aligner(), {options.keyframe, options.window, options.optimizer}) {
  camera_.check();
  options_.check();
  require(T_world_camera_start.is_finite(), "start pose", "finite");
  if (options_.background) thread_ = std::make_unique<KeyframeThread>(backend_);
}

TrackResult Odometry::track(const GrayImage& image, double time, std::shared_ptr<MapView> view) {
  const auto start = SteadyClock::now();
  if (thread_ != nullptr) take_over_finished(thread_->take());
  KeyframeRequest request;
  request.view = std::move(view);
  request.frame = counts_.frames;
  request.time = time;
  {
    const StageTimer timer(stages_[stage_pyramid]);
    request.pyramid = std::make_shared<FramePyramid>(build_frame_pyramid(camera_, image, options_.keyframe.smoothing));
  }
  TrackResult result;
  ++counts_.frames;
  if (front_.empty()) {
    // Until the first keyframe stands, the camera is where the caller said.
    request.T_world_camera = T_world_camera_start_;
    make_keyframe(request, result);
    if (result.keyframe) {
      result.status = TrackStatus::ok;
      result.inlier_share = 1.0;
      result.coverage = 1.0;
    }
  } else {
    TrackedFrame frame;
    {
      const StageTimer timer(stages_[stage_track]);
      frame = front_.track(*request.pyramid, time);
    }
    result.inlier_share = frame.alignment.inlier_share;
    result.coverage = frame.alignment.coverage;
    result.rmse = frame.alignment.rmse;
    if (frame.found) {
      result.status = frame.was_lost ? TrackStatus::relocalised : TrackStatus::ok;
      result.T_world_camera = frame.T_world_camera;
      result.covariance = options_.covariance_factor * frame.covariance;
      record_.add_frame(time, frame.keyframe, frame.T_keyframe_camera, frame.was_lost);
      request.T_world_camera = frame.T_world_camera;
      request.brightness = frame.brightness;
      if (frame.keyframe_due()) {
        make_keyframe(request, result);
      } else if (thread_ != nullptr && request.view == nullptr) {
        render_ahead(frame, time);
      }
    }
  }
  result.map_share = map_share_;
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

void Odometry::finish() {
  if (thread_ != nullptr) take_over_finished(thread_->wait());
}

void Odometry::make_keyframe(const KeyframeRequest& request, TrackResult& result) {
  if (thread_ != nullptr && !front_.empty()) {
    thread_->request(request);
    return;
  }
  const int before = counts_.keyframes;
  const int anchored_before = counts_.anchored;
  if (thread_ != nullptr) {
    thread_->request(request);
    finish();
  } else {
    KeyframeRequest numbered = request;
    numbered.id = counts_.keyframes;
    take_over(numbered, backend_.add(numbered));
  }
  if (counts_.keyframes == before) return;
  result.T_world_camera = front_.newest().T_world_camera;
  result.covariance = options_.covariance_factor * front_.newest().covariance;
  result.keyframe = true;
  result.anchored = counts_.anchored > anchored_before;
}

void Odometry::take_over_finished(const std::optional<FinishedKeyframe>& finished) {
  if (!finished) return;
  backend_stages_ = finished->stages;
  take_over(finished->request, finished->outcome);
}

void Odometry::take_over(const KeyframeRequest& request, const KeyframeOutcome& outcome) {
  map_share_ = outcome.map_share;
  rendered_ahead_ = false;
  if (!outcome.made) return;
  const ReferenceFrame& keyframe = outcome.window.back();
  record_.add_keyframe(request.time, keyframe.T_world_camera);
  for (const ReferenceFrame& k : outcome.window) record_.move_keyframe(k.id, k.T_world_camera);
  ++counts_.keyframes;
  if (outcome.anchored) ++counts_.anchored;
  if (outcome.prefetched) ++counts_.prefetched;
  if (thread_ == nullptr) {
    front_.set_references(outcome.window);
  } else {
    front_.set_references(outcome.window, keyframe.T_world_camera * request.T_world_camera.inverse());
  }
}

void Odometry::render_ahead(const TrackedFrame& frame, double time) {
  MotionHistory history = front_.history();
  if (rendered_ahead_ || frame.was_lost || !history.has_last || !(frame.keyframe_score > 0.0)) return;
  // The score grows about evenly with time from 0 at the keyframe.
  const double keyframe_time = record_.keyframe_time(frame.keyframe);
  const double due = keyframe_time + (time - keyframe_time) / frame.keyframe_score;
  const double interval = time - history.last_time;
  const double images = std::ceil((due - time) / interval);
  if (!(images <= options_.prefetch_images)) return;
  history.add(time, frame.T_world_camera);
  thread_->prefetch(predict(history, time + images * interval));
  rendered_ahead_ = true;
}

std::vector<double> Odometry::keyframe_times() const {
  std::vector<double> times;
  for (int k = 0; k < record_.keyframes(); ++k) times.push_back(record_.keyframe_time(k));
  return times;
}

OdometryStatistics Odometry::statistics() const {
  OdometryStatistics all = counts_;
  all.stages = stages_;
  const std::vector<StageTime>& backend = thread_ != nullptr ? backend_stages_ : backend_.stages();
  all.stages.insert(all.stages.end(), backend.begin(), backend.end());
  return all;
}

}  // namespace odosplat
