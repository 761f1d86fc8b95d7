// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/frame/frame_tracker.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/frame/row_shift.hpp"

namespace odosplat {

void AcceptOptions::check() const {
  require(min_inliers >= 0.0 && min_inliers <= 1.0, "accept.min_inliers", "in [0, 1]");
  require(min_coverage >= 0.0 && min_coverage <= 1.0, "accept.min_coverage", "in [0, 1]");
  require(min_contrast >= 0.0 && max_contrast > min_contrast, "accept.min_contrast", "in [0, max_contrast)");
  require(min_correlation >= -1.0 && min_correlation <= 1.0, "accept.min_correlation", "in [-1, 1]");
  require(sure_correlation >= min_correlation, "accept.sure_correlation", "at least min_correlation");
  require(motion_translation > 0.0 && motion_rotation > 0.0, "accept.motion_translation and motion_rotation",
          "positive");
  require(retrack >= 1.0, "accept.retrack", "at least 1");
  require(retrack_outliers >= 0.0, "accept.retrack_outliers", "at least 0");
  require(found_inliers >= 0.0 && found_inliers <= 1.0, "accept.found_inliers", "in [0, 1]");
  require(found_coverage >= 0.0 && found_coverage <= 1.0, "accept.found_coverage", "in [0, 1]");
}

void FrameTrackerOptions::check() const {
  aligner.check();
  policy.check();
  accept.check();
}

FrameTracker::FrameTracker(const FrameTrackerOptions& options) : options_(options), aligner_(options.aligner) {
  options_.check();
}

TrackedFrame FrameTracker::track(const PosedFrame& frame) {
  TrackedFrame tracked;
  tracked.frame = frame;
  tracked.was_lost = lost_;
  // The row gain of flickering light changes little from frame to frame: the last one is a good start.
  tracked.frame.image = make_even(with_predicted_rows(frame), last_row_gain_);
  if (!lost_) tracked.alignment = track_against_reference(*tracked.frame.image.even, frame.time);
  if (lost_ || !believed(tracked.alignment, false)) tracked.alignment = search_references(*tracked.frame.image.even);
  tracked.found = believed(tracked.alignment, lost_);
  if (!tracked.found) return tracked;
  measure_rows(tracked);
  even_rows(aligner_, *reference().points, tracked.frame.image, tracked.alignment);
  last_row_gain_ = tracked.frame.image.row_gain;
  const Alignment& alignment = tracked.alignment;
  const ReferenceFrame& host = reference();
  tracked.doubtful = !lost_ && !as_good_as_last(alignment) && alignment.correlation < options_.accept.sure_correlation;
  tracked.after_gap = history_.has_velocity && steps_ahead(history_, frame.time) == 0.0;
  tracked.keyframe = host.id;
  tracked.T_keyframe_camera = alignment.T_target_host.inverse();
  tracked.frame.T_world_camera = host.T_world_camera * tracked.T_keyframe_camera;
  tracked.frame.brightness = compose_brightness(alignment.brightness, host.brightness);
  if (steps_ahead(history_, frame.time) > 0.0)
    tracked.frame.velocity = velocity_to(history_, frame.time, tracked.frame.T_world_camera);
  if (host.patches != nullptr) {
    tracked.evidence = host.patches->compare(*tracked.frame.image.even, tracked.frame.T_world_camera);
    tracked.verifiable = host.in_map;
    tracked.misfit = host.misfit;
  }
  // exp(xi) right of T_target_host is exp(-Ad xi) left of T_world_camera.
  const Matrix6d adjoint = host.T_world_camera.adjoint();
  Matrix6d information = alignment.information;
  information.diagonal().array() += 1e-9;
  tracked.covariance = adjoint * information.inverse() * adjoint.transpose();
  tracked.keyframe_covariance = host.covariance;
  relative_brightness_ = alignment.brightness;
  last_brightness_ = tracked.frame.brightness;
  last_rmse_ = alignment.rmse;
  last_inlier_share_ = alignment.inlier_share;
  const double first_rmse = first_rmse_;
  if (first_rmse_ <= 0.0) first_rmse_ = std::max(alignment.rmse, 1.0 / 255);
  tracked.keyframe_score = keyframe_score(*host.points, alignment, first_rmse, options_.policy).score;
  return tracked;
}

std::shared_ptr<const FramePyramid> FrameTracker::with_predicted_rows(const PosedFrame& frame) const {
  const double readout = frame.image.taken->cameras.front().readout;
  // Images that are said to be closer in time than half the readout have times of arrival, not of exposure: the motion
  // between them says nothing about their rows.
  const bool timed = frame.time - history_.last_time > 0.5 * std::abs(readout);
  if (readout == 0.0 || lost_ || !timed || !(steps_ahead(history_, frame.time) > 0.0)) return frame.image.taken;
  const Vector6d velocity = velocity_to(history_, frame.time, predict(history_, frame.time));
  return std::make_shared<FramePyramid>(with_row_motion(*frame.image.taken, readout * velocity));
}

void FrameTracker::measure_rows(TrackedFrame& tracked) const {
  EvenFrame& image = tracked.frame.image;
  if (image.taken->row_motion.isZero(0.0)) return;
  const SE3 T_world_camera = reference().T_world_camera * tracked.alignment.T_target_host.inverse();
  const Vector6d velocity = velocity_to(history_, tracked.frame.time, T_world_camera);
  const double readout = image.taken->cameras.front().readout;
  image.taken = std::make_shared<FramePyramid>(with_row_motion(*image.taken, readout * velocity));
  image = make_even(image.taken, image.row_gain);
  const Alignment again = aligner_.align(*reference().points, *image.even, tracked.alignment.T_target_host,
                                         tracked.alignment.brightness, 0, 0);
  if (believed(again, false)) tracked.alignment = again;
}

void FrameTracker::set_references(std::vector<ReferenceFrame> references, const SE3& T_new_old) {
  history_.move(T_new_old);
  const int newest_before = references_.empty() ? -1 : references_.back().id;
  const int current_before = references_.empty() ? -1 : reference().id;
  references_ = std::move(references);
  current_ = references_.size() - 1;
  if (references_.back().id != newest_before) {
    first_rmse_ = 0.0;
    // After a loss the newest keyframe is the last frame itself, and the brightness estimated before does not hold for
    // it.
    if (lost_) last_brightness_ = references_.back().brightness;
    relative_brightness_ = relative_brightness(last_brightness_, references_.back().brightness);
    return;
  }
  for (std::size_t k = 0; k < references_.size(); ++k) {
    if (references_[k].id == current_before) current_ = k;
  }
}

void FrameTracker::confirm(double time, const SE3& T_world_camera) {
  if (lost_) history_.clear();
  lost_ = false;
  history_.add(time, T_world_camera);
}

void FrameTracker::lose() {
  history_.stop();
  last_row_gain_.clear();
  lost_ = !references_.empty();
}

Alignment FrameTracker::track_against_reference(const FramePyramid& pyramid, double time) const {
  const SE3& T_world_host = reference().T_world_camera;
  const TrackingReference& points = *reference().points;
  const auto relative = [&T_world_host](std::vector<SE3> poses) {
    for (SE3& T : poses) T = T.inverse() * T_world_host;
    return poses;
  };
  const auto guesses = relative(motion_guesses(history_, time, T_world_host));
  const int top = pyramid.levels() - 1;
  // The uncertainty of the prediction grows with the time since the last frame; without a velocity there is no prior.
  const double steps = steps_ahead(history_, time);
  const double scale = std::max(1.0, steps);
  const PosePrior motion =
      pose_prior(guesses.front(), scale * options_.accept.motion_translation, scale * options_.accept.motion_rotation);
  const PosePrior* held = steps > 0.0 ? &motion : nullptr;
  Alignment best = aligner_.align(points, pyramid, guesses.front(), relative_brightness_, top, 0, held);
  if (believed(best, false) && as_good_as_last(best)) return best;

  const auto offer = [&](const Alignment& other) {
    if (worth(other) > worth(best)) best = other;
  };
  // With repeated patterns the coarse levels may converge to a wrong pose although the prediction was close: start at a
  // finer level.
  for (int level = std::min(2, top - 1); level >= 0; --level) {
    offer(aligner_.align(points, pyramid, guesses.front(), relative_brightness_, level, 0, held));
  }
  if (believed(best, false) && as_good_as_last(best)) return best;
  auto more = guesses;
  for (const double angle : {0.02, 0.05}) {
    const auto turned = relative(rotated_guesses(predict(history_, time), angle));
    more.insert(more.end(), turned.begin(), turned.end());
  }
  offer(aligner_.align_best(points, pyramid, more, relative_brightness_));
  return best;
}

bool FrameTracker::as_good_as_last(const Alignment& a) const {
  if (last_rmse_ <= 0.0) return true;
  const AcceptOptions& accept = options_.accept;
  return a.rmse <= accept.retrack * std::max(last_rmse_, 2.0 / 255) &&
         1.0 - a.inlier_share <= accept.retrack * (1.0 - last_inlier_share_) + accept.retrack_outliers;
}

Alignment FrameTracker::search_references(const FramePyramid& pyramid) {
  // Newest first: the camera was there last. The first keyframe with an accepted alignment becomes the reference.
  Alignment best;
  const SE3 T_world_last = history_.has_last ? history_.last : reference().T_world_camera;
  for (std::size_t k = references_.size(); k-- > 0;) {
    const SE3& T_world_host = references_[k].T_world_camera;
    std::vector<SE3> guesses{SE3(), T_world_last.inverse() * T_world_host};
    for (const double angle : {0.05, 0.12}) {
      for (const SE3& T : rotated_guesses(T_world_host, angle)) guesses.push_back(T.inverse() * T_world_host);
    }
    Alignment alignment = aligner_.align_best(*references_[k].points, pyramid, guesses, {});
    if (believed(alignment, true)) {
      current_ = k;
      first_rmse_ = 0.0;
      return alignment;
    }
    if (alignment.inlier_share > best.inlier_share) best = alignment;
  }
  best.finished = false;
  return best;
}

bool FrameTracker::believed(const Alignment& a, bool was_lost) const {
  const AcceptOptions& accept = options_.accept;
  return a.finished && a.T_target_host.is_finite() &&
         a.inlier_share >= (was_lost ? accept.found_inliers : accept.min_inliers) &&
         a.coverage >= (was_lost ? accept.found_coverage : accept.min_coverage) && a.contrast >= accept.min_contrast &&
         a.contrast <= accept.max_contrast && a.correlation >= accept.min_correlation &&
         std::abs(a.brightness.a) <= options_.aligner.max_log_gain;
}

}  // namespace odosplat
