// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/odometry.hpp"

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/least_size.hpp"
#include "odosplat/odometry/relocalizer.hpp"

namespace odosplat {
namespace {

enum StageIndex : std::size_t { stage_pyramid, stage_track, stage_relocalise };

constexpr int most_start_lookups = 3;  // keyframes: the first may show nothing that is found

bool shows_nothing(const FramePyramid& pyramid) {
  constexpr double least_spread = 1.0 / 255;
  cv::Scalar mean;
  cv::Scalar spread;
  cv::meanStdDev(pyramid.gray.back(), mean, spread);
  return !(spread[0] > least_spread);
}

}  // namespace

void OdometryOptions::check() const {
  tracker.check();
  keyframe.check();
  memory.check();
  policy.check();
  window.check();
  optimizer.check();
  marginalisation.check();
  activation.check();
  drift.check();
  accept.check();
  require(frame_covariance_factor > 0.0, "frame_covariance_factor", "positive");
  require(keyframe_covariance_factor > 0.0, "keyframe_covariance_factor", "positive");
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
      backend_(camera, map, front_.aligner(),
               {options.keyframe, options.memory, options.window, options.optimizer, options.marginalisation,
                options.activation, options.drift}) {
  camera_.check();
  check_least_size(camera_);
  options_.check();
  require(T_world_camera_start.is_finite(), "start pose", "finite");
  if (options_.background) thread_ = std::make_unique<KeyframeThread>(backend_);
}

Odometry::Odometry(const Camera& camera, MapView& map, const OdometryOptions& options, Relocalizer& relocalizer)
    : Odometry(camera, map, options, SE3()) {
  T_world_camera_start_.reset();
  relocalizer_ = &relocalizer;
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
    request.image =
        make_even(std::make_shared<FramePyramid>(build_frame_pyramid(camera_, image, options_.keyframe.smoothing)));
  }
  TrackResult result;
  ++counts_.frames;
  if (shows_nothing(*request.image.taken)) {
    // A covered lens is not worth a search.
  } else if (!front_.empty()) {
    follow(image, request, result);
  } else if (!T_world_camera_start_) {
    relocalise(image, request, result);
  } else {
    // Until the first keyframe stands, the camera is where the caller said.
    request.T_world_camera = *T_world_camera_start_;
    start_lookups_ = most_start_lookups;
    make_keyframe(request, result);
    if (result.keyframe) {
      result.status = TrackStatus::ok;
      result.inlier_share = 1.0;
      result.coverage = 1.0;
      look_up_contradicted(image, request, result);
    }
  }
  result.map_share = map_share_;
  result.map_correlation = map_correlation_;
  result.in_map = in_map_ && result.status != TrackStatus::lost;
  if (result.status == TrackStatus::lost) {
    result.T_world_camera = SE3();
    front_.lose();
    ++counts_.lost;
  } else {
    lost_in_a_row_ = 0;
    if (result.status == TrackStatus::relocalised) ++counts_.relocalisations;
    front_.confirm(time, result.T_world_camera);
    ++counts_.posed;
  }
  result.milliseconds = milliseconds_since(start);
  return result;
}

void Odometry::follow(const GrayImage& image, KeyframeRequest& request, TrackResult& result) {
  TrackedFrame frame;
  {
    const StageTimer timer(stages_[stage_track]);
    frame = front_.track(request.image.taken, request.time);
  }
  result.inlier_share = frame.alignment.inlier_share;
  result.coverage = frame.alignment.coverage;
  result.rmse = frame.alignment.rmse;
  result.correlation = frame.alignment.correlation;
  if (!frame.found) {
    relocalise(image, request, result);
    return;
  }
  if (frame.doubtful && relocalise(image, request, result, frame.T_world_camera)) return;
  result.status = frame.was_lost ? TrackStatus::relocalised : TrackStatus::ok;
  result.T_world_camera = frame.T_world_camera;
  result.covariance = options_.frame_covariance_factor * frame.covariance +
                      options_.keyframe_covariance_factor * frame.keyframe_covariance;
  record_.add_frame(request.time, frame.keyframe, frame.T_keyframe_camera, frame.was_lost);
  request.T_world_camera = frame.T_world_camera;
  request.brightness = frame.brightness;
  request.image = frame.image;
  const TrackedImage tracked{frame.image.even, frame.T_world_camera, frame.brightness};
  if (thread_ != nullptr) {
    thread_->observe(tracked);
  } else {
    backend_.trace(tracked);
  }
  if (frame.keyframe_due()) {
    make_keyframe(request, result);
    if (result.keyframe) look_up_contradicted(image, request, result);
  } else if (thread_ != nullptr && request.view == nullptr) {
    render_ahead(frame, request.time);
  }
}

bool Odometry::relocalise(const GrayImage& image, const KeyframeRequest& request, TrackResult& result,
                          const std::optional<SE3>& T_world_tracked) {
  // A look-up costs as much as tracking many frames: after a while it is tried less often.
  constexpr int eager = 15;
  constexpr int every = 5;
  const int before = lost_in_a_row_++;
  if (relocalizer_ == nullptr || (before >= eager && before % every != 0)) return false;
  finish();  // the map is ours from here on
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
  afresh.T_world_camera = answer.T_world_camera;
  afresh.brightness = {};
  afresh.fresh = true;
  TrackResult made;
  front_.lose();  // how the camera came here is not known, nor what was believed of this frame
  make_keyframe(afresh, made);
  if (!made.keyframe) return false;
  result.status = TrackStatus::relocalised;
  result.T_world_camera = made.T_world_camera;
  result.covariance = made.covariance;
  result.keyframe = true;
  result.anchored = made.anchored;
  result.inlier_share = answer.inlier_share;
  result.coverage = 1.0;
  return true;
}

bool Odometry::map_contradicts() {
  const AcceptOptions& accept = options_.accept;
  const bool agreed = map_agreed_;
  map_agreed_ = map_correlation_ >= accept.min_map_correlation;
  if (!options_.keyframe.anchor.enabled || map_share_ < accept.min_map_share) return false;
  if (map_correlation_ >= accept.sure_map_correlation) start_lookups_ = 0;
  if (start_lookups_ == 0) return agreed && !map_agreed_;
  --start_lookups_;
  return true;
}

void Odometry::look_up_contradicted(const GrayImage& image, const KeyframeRequest& request, TrackResult& result) {
  if (!map_contradicts()) return;
  // A pose that the map has pulled into place is only given up for one elsewhere.
  std::optional<SE3> T_world_tracked;
  if (result.anchored) T_world_tracked = result.T_world_camera;
  if (relocalise(image, request, result, T_world_tracked)) start_lookups_ = 0;
}

void Odometry::finish() {
  if (thread_ != nullptr) take_over_finished(thread_->wait());
}

void Odometry::make_keyframe(const KeyframeRequest& request, TrackResult& result) {
  // With nothing to track against meanwhile, there is nothing to do but wait.
  if (thread_ != nullptr && !front_.empty() && !request.fresh) {
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
  result.covariance = options_.keyframe_covariance_factor * front_.newest().covariance;
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
  map_correlation_ = outcome.map_correlation;
  rendered_ahead_ = false;
  if (!outcome.made) return;
  in_map_ = outcome.in_map;
  const ReferenceFrame& keyframe = outcome.window.back();
  record_.add_keyframe(request.time, keyframe.T_world_camera, request.fresh);
  for (const ReferenceFrame& k : outcome.window) record_.move_keyframe(k.id, k.T_world_camera);
  ++counts_.keyframes;
  if (outcome.anchored) ++counts_.anchored;
  if (outcome.prefetched) ++counts_.prefetched;
  front_.set_references(outcome.window, keyframe.T_world_camera * request.T_world_camera.inverse());
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
