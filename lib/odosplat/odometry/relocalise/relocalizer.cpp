// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/relocalise/relocalizer.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/odometry/frame/least_size.hpp"

namespace odosplat {
namespace {

/// Guess of T_target_host by rotation alone, for an image whose pixel u shows what the view shows at u + shift.
SE3 turned_by_shift(const Camera& camera, const Eigen::Vector2d& shift) {
  return {so3_exp({shift.y() / camera.fy, -shift.x() / camera.fx, 0.0}), Eigen::Vector3d::Zero()};
}

/// Numbers of the best `most` elements, by falling value; equal ones in their order.
template <typename Value>
std::vector<std::size_t> best_of(std::size_t n, std::size_t most, const Value& value) {
  std::vector<std::size_t> order(n);
  for (std::size_t k = 0; k < n; ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return value(a) > value(b); });
  order.resize(std::min(n, most));
  return order;
}

/// Why the map does not confirm a pose; empty: it does.
std::string fault_of(const MapEvidence& evidence, double min_coverage, double min_score) {
  constexpr double much = 0.25;
  if (evidence.share < min_coverage) return formatted("the map covers %.0f %% of the view", 100.0 * evidence.share);
  if (evidence.verdict == Confirmation::none) return "too few parts of the view have texture";
  const bool confirmed = evidence.verdict == Confirmation::confirmed;
  if (!confirmed && evidence.against > much) {
    return formatted("%.0f %% of what the image shows is not in the map", 100.0 * evidence.against);
  }
  if (!confirmed || evidence.score < min_score) {
    return formatted("image and map correlate by only %.2f", evidence.score);
  }
  return "";
}

}  // namespace

void RelocalizerOptions::check() const {
  index.check();
  pose.check();
  confirmation.check();
  aligner.check();
  selector.check();
  reference.check();
  plane.check();
  require(smoothing >= 0.0 && smoothing <= 1.5, "relocalizer.smoothing", "0 to 1.5 px");
  require(min_spread >= 0.0, "relocalizer.min_spread", "at least 0");
  require(candidates >= 1, "relocalizer.candidates", "at least 1");
  require(finalists >= 1, "relocalizer.finalists", "at least 1");
  require(same_distance > 0.0 && same_angle > 0.0, "relocalizer.same_distance and same_angle", "positive");
  require(min_coverage >= 0.0 && min_coverage <= 1.0, "relocalizer.min_coverage", "in [0, 1]");
  require(min_score >= -1.0 && min_score <= 1.0, "relocalizer.min_score", "in [-1, 1]");
  require(ambiguity >= 0.0, "relocalizer.ambiguity", "at least 0");
  require(min_inliers >= 0.0 && min_inliers <= 1.0, "relocalizer.min_inliers", "in [0, 1]");
  require(max_position_sigma > 0.0, "relocalizer.max_position_sigma", "positive");
  require(covariance_factor > 0.0, "relocalizer.covariance_factor", "positive");
  require(disturbance >= 0.0, "relocalizer.disturbance", "at least 0");
  require(return_distance > 0.0, "relocalizer.return_distance", "positive");
}

Relocalizer::Relocalizer(const Camera& camera, MapView& map, std::vector<SE3> places, const RelocalizerOptions& options)
    : camera_(camera), map_(map), given_places_(std::move(places)), options_(options), aligner_(options.aligner) {
  camera_.check();
  check_least_size(camera_);
  options_.check();
  for (const SE3& place : given_places_) require(place.is_finite(), "places", "finite");
}

std::size_t Relocalizer::prepare() {
  if (!index_) index_.emplace(camera_, map_, given_places_, options_.index);
  return index_->places().size();
}

Relocalization Relocalizer::find(const GrayImage& image) { return look_up(image, std::nullopt); }

Relocalization Relocalizer::find(const GrayImage& image, const SE3& T_world_near) {
  return look_up(image, T_world_near);
}

bool Relocalizer::is_same(const SE3& T_a, const SE3& T_b) const {
  const SE3 T_a_b = T_a.inverse() * T_b;
  return T_a_b.translation().norm() < options_.same_distance && T_a_b.angle() < options_.same_angle;
}

