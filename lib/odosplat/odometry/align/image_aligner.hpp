// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <span>

#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/frame/tracking_reference.hpp"
#include "odosplat/odometry/light/row_gain.hpp"
#include "odosplat/odometry/residual_noise.hpp"

namespace odosplat {

struct ImageAlignerOptions {
  double huber = residual_huber;  // [grey] residuals beyond weigh less
  double cutoff = 20.0 / 255;     // [grey] residuals beyond count as outliers
  int max_iterations = 30;        // per level
  double converged = 0.02;        // [px] predicted image motion of a step below which a level is done
  double min_coverage = 0.2;      // share of points that must stay in view
  double max_log_gain = 1.2;      // |a| of the relative brightness, natural log
  double gain_sigma = 0.5;        // weak prior on a, relative to its guess
  double offset_sigma = 0.5;      // [grey] weak prior on b
  double noise = residual_noise;  // [grey] of one residual, for covariance and priors
  double bare_noise = 2.0 / 255;  // [grey] the same for a bare reference, whose residuals are little but noise
  RowGainOptions row_gain;

  void check() const;
};

/// Where a frame was found. T_target_host: p_target = T * p_host. brightness: I_target = e^a I_host + b.
struct Alignment {
  SE3 T_target_host;
  Brightness brightness;
  double rmse = 0.0;          // [grey] of the inliers on the finest level
  double inlier_share = 0.0;  // of the points in view
  double coverage = 0.0;      // share of all points that are in view
  double contrast = 0.0;      // spread of the frame's values at the points over what the host's values predict
  double correlation = 0.0;   // -1..1, of the frame's values at the points in view with the host's, outliers included
  /// Of exp(xi) applied on the right of T_target_host, xi = (translation, rotation).
  Matrix6d information = Matrix6d::Zero();
  bool finished = false;  // false: too few points in view, or not finite
};

/// What is known of a pose before its image is compared: where it probably is, and how surely.
struct PosePrior {
  SE3 T_target_host;
  /// Of exp(xi) applied on the right of T_target_host, xi = (translation [m], rotation [rad]).
  Matrix6d information = Matrix6d::Zero();
};

/// Prior of independent errors of translation [m] and rotation [rad], the same along all axes.
PosePrior pose_prior(const SE3& T_target_host, double sigma_translation, double sigma_rotation);

/// Measure to compare alignments of the same frame: inliers over all points of the level, which rewards agreement and
/// staying in view, less their residual; -1 where it did not finish.
double worth(const Alignment& alignment);

/// Coarse-to-fine direct alignment: minimises sum w huber(I_target(pi(T p)) - e^a I_host(p) - b) over T, a, b.
/// Source: DSO's coarse tracker (residual, Huber, cut-off); template Jacobians of Baker and Matthews 2004 instead of
/// gradients in the target, so that a frame needs nothing but its grey pyramid. Levenberg-Marquardt.
/// Deterministic (one thread). Const: may be shared.
class ImageAligner {
 public:
  explicit ImageAligner(const ImageAlignerOptions& options);

  /// Levels from `coarsest` down to `finest` (clamped to those that both sides have) from the guess. prior: null, or a
  /// prior for motions that the image does not determine, as in front of a bare wall.
  Alignment align(const TrackingReference& reference, const FramePyramid& target, const SE3& T_target_host_guess,
                  const Brightness& brightness_guess, int coarsest, int finest, const PosePrior* prior = nullptr) const;

  /// The best of several guesses: each is aligned on the coarsest level alone; the best three go on to level 0.
  /// guesses must not be empty.
  Alignment align_best(const TrackingReference& reference, const FramePyramid& target, std::span<const SE3> guesses,
                       const Brightness& brightness_guess) const;

  const ImageAlignerOptions& options() const { return options_; }

 private:
  ImageAlignerOptions options_;
};

}  // namespace odosplat
