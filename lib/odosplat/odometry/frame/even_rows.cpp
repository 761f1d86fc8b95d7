// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/frame/even_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace odosplat {
namespace {

/// Root mean square.
double difference(const RowGain& a, const RowGain& b) {
  const std::size_t rows = std::max(a.size(), b.size());
  double squares = 0.0;
  for (std::size_t v = 0; v < rows; ++v) {
    const double d = (a.empty() ? 1.0F : a[v]) - (b.empty() ? 1.0F : b[v]);
    squares += d * d;
  }
  return rows == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(rows));
}

}  // namespace

EvenFrame make_even(const std::shared_ptr<const FramePyramid>& taken, const RowGain& row_gain) {
  EvenFrame frame{taken, taken, row_gain};
  if (!row_gain.empty()) frame.even = std::make_shared<FramePyramid>(divide_rows(*taken, row_gain));
  return frame;
}

bool even_rows(const ImageAligner& aligner, const TrackingReference& reference, EvenFrame& frame,
               Alignment& alignment) {
  constexpr int passes = 2;
  const RowGainOptions& options = aligner.options().row_gain;
  if (!options.enabled) return false;
  bool changed = false;
  for (int pass = 0; pass < passes; ++pass) {
    const RowGain gain =
        estimate_row_gain(reference, *frame.taken, alignment.T_target_host, alignment.brightness, options);
    if (difference(gain, frame.row_gain) <= options.same) break;
    EvenFrame next = make_even(frame.taken, gain);
    const Alignment again = aligner.align(reference, *next.even, alignment.T_target_host, alignment.brightness, 1, 0);
    if (!(worth(again) > worth(alignment))) break;
    frame = std::move(next);
    alignment = again;
    changed = true;
  }
  return changed;
}

}  // namespace odosplat
