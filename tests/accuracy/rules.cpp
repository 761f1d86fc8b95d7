// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/accuracy/rules.hpp"

namespace odosplat::accuracy {
namespace {
constexpr double never = 1e6;  // a threshold that no value reaches

void switch_off(ResidualWeightOptions& options) {
  options.noise = never;
  options.outlier = never;
}
}  // namespace

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all{
      {"clipped pixels", [](OdometryOptions&) {}, 0.98},
      {"bare references", [](OdometryOptions& o) { o.keyframe.reference.bare_share = 0.0; }},
      {"bare anchor tie",
       [](OdometryOptions& o) {
         o.keyframe.anchor.bare_translation = never;
         o.keyframe.anchor.bare_rotation = never;
       }},
      {"row gain", [](OdometryOptions& o) { o.aligner.row_gain.enabled = false; }},
      {"tone curve", [](OdometryOptions& o) { o.keyframe.anchor.tone.enabled = false; }},
      {"blur", [](OdometryOptions& o) { o.keyframe.anchor.blur.enabled = false; }},
      {"anchor weights", [](OdometryOptions& o) { switch_off(o.keyframe.anchor.agreement); }},
      {"depth weights", [](OdometryOptions& o) { switch_off(o.keyframe.anchor.depth_agreement); }},
      {"anchor gradient",
       [](OdometryOptions& o) { o.keyframe.anchor.gradient_weight = o.keyframe.window_points.gradient_weight; }},
      {"anchor again",
       [](OdometryOptions& o) {
         o.keyframe.anchor.render_again_flow = never;
         o.keyframe.anchor.reset_flow = never;
       }},
      {"anchor reset", [](OdometryOptions& o) { o.keyframe.anchor.reset_flow = never; }},
      {"map border", [](OdometryOptions& o) { o.keyframe.border = 0.0; }},
      {"smoothing", [](OdometryOptions& o) { o.keyframe.smoothing = 0.0; }},
      {"motion prior",
       [](OdometryOptions& o) {
         o.accept.motion_translation = never;
         o.accept.motion_rotation = never;
       }},
      {"more guesses",
       [](OdometryOptions& o) {
         o.accept.retrack = never;
         o.accept.retrack_outliers = never;
       }},
      {"doubtful frames", [](OdometryOptions& o) { o.accept.sure_correlation = o.accept.min_correlation; }},
      {"contrast",
       [](OdometryOptions& o) {
         o.accept.min_contrast = 0.0;
         o.accept.max_contrast = never;
       }},
      {"stricter when lost",
       [](OdometryOptions& o) {
         o.accept.found_inliers = o.accept.min_inliers;
         o.accept.found_coverage = o.accept.min_coverage;
       }},
      {"keyframe by residual", [](OdometryOptions& o) { o.policy.rmse_growth = never; }},
      {"keyframe by gain", [](OdometryOptions& o) { o.policy.log_gain = never; }},
      {"window pose prior",
       [](OdometryOptions& o) {
         o.optimizer.tracked_translation = never;
         o.optimizer.tracked_rotation = never;
       }},
      {"marginal prior", [](OdometryOptions& o) { o.marginalization.enabled = false; }},
      {"memory", [](OdometryOptions& o) { o.memory.enabled = false; }},
      {"drift",
       [](OdometryOptions& o) {
         o.drift.translation = 0.0;
         o.drift.rotation = 0.0;
       }},
      {"confirmation", [](OdometryOptions& o) { o.confirmation.enabled = false; }},
      {"camera misfit",
       [](OdometryOptions& o) {
         o.misfit.focal_prior = 1.0 / never;
         o.misfit.center_prior = 1.0 / never;
         o.misfit.radial_prior = 1.0 / never;
         o.misfit.readout_prior = 1.0 / never;
       }},
      {"all of the anchor", [](OdometryOptions& o) { o.keyframe.anchor.enabled = false; }},
  };
  return all;
}

}  // namespace odosplat::accuracy
