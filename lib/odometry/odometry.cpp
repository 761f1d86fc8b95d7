// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/odometry.hpp"

#include <chrono>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/relocalizer.hpp"

namespace odosplat {
namespace {

enum StageIndex : std::size_t {
  stage_pyramid,
  stage_track,
  stage_render,
  stage_keyframe,
  stage_optimise,
  stage_relocalise
};

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

bool shows_nothing(const FramePyramid& pyramid) {
  constexpr double least_spread = 1.0 / 255;
  cv::Scalar mean;
  cv::Scalar spread;
  cv::meanStdDev(pyramid.gray.back(), mean, spread);
  return !(spread[0] > least_spread);
}

}  // namespace

void AcceptOptions::check() const {
  require(min_inliers >= 0.0 && min_inliers <= 1.0, "accept.min_inliers", "in [0, 1]");
  require(min_coverage >= 0.0 && min_coverage <= 1.0, "accept.min_coverage", "in [0, 1]");
  require(min_contrast >= 0.0 && max_contrast > min_contrast, "accept.min_contrast", "in [0, max_contrast)");
  require(min_correlation >= -1.0 && min_correlation <= 1.0, "accept.min_correlation", "in [-1, 1]");
  require(sure_correlation >= min_correlation, "accept.sure_correlation", "at least min_correlation");
  require(min_map_correlation >= -1.0 && min_map_correlation <= 1.0, "accept.min_map_correlation", "in [-1, 1]");
  require(min_map_share >= 0.0 && min_map_share <= 1.0, "accept.min_map_share", "in [0, 1]");
  require(retrack >= 1.0, "accept.retrack", "at least 1");
  require(retrack_outliers >= 0.0, "accept.retrack_outliers", "at least 0");
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
      map_(map),
      options_(options),
      T_world_camera_start_(T_world_camera_start),
      tracker_(options.tracker),
      maker_(options.keyframe),
      optimizer_(options.optimizer) {
  camera_.check();
  options_.check();
  require(T_world_camera_start.is_finite(), "start pose", "finite");
  statistics_.stages = {{"pyramid"}, {"track"}, {"render"}, {"keyframe"}, {"optimise"}, {"relocalise"}};
}

Odometry::Odometry(const Camera& camera, MapView& map, const OdometryOptions& options, Relocalizer& relocalizer)
    : Odometry(camera, map, options, SE3()) {
  T_world_camera_start_.reset();
  relocalizer_ = &relocalizer;
}

TrackResult Odometry::track(const GrayImage& image, double time) {
  const auto start = Clock::now();
  FramePyramid pyramid;
  {
    const StageTimer timer(statistics_.stages[stage_pyramid]);
    pyramid = build_frame_pyramid(camera_, image, options_.keyframe.smoothing);
  }
  TrackResult result;
  ++statistics_.frames;
  if (shows_nothing(pyramid)) {
    // A covered lens is not worth a search.
  } else if (reference_ == nullptr) {
    // Until the first keyframe stands, the camera is where the caller said.
    if (!T_world_camera_start_) {
      relocalise(image, pyramid, time, result);
    } else if (add_keyframe(pyramid, time, *T_world_camera_start_, {}, result)) {
      result.status = TrackStatus::ok;
      result.inlier_share = 1.0;
      result.coverage = 1.0;
      result.covariance = options_.covariance_factor * reference_->covariance;
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
    result.correlation = alignment.correlation;
    const bool is_believed = believed(alignment, lost_);
    const bool is_doubtful = is_believed && !lost_ && !as_good_as_last(alignment) &&
                             alignment.correlation < options_.accept.sure_correlation;
    if (is_doubtful &&
        relocalise(image, pyramid, time, result, reference_->T_world_camera * alignment.T_target_host.inverse())) {
      // The camera is where the map says.
    } else if (is_believed) {
      result.status = lost_ ? TrackStatus::relocalised : TrackStatus::ok;
      const SE3 T_keyframe_camera = alignment.T_target_host.inverse();
      records_.push_back({time, reference_->id, T_keyframe_camera});
      result.T_world_camera = reference_->T_world_camera * T_keyframe_camera;
      // exp(xi) right of T_target_host is exp(-Ad xi) left of T_world_camera; the keyframe's own error comes on top.
      const Matrix6d adjoint = reference_->T_world_camera.adjoint();
      Matrix6d information = alignment.information;
      information.diagonal().array() += 1e-9;
      result.covariance =
          options_.covariance_factor * (adjoint * information.inverse() * adjoint.transpose() + reference_->covariance);
      relative_brightness_ = alignment.brightness;
      last_rmse_ = alignment.rmse;
      last_inlier_share_ = alignment.inlier_share;
      const double first_rmse = first_rmse_;
      if (first_rmse_ <= 0.0) first_rmse_ = std::max(alignment.rmse, 1.0 / 255);
      const KeyframeScore score = keyframe_score(reference_->reference, alignment, first_rmse, options_.policy);
      if (score.score > 1.0) {
        const Brightness brightness = compose_brightness(alignment.brightness, reference_->brightness);
        if (add_keyframe(pyramid, time, result.T_world_camera, brightness, result)) {
          result.covariance = options_.covariance_factor * reference_->covariance;
          if (map_contradicts(result)) relocalise(image, pyramid, time, result, result.T_world_camera);
        }
      }
    } else {
      relocalise(image, pyramid, time, result);
    }
  }
  if (result.status == TrackStatus::lost) {
    result.T_world_camera = SE3();
    history_.stop();
    lost_ = reference_ != nullptr;
    ++statistics_.lost;
  } else {
    lost_in_a_row_ = 0;
    if (result.status == TrackStatus::relocalised) {
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
  const TrackingReference& reference = reference_->reference;
  const int top = pyramid.levels() - 1;
  Alignment best = tracker_.align(reference, pyramid, guesses.front(), relative_brightness_, top, 0);
  if (believed(best, false) && as_good_as_last(best)) return best;

  const auto worth = [](const Alignment& a) { return a.finished ? a.inlier_share * a.coverage - a.rmse : -1.0; };
  const auto offer = [&](const Alignment& other) {
    if (worth(other) > worth(best)) best = other;
  };
  // Repeated patterns lead coarse levels astray where the prediction itself was close: start lower.
  for (int level = std::min(2, top - 1); level >= 0; --level) {
    offer(tracker_.align(reference, pyramid, guesses.front(), relative_brightness_, level, 0));
  }
  if (believed(best, false) && as_good_as_last(best)) return best;
  auto more = guesses;
  for (const double angle : {0.02, 0.05}) {
    const auto turned = relative(rotated_guesses(predict(history_, time), angle));
    more.insert(more.end(), turned.begin(), turned.end());
  }
  offer(tracker_.align_best(reference, pyramid, more, relative_brightness_));
  return best;
}

bool Odometry::as_good_as_last(const Alignment& a) const {
  if (last_rmse_ <= 0.0) return true;
  const AcceptOptions& accept = options_.accept;
  return a.rmse <= accept.retrack * std::max(last_rmse_, 2.0 / 255) &&
         1.0 - a.inlier_share <= accept.retrack * (1.0 - last_inlier_share_) + accept.retrack_outliers;
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

bool Odometry::relocalise(const GrayImage& image, const FramePyramid& pyramid, double time, TrackResult& result,
                          const std::optional<SE3>& T_world_tracked) {
  // A look-up costs as much as tracking many frames: after a while it is tried less often.
  constexpr int eager = 15;
  constexpr int every = 5;
  const int before = lost_in_a_row_++;
  if (relocalizer_ == nullptr || (before >= eager && before % every != 0)) return false;
  Relocalization answer;
  {
    const StageTimer timer(statistics_.stages[stage_relocalise]);
    answer = history_.has_last ? relocalizer_->find(image, history_.last) : relocalizer_->find(image);
  }
  if (!answer.found) return false;
  constexpr double same_distance = 0.1;  // [m]
  constexpr double same_angle = 0.1;     // [rad]
  if (T_world_tracked) {
    const SE3 T_tracked_found = T_world_tracked->inverse() * answer.T_world_camera;
    if (T_tracked_found.translation().norm() < same_distance && T_tracked_found.angle() < same_angle) return false;
  }
  window_.keyframes.clear();
  if (!add_keyframe(pyramid, time, answer.T_world_camera, {}, result)) return false;
  result.status = TrackStatus::relocalised;
  result.inlier_share = answer.inlier_share;
  result.coverage = 1.0;
  result.covariance = options_.covariance_factor * reference_->covariance;
  return true;
}

bool Odometry::believed(const Alignment& a, bool was_lost) const {
  const AcceptOptions& accept = options_.accept;
  return a.finished && a.T_target_host.is_finite() &&
         a.inlier_share >= (was_lost ? accept.found_inliers : accept.min_inliers) &&
         a.coverage >= (was_lost ? accept.found_coverage : accept.min_coverage) && a.contrast >= accept.min_contrast &&
         a.contrast <= accept.max_contrast && a.correlation >= accept.min_correlation &&
         std::abs(a.brightness.a) <= options_.tracker.max_log_gain;
}

bool Odometry::map_contradicts(const TrackResult& keyframe) {
  const AcceptOptions& accept = options_.accept;
  const bool agreed = map_agreed_;
  map_agreed_ = keyframe.map_correlation >= accept.min_map_correlation;
  return options_.keyframe.anchor.enabled && agreed && !map_agreed_ && keyframe.map_share >= accept.min_map_share;
}

bool Odometry::add_keyframe(const FramePyramid& pyramid, double time, const SE3& T_world_camera,
                            const Brightness& brightness, TrackResult& result) {
  const AnchorOptions& anchor = options_.keyframe.anchor;
  SE3 T_world_keyframe = T_world_camera;
  MadeKeyframe made;
  double corrected = 0.0;
  // Seen from where the map says the camera is, if that is elsewhere: depth and colour must belong to the pixel.
  for (int attempt = 0; attempt < 3; ++attempt) {
    ViewImages view;
    {
      const StageTimer timer(statistics_.stages[stage_render]);
      view = map_.render(camera_, T_world_keyframe, {anchor.enabled, true});
    }
    const StageTimer timer(statistics_.stages[stage_keyframe]);
    made = maker_.make(pyramid, view, T_world_keyframe, brightness, tracker_);
    if (!made.anchored) break;
    corrected = std::max(corrected, made.map_flow);
    T_world_keyframe = made.T_world_camera_map;
    if (made.map_flow <= anchor.render_again_flow) break;
  }
  result.map_share = made.map_share;
  result.map_correlation = made.anchor.correlation;
  if (made.keyframe == nullptr) return false;
  const std::shared_ptr<Keyframe>& keyframe = made.keyframe;
  keyframe->id = static_cast<int>(keyframe_records_.size());
  keyframe->frame = statistics_.frames - 1;
  keyframe->time = time;
  if (made.anchored) keyframe->T_world_camera = T_world_keyframe;
  if (made.anchored && corrected > anchor.reset_flow) window_.keyframes.clear();
  const int drop = keyframe_to_drop(window_, camera_, options_.window);
  if (drop >= 0) window_.keyframes.erase(window_.keyframes.begin() + drop);
  window_.keyframes.push_back(keyframe);
  KeyframeRecord record{time, keyframe->T_world_camera, -1, {}};
  // The frame's own record moves over to its keyframe: its pose is the keyframe's from now on.
  if (reference_ != nullptr && !records_.empty() && records_.back().time == time) {
    record.previous = records_.back().keyframe;
    record.T_previous_camera = records_.back().T_keyframe_camera;
    records_.pop_back();
  }
  records_.push_back({time, keyframe->id, SE3()});
  keyframe_records_.push_back(record);
  optimise();

  reference_ = keyframe;
  relative_brightness_ = {};
  first_rmse_ = 0.0;
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
    keyframe_records_[static_cast<std::size_t>(keyframe->id)].T_world_camera = keyframe->T_world_camera;
  }
}

Trajectory Odometry::trajectory() const {
  // Keyframe that was tracked against keyframe k, if any: the far end of the frames that belong to k.
  std::vector<int> next(keyframe_records_.size(), -1);
  for (std::size_t id = 0; id < keyframe_records_.size(); ++id) {
    const int previous = keyframe_records_[id].previous;
    if (previous >= 0) next[static_cast<std::size_t>(previous)] = static_cast<int>(id);
  }
  Trajectory trajectory;
  trajectory.reserve(records_.size());
  for (const FrameRecord& record : records_) {
    const KeyframeRecord& host = keyframe_records_[static_cast<std::size_t>(record.keyframe)];
    SE3 T_world_camera = host.T_world_camera * record.T_keyframe_camera;
    const int far = next[static_cast<std::size_t>(record.keyframe)];
    if (far >= 0) {
      const KeyframeRecord& end = keyframe_records_[static_cast<std::size_t>(far)];
      const double share = (record.time - host.time) / (end.time - host.time);
      // The correction is a motion of the camera in its own frame: a small turn must not swing it about the world's
      // origin.
      const SE3 correction = (host.T_world_camera * end.T_previous_camera).inverse() * end.T_world_camera;
      if (share > 0.0 && share < 1.0) T_world_camera = T_world_camera * SE3::exp(share * correction.log());
    }
    trajectory.push_back({record.time, T_world_camera, ""});
  }
  return trajectory;
}

}  // namespace odosplat
