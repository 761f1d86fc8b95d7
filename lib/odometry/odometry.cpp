// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/odometry.hpp"

#include <chrono>
#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

enum StageIndex : std::size_t { stage_pyramid, stage_track, stage_render, stage_keyframe, stage_optimise };

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Adds the time of a scope to a stage.
class StageTimer {
 public:
  explicit StageTimer(OdometryStatistics::Stage& stage) : stage_(stage), start_(Clock::now()) {}
  ~StageTimer() {
    stage_.milliseconds += milliseconds_since(start_);
    ++stage_.calls;
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  OdometryStatistics::Stage& stage_;
  Clock::time_point start_;
};

}  // namespace

void AcceptOptions::check() const {
  require(min_inliers >= 0.0 && min_inliers <= 1.0, "accept.min_inliers", "in [0, 1]");
  require(min_coverage >= 0.0 && min_coverage <= 1.0, "accept.min_coverage", "in [0, 1]");
  require(min_contrast >= 0.0 && max_contrast > min_contrast, "accept.min_contrast", "in [0, max_contrast)");
  require(retrack >= 1.0, "accept.retrack", "at least 1");
  require(found_inliers >= 0.0 && found_inliers <= 1.0, "accept.found_inliers", "in [0, 1]");
  require(found_coverage >= 0.0 && found_coverage <= 1.0, "accept.found_coverage", "in [0, 1]");
}

