// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>

#include "apps/input/sequence_flags.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "viewer/figures/trajectory_figure.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace odosplat::apps {

/// --truth and the flags that say how to read it.
struct TruthFlags {
  SequenceFlags sequence;  // its path may be a file of poses
  std::string times;
  std::string frames;
};

/// Declares --truth (returned), --truth-times, --layout, --camera and --frames.
CLI::Option* add_truth_flags(CLI::App* command, TruthFlags& flags);

/// An estimated and a true trajectory whose stamps can be compared.
struct JudgedTrajectory {
  Trajectory estimate;
  Trajectory truth;              // empty without --truth
  std::optional<TimeSpan> span;  // of the images that were to be posed; none: not known
};

/// Reads EST and the truth: a file of poses, or a sequence in any layout, whose poses are those that `track` answers
/// with (reflected where fy is negative), every one that the data set gives, of the images in --frames if that is
/// given. The span is that of the sequence's images, and of status.csv beside EST, which `track` writes for the images
/// that it was given. InputError if the sequence has no poses there, if --frames comes without a sequence, or as
/// require_comparable_stamps says.
JudgedTrajectory read_judged(const std::string& estimate, const std::string& estimate_times, const TruthFlags& truth);

}  // namespace odosplat::apps
