// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>

#include "odosplat/odometry/align/image_aligner.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/light/row_gain.hpp"

namespace odosplat {

/// A frame as it was taken, and with its rows exposed alike.
struct EvenFrame {
  std::shared_ptr<const FramePyramid> taken;
  std::shared_ptr<const FramePyramid> even;  // taken, divided by the gain; the same if that is empty
  RowGain row_gain;
};

EvenFrame make_even(std::shared_ptr<const FramePyramid> taken, const RowGain& row_gain = {});

/// Estimates the frame's row gain against the reference and aligns the frame, made even, again, until the gain stays or
/// twice. True if anything was changed. alignment: of frame.even with the reference, finished; a change that makes it
/// worth less is not taken.
bool even_rows(const ImageAligner& aligner, const TrackingReference& reference, EvenFrame& frame, Alignment& alignment);

}  // namespace odosplat
