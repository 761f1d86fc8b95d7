// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/odometry.hpp"

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/frame/least_size.hpp"
#include "odosplat/odometry/frame/row_shift.hpp"
#include "odosplat/odometry/keyframe/keyframe_thread.hpp"
#include "odosplat/odometry/relocalise/relocalizer.hpp"

namespace odosplat {
namespace {

enum StageIndex : std::size_t { stage_pyramid, stage_track, stage_relocalise };

bool shows_nothing(const FramePyramid& pyramid) {
  constexpr double least_spread = 1.0 / 255;
  cv::Scalar mean;
  cv::Scalar spread;
  cv::meanStdDev(pyramid.gray.back(), mean, spread);
  return !(spread[0] > least_spread);
}

}  // namespace

void OdometryOptions::check() const {
  aligner.check();
  keyframe.check();
  confirmation.check();
  misfit.check();
  memory.check();
  policy.check();
  window.check();
  optimizer.check();
  marginalization.check();
  activation.check();
  drift.check();
  accept.check();
  require(frame_covariance_factor > 0.0, "frame_covariance_factor", "positive");
  require(keyframe_covariance_factor > 0.0, "keyframe_covariance_factor", "positive");
  require(prefetch_images >= 0.0, "prefetch_images", "at least 0");
  require(max_unconfirmed >= 0, "max_unconfirmed", "at least 0");
  require(max_misfit_translation > 0.0 && max_misfit_rotation > 0.0, "max_misfit_translation and max_misfit_rotation",
          "positive");
}

bool OdometryOptions::allows(const MisfitEffect& effect, double sigmas) const {
  return misfit_limits().allow(effect, sigmas);
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
      front_({options.aligner, options.policy, options.accept}),
      backend_(
          camera, map, front_.aligner(),
          {options.keyframe, options.confirmation, options.misfit, options.memory, options.window, options.optimizer,
           options.marginalization, options.activation, options.drift, options.misfit_limits()}) {
  camera_.check();
  check_least_size(camera_);
  options_.check();
  require(T_world_camera_start.is_finite(), "start pose", "finite");
  if (options_.background) {
    keyframes_ = std::make_unique<KeyframeThread>(backend_);
  } else {
    keyframes_ = std::make_unique<InlineKeyframes>(backend_);
  }
}

Odometry::Odometry(const Camera& camera, MapView& map, const OdometryOptions& options, Relocalizer& relocalizer)
    : Odometry(camera, map, options, SE3()) {
  T_world_camera_start_.reset();
  relocalizer_ = &relocalizer;
}

TrackResult Odometry::track(const GrayImage& image, double time, std::shared_ptr<MapView> view) {
  const auto start = SteadyClock::now();
  take_over(keyframes_->take());
  KeyframeRequest request;
  request.view = std::move(view);
  request.frame.number = counts_.frames;
  request.frame.time = time;
  {
    const StageTimer timer(stages_[stage_pyramid]);
    request.frame.image =
        make_even(std::make_shared<FramePyramid>(build_frame_pyramid(camera_, image, options_.keyframe.smoothing)));
  }
  TrackResult result;
  ++counts_.frames;
  if (shows_nothing(*request.frame.image.taken)) {
    // A covered lens is not worth a search.
  } else if (!front_.empty()) {
    follow(image, request, result);
  } else if (!T_world_camera_start_) {
    relocalise(image, request, result);
  } else {
    // Until there is a keyframe, the camera is at the caller's start pose.
    request.frame.T_world_camera = *T_world_camera_start_;
    const bool made = make_keyframe(request, result);
    if (made && !stands(keyframe_evidence_, keyframe_misfit_, true)) {
      refuse(image, request, result, keyframe_evidence_);
    } else if (made) {
      result.status = TrackStatus::ok;
      result.inlier_share = 1.0;
      result.coverage = 1.0;
      result.evidence = keyframe_evidence_;
    } else if (options_.confirmation.enabled) {
      relocalise(image, request, result);  // the map shows nothing from there
    }
  }
  result.map_share = map_share_;
  if (result.status == TrackStatus::lost) {
    result.T_world_camera = SE3();
    record_.withdraw(time);
    front_.lose();
    ++counts_.lost;
  } else {
    judge(result);
    lost_in_a_row_ = 0;
    if (result.status == TrackStatus::relocalised) ++counts_.relocalisations;
    front_.confirm(time, result.T_world_camera);
    ++counts_.posed;
  }
  result.milliseconds = milliseconds_since(start);
  return result;
}

void Odometry::follow(const GrayImage& image, KeyframeRequest& request, TrackResult& result) {
  TrackedFrame tracked;
  {
    const StageTimer timer(stages_[stage_track]);
    tracked = front_.track(request.frame);
  }
  result.inlier_share = tracked.alignment.inlier_share;
  result.coverage = tracked.alignment.coverage;
  result.rmse = tracked.alignment.rmse;
  result.correlation = tracked.alignment.correlation;
  if (!tracked.found) {
    relocalise(image, request, result);
    return;
  }
  result.evidence = tracked.evidence;
  if (tracked.verifiable &&
      !stands(tracked.evidence, tracked.misfit, tracked.was_lost || tracked.after_gap || to_be_confirmed_)) {
    refuse(image, request, result, tracked.evidence);
    return;
  }
  if (tracked.doubtful && relocalise(image, request, result, tracked.frame.T_world_camera)) return;
  result.status = tracked.was_lost ? TrackStatus::relocalised : TrackStatus::ok;
  result.T_world_camera = tracked.frame.T_world_camera;
  result.covariance = options_.frame_covariance_factor * tracked.covariance +
                      options_.keyframe_covariance_factor * tracked.keyframe_covariance + tracked.misfit.covariance;
  if (tracked.misfit.significant()) result.misfit = tracked.misfit.meters;
  record_.add_frame(request.frame.time, tracked.keyframe, tracked.T_keyframe_camera, tracked.was_lost);
  request.frame = tracked.frame;
  keyframes_->observe(tracked.frame);
  // Old keyframes may find a camera that was lost, but the map, rendered from there, must confirm it.
  const bool came_back = tracked.was_lost && tracked.verifiable;
  if (came_back) finish();
  if (tracked.keyframe_due() || came_back) {
    request.to_be_confirmed = came_back;
    const bool made = make_keyframe(request, result, came_back);
    if (!made && !came_back) return;
    if (keyframe_evidence_.verdict == Confirmation::confirmed) result.evidence = keyframe_evidence_;
    // A keyframe that is to be confirmed is made only if it stands.
    const bool refused = came_back ? !made && !stands(keyframe_evidence_, keyframe_misfit_, true)
                                   : to_be_confirmed_ && result.evidence.verdict != Confirmation::confirmed;
    if (refused) refuse(image, request, result, keyframe_evidence_);
  } else if (keyframes_->renders_ahead() && request.view == nullptr) {
    render_ahead(tracked);
  }
}

bool Odometry::stands(const MapEvidence& evidence, const MisfitEffect& misfit, bool to_be_confirmed) const {
  if (front_.empty() || front_.newest().patches == nullptr) return true;
  if (!options_.allows(misfit, to_be_confirmed ? MisfitEffect::likely_sigmas : MisfitEffect::significant_sigmas))
    return false;
  if (evidence.verdict == Confirmation::confirmed) return true;
  return !to_be_confirmed && evidence.verdict != Confirmation::contradicted;
}

void Odometry::refuse(const GrayImage& image, const KeyframeRequest& request, TrackResult& result,
                      const MapEvidence& evidence) {
  TrackResult refused;
  refused.inlier_share = result.inlier_share;
  refused.coverage = result.coverage;
  refused.rmse = result.rmse;
  refused.correlation = result.correlation;
  refused.evidence = evidence;
  result = refused;
  ++counts_.refused;
  relocalise(image, request, result);
}

void Odometry::judge(TrackResult& result) {
  const bool confirmed = result.evidence.verdict == Confirmation::confirmed;
  unconfirmed_ = confirmed ? 0 : unconfirmed_ + 1;
  if (confirmed) {
    ++counts_.confirmed;
    to_be_confirmed_ = false;
  }
  if (!in_map_) return;
  const bool silent = result.evidence.verdict == Confirmation::none && unconfirmed_ <= options_.max_unconfirmed;
  result.in_map = confirmed || silent || front_.newest().patches == nullptr;
  if (!result.in_map) result.covariance += unconfirmed_ * drift_covariance(options_.drift, result.T_world_camera);
}

bool Odometry::relocalise(const GrayImage& image, const KeyframeRequest& request, TrackResult& result,
                          const std::optional<SE3>& T_world_tracked) {
  // A look-up costs as much as tracking many frames: after a while it is tried less often.
  constexpr int eager = 15;
  constexpr int every = 5;
  const int before = lost_in_a_row_++;
  if (relocalizer_ == nullptr || (before >= eager && before % every != 0)) return false;
  finish();  // from here on no other thread uses the map
  Relocalization answer;
  {
    const StageTimer timer(stages_[stage_relocalise]);
    const MotionHistory& history = front_.history();
    answer = history.has_last ? relocalizer_->find(image, history.last) : relocalizer_->find(image);
  }
  if (!answer.found) return false;
  constexpr double same_distance = 0.1;  // [m]
  constexpr double same_angle = 0.1;     // [rad]
  if (T_world_tracked) {
    const SE3 T_tracked_found = T_world_tracked->inverse() * answer.T_world_camera;
    if (T_tracked_found.translation().norm() < same_distance && T_tracked_found.angle() < same_angle) return false;
  }
  KeyframeRequest afresh = request;
  afresh.frame.T_world_camera = answer.T_world_camera;
  afresh.frame.brightness = {};
  afresh.frame.velocity.setZero();
  if (!request.frame.image.taken->row_motion.isZero(0.0)) {
    afresh.frame.image =
        make_even(std::make_shared<FramePyramid>(with_row_motion(*request.frame.image.taken, Vector6d::Zero())));
  }
  afresh.to_be_confirmed = false;
  afresh.fresh = true;
  TrackResult made;
  front_.lose();  // the motion that led here is unknown, and the estimates for this frame do not hold
  if (!make_keyframe(afresh, made) || !stands(keyframe_evidence_, keyframe_misfit_, true)) return false;
  result.evidence = keyframe_evidence_;
  result.misfit = made.misfit;
  result.status = TrackStatus::relocalised;
  result.T_world_camera = made.T_world_camera;
  result.covariance = made.covariance;
  result.keyframe = true;
  result.anchored = made.anchored;
  result.inlier_share = answer.inlier_share;
  result.coverage = 1.0;
  return true;
}

void Odometry::finish() { take_over(keyframes_->wait()); }

bool Odometry::make_keyframe(const KeyframeRequest& request, TrackResult& result, bool wait) {
  // Without a keyframe to track against, the result has to be waited for.
  const std::optional<FinishedKeyframe> finished = keyframes_->make(request, wait || front_.empty() || request.fresh);
  take_over(finished);
  if (!finished || !finished->outcome.made) return false;
  result.T_world_camera = front_.newest().T_world_camera;
  result.covariance = options_.keyframe_covariance_factor * front_.newest().covariance + keyframe_misfit_.covariance;
  result.misfit = keyframe_misfit_.significant() ? keyframe_misfit_.meters : 0.0;
  result.keyframe = true;
  result.anchored = finished->outcome.anchored;
  return true;
}

void Odometry::take_over(const std::optional<FinishedKeyframe>& finished) {
  if (!finished) return;
  const KeyframeRequest& request = finished->request;
  const KeyframeOutcome& outcome = finished->outcome;
  map_share_ = outcome.map_share;
  keyframe_evidence_ = outcome.evidence;
  keyframe_misfit_ = outcome.misfit;
  rendered_ahead_ = false;
  if (!outcome.made) return;
  counts_.likely_cause = outcome.likely_cause;
  in_map_ = outcome.in_map;
  const ReferenceFrame& keyframe = outcome.window.back();
  record_.add_keyframe(request.frame.time, keyframe.T_world_camera, request.fresh);
  for (const ReferenceFrame& k : outcome.window) record_.move_keyframe(k.id, k.T_world_camera);
  ++counts_.keyframes;
  if (outcome.anchored) ++counts_.anchored;
  if (outcome.prefetched) ++counts_.prefetched;
  front_.set_references(outcome.window, keyframe.T_world_camera * request.frame.T_world_camera.inverse());
  to_be_confirmed_ =
      in_map_ && outcome.evidence.verdict != Confirmation::none && !stands(outcome.evidence, outcome.misfit, false);
}

void Odometry::render_ahead(const TrackedFrame& tracked) {
  const double time = tracked.frame.time;
  MotionHistory history = front_.history();
  if (rendered_ahead_ || tracked.was_lost || !history.has_last || !(tracked.keyframe_score > 0.0)) return;
  // The score grows about evenly with time from 0 at the keyframe.
  const double keyframe_time = record_.keyframe_time(tracked.keyframe);
  const double due = keyframe_time + (time - keyframe_time) / tracked.keyframe_score;
  const double interval = time - history.last_time;
  const double images = std::ceil((due - time) / interval);
  if (!(images <= options_.prefetch_images)) return;
  history.add(time, tracked.frame.T_world_camera);
  keyframes_->prefetch(predict(history, time + images * interval));
  rendered_ahead_ = true;
}

OdometryStatistics Odometry::statistics() const {
  OdometryStatistics all = counts_;
  all.stages = stages_;
  const std::vector<StageTime> backend = keyframes_->stages();
  all.stages.insert(all.stages.end(), backend.begin(), backend.end());
  return all;
}

}  // namespace odosplat
