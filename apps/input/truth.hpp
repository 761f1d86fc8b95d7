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
  SequenceFlags sequence;  // the path may also be a file of poses
  std::string times;
  std::string frames;
};

/// Declares --truth (returned), --truth-times, --layout, --camera and --frames.
CLI::Option* add_truth_flags(CLI::App* command, TruthFlags& flags);

/// An estimated and a true trajectory with comparable time stamps.
struct JudgedTrajectory {
  Trajectory estimate;
  Trajectory truth;              // empty without --truth
  std::optional<TimeSpan> span;  // of the images that should have poses; none: unknown
};

/// Reads EST and the truth. The truth is a file of poses, or a sequence in any layout. The poses of a sequence are in
/// the convention in which `track` writes its poses (reflected where fy is negative) and by the images' stamps
/// (Sequence::truth); all of these are used, or those in the time range of the images of --frames if that is given.
/// The span is the intersection of the span of the sequence's images and that in status.csv beside EST, which `track`
/// writes; one of them if the other is unknown. InputError if the sequence has no poses there, if --frames is given
/// without a sequence, or for time stamps that require_comparable_stamps refuses.
JudgedTrajectory read_judged(const std::string& estimate, const std::string& estimate_times, const TruthFlags& truth);

/// The true trajectory alone, read in the same way; empty without --truth.
Trajectory read_true_poses(const TruthFlags& truth);

}  // namespace odosplat::apps
