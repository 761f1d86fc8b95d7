// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>

#include "odosplat/odometry/align/image_aligner.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/light/row_gain.hpp"

namespace odosplat {

/// A frame as it was taken, and with the different gains of its rows removed.
struct EvenFrame {
  std::shared_ptr<const FramePyramid> taken;
  std::shared_ptr<const FramePyramid> even;  // taken, divided by the gain; the same if that is empty
  RowGain row_gain;
};

EvenFrame make_even(const std::shared_ptr<const FramePyramid>& taken, const RowGain& row_gain = {});

/// Estimates the frame's row gain against the reference, divides the rows by it and aligns the frame again; repeated at
/// most once, while the gain still changes. True if anything was changed. alignment: of frame.even with the reference,
/// finished; a change that does not raise its worth() is discarded.
bool even_rows(const ImageAligner& aligner, const TrackingReference& reference, EvenFrame& frame, Alignment& alignment);

}  // namespace odosplat