Relocalization Relocalizer::look_up(const GrayImage& image, const std::optional<SE3>& T_world_near) {
  check_size(camera_, image);
  Relocalization result;
  cv::Scalar mean;
  cv::Scalar spread;
  cv::meanStdDev(image, mean, spread);
  if (!(spread[0] >= options_.min_spread)) {
    result.reason = "the image has almost no contrast";
    return result;
  }
  if (prepare() == 0) {
    result.reason = given_places_.empty() ? "no poses to render the map from are given"
                                          : "too little of the map is visible from the given poses";
    return result;
  }
  const GrayImage gray = resized_gray(image, index_->camera());
  const FramePyramid pyramid = build_frame_pyramid(index_->camera(), gray, options_.smoothing);
  std::vector<Candidate> candidates = propose(gray, T_world_near);
  align(candidates, pyramid);
  candidates = distinct(std::move(candidates), static_cast<std::size_t>(options_.finalists));
  for (Candidate& candidate : candidates) candidate = {candidate.T_world_camera(), {SE3()}, {}};
  align(candidates, pyramid);
  const std::size_t all =
      candidates.size();  // not as an argument beside the moved candidates: their order is unspecified
  candidates = distinct(std::move(candidates), all);

  std::vector<Finalist> finalists;
  finalists.reserve(candidates.size());
  for (const Candidate& candidate : candidates) finalists.push_back(verify(candidate, pyramid));
  const auto order = best_of(finalists.size(), finalists.size(), [&](std::size_t k) {
    return finalists[k].evidence.score + (finalists[k].fault.empty() ? 2.0 : 0.0);
  });
  if (order.empty()) {
    result.reason = "no place resembles the image";
    return result;
  }
  const Finalist& best = finalists[order.front()];
  result.score = best.evidence.score;
  result.probability = best.evidence.probability;
  result.inlier_share = best.candidate.alignment.inlier_share;
  result.reason = best.fault;
  for (std::size_t k = 1; k < order.size() && result.reason.empty(); ++k) {
    const Finalist& other = finalists[order[k]];
    if (other.evidence.verdict != Confirmation::confirmed) continue;
    if (is_same(other.candidate.T_world_camera(), best.candidate.T_world_camera())) continue;
    if (other.evidence.score > best.evidence.score - options_.ambiguity) result.reason = "two places look alike";
  }
  if (!result.reason.empty()) return result;
  result.found = true;
  result.T_world_camera = best.candidate.T_world_camera();
  result.covariance = best.covariance;
  result.brightness = best.candidate.alignment.brightness;
  return result;
}

std::vector<Relocalizer::Candidate> Relocalizer::propose(const GrayImage& gray,
                                                         const std::optional<SE3>& T_world_near) const {
  const std::vector<SE3>& places = index_->places();
  const std::vector<PlaceMatch> matches = index_->match(index_->signature(gray));
  const auto wanted = static_cast<std::size_t>(options_.candidates);
  std::vector<Candidate> candidates;
  const auto offer_place = [&](std::size_t k) {
    candidates.push_back({places[k], {turned_by_shift(index_->camera(), matches[k].shift), SE3()}, {}});
  };
  for (const std::size_t k : best_of(places.size(), wanted, [&](std::size_t i) { return matches[i].similarity; })) {
    offer_place(k);
  }
  if (T_world_near) {
    candidates.push_back({*T_world_near, {SE3()}, {}});
    const auto closeness = [&](std::size_t i) {
      const SE3 T_near_place = T_world_near->inverse() * places[i];
      return -T_near_place.translation().norm() - T_near_place.angle();
    };
    for (const std::size_t k : best_of(places.size(), wanted, closeness)) offer_place(k);
  }
  // Corners of a place and of its neighbours together: each alone may see too little of what the image shows.
  const auto by_corners = best_of(places.size(), wanted, [&](std::size_t i) { return matches[i].points.size(); });
  std::vector<std::optional<PerspectivePose>> poses(by_corners.size());
  parallel_for(static_cast<int>(by_corners.size()), 1, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      constexpr double near_distance = 0.5;  // [m]
      constexpr double near_angle = 0.5;     // [rad]
      const SE3& T_world_place = places[by_corners[static_cast<std::size_t>(c)]];
      std::vector<PointMatch> points;
      for (const PlaceMatch& match : matches) {
        const SE3 T_place_other = T_world_place.inverse() * places[match.place];
        if (T_place_other.translation().norm() > near_distance || T_place_other.angle() > near_angle) continue;
        points.insert(points.end(), match.points.begin(), match.points.end());
      }
      poses[static_cast<std::size_t>(c)] = perspective_pose(index_->camera(), points, options_.pose);
    }
  });
  for (const auto& pose : poses) {
    if (pose) candidates.push_back({pose->T_world_camera, {SE3()}, {}});
  }
  return candidates;
}

