// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <limits>
#include <vector>

namespace odosplat {

/// Detects that training has collapsed: the mean PSNR of the steps since the last judgement is more than fall_db below
/// the best such mean before, `patience` times in a row, since Gaussians added by densification take a while to fit; at
/// the end of training once is enough. From one image level to the next the images differ, so that twice the fall is
/// allowed there; the best starts anew at each level. A mean of fewer than least_steps is not judged, one that is not
/// finite counts as a collapse at once. Not thread safe.
class TrainingGuard {
 public:
  static constexpr int interval = 100;    // [steps] between judgements
  static constexpr int least_steps = 20;  // that a judgement needs
  static constexpr int patience = 4;      // judgements
  static constexpr double fall_db = 3.0;  // [dB]

  enum class Verdict {
    nothing,  // too few steps, or neither of the others
    best,     // better than ever before (at this level): the state to go back to
    fallen
  };

  /// The PSNR [dB] that a step found, iteration 1 for the first.
  void add(int iteration, int level, double psnr_db);
  /// Steps up to `iteration` are not counted: training needs time to recover from an intended change (an opacity
  /// reset).
  void pause(int iteration);
  Verdict judge(bool at_end = false);
  /// The mean that the last judgement was about, and the best so far [dB].
  double last_db() const { return last_db_; }
  double best_db() const { return best_db_; }
  /// After the state of the best was restored: the steps since are forgotten.
  void went_back() { steps_ = falls_ = 0; }

  /// All of it for a checkpoint. set_state throws InputError for what is no such state.
  std::vector<double> state() const;
  void set_state(const std::vector<double>& state);

 private:
  int level_ = 0;
  int steps_ = 0;
  int falls_ = 0;  // judgements in a row that were below the limit
  double sum_db_ = 0.0;
  int best_level_ = -1;  // none yet
  double best_db_ = 0.0;
  double last_db_ = 0.0;
  int paused_until_ = 0;
};

}  // namespace odosplat
