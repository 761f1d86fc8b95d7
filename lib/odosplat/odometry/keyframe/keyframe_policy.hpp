// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/odometry/align/image_aligner.hpp"
#include "odosplat/odometry/frame/tracking_reference.hpp"

namespace odosplat {

struct KeyframePolicyOptions {
  double translation_flow = 0.04;  // root mean square flow without rotation that gives a score of 1, per (width +
                                   // height) px
  double full_flow = 0.08;         // the same of the whole flow
  double log_gain = 0.5;           // |a| of the relative brightness that gives a score of 1
  double rmse_growth = 2.0;        // residual over that of the first frame after the keyframe from which on a keyframe
                                   // is due at once
  double min_coverage = 0.6;       // share of the reference in view below which a keyframe is due at once

  void check() const;
};

/// What the decision is made of; a keyframe is due at score > 1.
struct KeyframeScore {
  double translation_flow = 0.0;  // [px] root mean square over points, rotation taken out
  double full_flow = 0.0;         // [px]
  double score = 0.0;
};

/// Source: DSO, section 3.1: weighted sum of flow, of rotation-free flow (occlusions come with it) and of brightness
/// change. DSO's weights are for 640x480; here flow is counted in shares of width + height, which is the same there.
KeyframeScore keyframe_score(const TrackingReference& reference, const Alignment& alignment, double first_rmse,
                             const KeyframePolicyOptions& options);

}  // namespace odosplat