TrackingReference Relocalizer::reference_of(const FramePyramid& rendered, const ViewImages& view) const {
  PixelSelector selector(options_.selector);
  return build_reference(rendered, build_gradients(rendered), view, selector, options_.reference, options_.plane);
}

void Relocalizer::align(std::vector<Candidate>& candidates, const FramePyramid& image) {
  std::vector<ViewImages> views;
  views.reserve(candidates.size());
  for (const Candidate& candidate : candidates) {
    views.push_back(map_.render(index_->camera(), candidate.T_world_view, {true, false}));
  }
  parallel_for(static_cast<int>(candidates.size()), 1, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      const ViewImages& view = views[static_cast<std::size_t>(c)];
      Candidate& candidate = candidates[static_cast<std::size_t>(c)];
      if (view.color.empty()) continue;
      const FramePyramid rendered = build_frame_pyramid(index_->camera(), to_gray(view.color), options_.smoothing);
      const TrackingReference reference = reference_of(rendered, view);
      if (reference.empty()) continue;
      candidate.alignment = aligner_.align_best(reference, image, candidate.T_target_host, {});
    }
  });
}

std::vector<Relocalizer::Candidate> Relocalizer::distinct(std::vector<Candidate> candidates, std::size_t most) const {
  std::vector<Candidate> kept;
  for (const std::size_t k :
       best_of(candidates.size(), candidates.size(), [&](std::size_t i) { return worth(candidates[i].alignment); })) {
    if (kept.size() >= most || worth(candidates[k].alignment) < 0.0) break;
    const SE3 T_world_camera = candidates[k].T_world_camera();
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Candidate& other) {
      return is_same(other.T_world_camera(), T_world_camera);
    });
    if (is_new) kept.push_back(candidates[k]);
  }
  return kept;
}

Relocalizer::Finalist Relocalizer::verify(const Candidate& candidate, const FramePyramid& image) {
  Finalist finalist;
  finalist.candidate = candidate;
  const SE3 T_world_camera = candidate.T_world_camera();
  RenderedView view{T_world_camera, map_.render(index_->camera(), T_world_camera, {true, false})};
  view.gray = gray_of(index_->camera(), view.images, options_.smoothing);
  const ViewPatches patches(index_->camera(), view, options_.smoothing, options_.confirmation);
  finalist.evidence = patches.compare(image, T_world_camera);
  finalist.fault = fault_of(finalist.evidence, options_.min_coverage, options_.min_score);
  if (!finalist.fault.empty()) return finalist;
  if (candidate.alignment.inlier_share < options_.min_inliers) {
    finalist.fault = "too few points agree";
    return finalist;
  }
  const TrackingReference reference = reference_of(view.gray->pyramid, view.images);
  const Alignment alignment = aligner_.align(reference, image, SE3(), candidate.alignment.brightness, 1, 0);
  const Matrix6d covariance =
      options_.covariance_factor * (alignment.information + 1e-9 * Matrix6d::Identity()).inverse();
  const Eigen::Matrix3d position_covariance = covariance.topLeftCorner<3, 3>();
  const double variance = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(position_covariance).eigenvalues()[2];
  if (!alignment.finished || !(variance <= options_.max_position_sigma * options_.max_position_sigma)) {
    finalist.fault = "the pose is poorly determined";
    return finalist;
  }
  finalist.candidate = {T_world_camera, {}, alignment};
  // exp(xi) on the right of T_target_host is exp(-Ad xi) on the left of T_world_camera = T_world_host T_target_host^-1.
  const Matrix6d adjoint = T_world_camera.adjoint();
  finalist.covariance = adjoint * covariance * adjoint.transpose();
  for (const double sign : {-1.0, 1.0}) {
    const double d = sign * options_.disturbance;
    Vector6d away;
    away << d, d, d, 0.5 * d, -0.5 * d, 0.5 * d;
    const Alignment back =
        aligner_.align(reference, image, SE3::exp(away), candidate.alignment.brightness, image.levels() - 1, 0);
    const SE3 difference = back.T_target_host.inverse() * alignment.T_target_host;
    if (!back.finished || !(difference.translation().norm() <= options_.return_distance)) {
      finalist.fault = "alignment from a slightly different start ends at another pose";
      return finalist;
    }
  }
  return finalist;
}

}  // namespace odosplat