void OdometryOptions::check() const {
  tracker.check();
  keyframe.check();
  policy.check();
  window.check();
  optimizer.check();
  accept.check();
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
      map_(map),
      options_(options),
      T_world_camera_start_(T_world_camera_start),
      tracker_(options.tracker),
      maker_(options.keyframe),
      optimizer_(options.optimizer) {
  camera_.check();
  options_.check();
  require(T_world_camera_start.is_finite(), "start pose", "finite");
  statistics_.stages = {{"pyramid"}, {"track"}, {"render"}, {"keyframe"}, {"optimise"}};
}

TrackResult Odometry::track(const GrayImage& image, double time) {
  const auto start = Clock::now();
  FramePyramid pyramid;
  {
    const StageTimer timer(statistics_.stages[stage_pyramid]);
    pyramid = build_frame_pyramid(camera_, image);
  }
  TrackResult result;
  ++statistics_.frames;
  if (reference_ == nullptr) {
    // Until the first keyframe stands, the camera is where the caller said.
    if (add_keyframe(pyramid, time, T_world_camera_start_, {}, result)) {
      result.status = TrackStatus::ok;
      result.inlier_share = 1.0;
      result.coverage = 1.0;
      result.covariance = reference_->covariance;
    }
  } else {
    Alignment alignment;
    {
      const StageTimer timer(statistics_.stages[stage_track]);
      if (!lost_) alignment = track_against_newest(pyramid, time);
      if (lost_ || !believed(alignment, false)) alignment = search_window(pyramid);
    }
    result.inlier_share = alignment.inlier_share;
    result.coverage = alignment.coverage;
    result.rmse = alignment.rmse;
    if (believed(alignment, lost_)) {
      result.status = lost_ ? TrackStatus::relocalised : TrackStatus::ok;
      const SE3 T_keyframe_camera = alignment.T_target_host.inverse();
      records_.push_back({time, reference_->id, T_keyframe_camera});
      result.T_world_camera = reference_->T_world_camera * T_keyframe_camera;
      // exp(xi) right of T_target_host is exp(-Ad xi) left of T_world_camera; the keyframe's own error comes on top.
      const Matrix6d adjoint = reference_->T_world_camera.adjoint();
      Matrix6d information = alignment.information;
      information.diagonal().array() += 1e-9;
      result.covariance = adjoint * information.inverse() * adjoint.transpose() + reference_->covariance;
      relative_brightness_ = alignment.brightness;
      last_rmse_ = alignment.rmse;
      const double first_rmse = first_rmse_;
      if (first_rmse_ <= 0.0) first_rmse_ = std::max(alignment.rmse, 1.0 / 255);
      const KeyframeScore score = keyframe_score(reference_->reference, alignment, first_rmse, options_.policy);
      if (score.score > 1.0) {
        const Brightness brightness = compose_brightness(alignment.brightness, reference_->brightness);
        if (add_keyframe(pyramid, time, result.T_world_camera, brightness, result)) {
          result.covariance = reference_->covariance;
        }
      }
    }
  }
  if (result.status == TrackStatus::lost) {
    result.T_world_camera = SE3();
    history_.stop();
    lost_ = reference_ != nullptr;
    ++statistics_.lost;
  } else {
    if (lost_) {
      history_.clear();
      ++statistics_.relocalisations;
    }
    lost_ = false;
    history_.add(time, result.T_world_camera);
    ++statistics_.posed;
  }
  result.milliseconds = milliseconds_since(start);
  return result;
}

Alignment Odometry::track_against_newest(const FramePyramid& pyramid, double time) {
  const SE3& T_world_host = reference_->T_world_camera;
  const auto relative = [&T_world_host](std::vector<SE3> poses) {
    for (SE3& T : poses) T = T.inverse() * T_world_host;
    return poses;
  };
  const auto guesses = relative(motion_guesses(history_, time, T_world_host));
  const int top = pyramid.levels() - 1;
  Alignment best = tracker_.align(reference_->reference, pyramid, guesses.front(), relative_brightness_, top, 0);
  const double limit = options_.accept.retrack * std::max(last_rmse_, 2.0 / 255);
  if (believed(best, false) && (last_rmse_ <= 0.0 || best.rmse <= limit)) return best;
  auto more = guesses;
  for (const double angle : {0.02, 0.05}) {
    const auto turned = relative(rotated_guesses(predict(history_, time), angle));
    more.insert(more.end(), turned.begin(), turned.end());
  }
  const Alignment other = tracker_.align_best(reference_->reference, pyramid, more, relative_brightness_);
  const auto worth = [](const Alignment& a) { return a.finished ? a.inlier_share * a.coverage - a.rmse : -1.0; };
  if (worth(other) > worth(best)) best = other;
  return best;
}

Alignment Odometry::search_window(const FramePyramid& pyramid) {
  // Newest first: the camera was there last. The first keyframe that is believed becomes the reference.
  Alignment best;
  const SE3 T_world_last = history_.has_last ? history_.last : reference_->T_world_camera;
  for (auto k = window_.keyframes.rbegin(); k != window_.keyframes.rend(); ++k) {
    const SE3& T_world_host = (*k)->T_world_camera;
    std::vector<SE3> guesses{SE3(), T_world_last.inverse() * T_world_host};
    for (const double angle : {0.05, 0.12}) {
      for (const SE3& T : rotated_guesses(T_world_host, angle)) guesses.push_back(T.inverse() * T_world_host);
    }
    const Alignment alignment = tracker_.align_best((*k)->reference, pyramid, guesses, {});
    if (believed(alignment, true)) {
      reference_ = *k;
      first_rmse_ = 0.0;
      return alignment;
    }
    if (alignment.inlier_share > best.inlier_share) best = alignment;
  }
  best.finished = false;
  return best;
}

bool Odometry::believed(const Alignment& a, bool was_lost) const {
  const AcceptOptions& accept = options_.accept;
  return a.finished && a.T_target_host.is_finite() &&
         a.inlier_share >= (was_lost ? accept.found_inliers : accept.min_inliers) &&
         a.coverage >= (was_lost ? accept.found_coverage : accept.min_coverage) && a.contrast >= accept.min_contrast &&
         a.contrast <= accept.max_contrast && std::abs(a.brightness.a) <= options_.tracker.max_log_gain;
}

bool Odometry::add_keyframe(const FramePyramid& pyramid, double time, const SE3& T_world_camera,
                            const Brightness& brightness, TrackResult& result) {
  ViewImages view;
  {
    const StageTimer timer(statistics_.stages[stage_render]);
    view = map_.render(camera_, T_world_camera, {options_.keyframe.anchor.enabled, true});
  }
  MadeKeyframe made;
  {
    const StageTimer timer(statistics_.stages[stage_keyframe]);
    made = maker_.make(pyramid, view, T_world_camera, brightness, tracker_);
  }
  result.map_share = made.map_share;
  if (made.keyframe == nullptr) return false;
  const std::shared_ptr<Keyframe>& keyframe = made.keyframe;
  keyframe->id = static_cast<int>(keyframe_poses_.size());
  keyframe->frame = statistics_.frames - 1;
  keyframe->time = time;
  const int drop = keyframe_to_drop(window_, camera_, options_.window);
  if (drop >= 0) window_.keyframes.erase(window_.keyframes.begin() + drop);
  window_.keyframes.push_back(keyframe);
  keyframe_poses_.push_back(T_world_camera);
  optimise();

  reference_ = keyframe;
  relative_brightness_ = {};
  first_rmse_ = 0.0;
  // The frame's own record moves over to its keyframe: its pose is the keyframe's from now on.
  if (!records_.empty() && records_.back().time == time) records_.pop_back();
  records_.push_back({time, keyframe->id, SE3()});
  result.T_world_camera = keyframe->T_world_camera;
  result.keyframe = true;
  result.anchored = made.anchored;
  ++statistics_.keyframes;
  if (made.anchored) ++statistics_.anchored;
  return true;
}

void Odometry::optimise() {
  const StageTimer timer(statistics_.stages[stage_optimise]);
  optimizer_.optimize(window_, camera_);
  for (const auto& keyframe : window_.keyframes) {
    keyframe_poses_[static_cast<std::size_t>(keyframe->id)] = keyframe->T_world_camera;
  }
}

SE3 Odometry::pose_of(const FrameRecord& record) const {
  return keyframe_poses_[static_cast<std::size_t>(record.keyframe)] * record.T_keyframe_camera;
}

Trajectory Odometry::trajectory() const {
  Trajectory trajectory;
  trajectory.reserve(records_.size());
  for (const FrameRecord& record : records_) trajectory.push_back({record.time, pose_of(record), ""});
  return trajectory;
}

}  // namespace odosplat
