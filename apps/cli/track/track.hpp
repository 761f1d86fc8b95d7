// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>

#include "apps/cli/track/track_job.hpp"
#include "odosplat/odometry/odometry.hpp"
#include "odosplat/odometry/relocalise/relocalizer.hpp"

namespace odosplat::apps {

/// Relocaliser for lost frames and for --start auto. Null if neither is requested, and for a depth sensor, which has no
/// places to look from (InputError if --start is auto). map must outlive it.
std::unique_ptr<Relocalizer> make_relocalizer(const TrackJob& job, const Camera& camera, MapView& map, bool sensor);

/// Options of the odometry for the job's method and flags.
OdometryOptions odometry_options(const TrackJob& job);

/// Tracks a sequence in a map and writes trajectory.txt, trajectory_live.txt, status.csv, covariance.csv and
/// report.json to the folder `out`. A frame whose files cannot be read is lost, with the reason in status.csv;
/// InputError if no frame can be read. The files are written every few seconds, and before an error is passed on, so
/// that a run that ends early leaves the results so far. After Ctrl-C the results so far are written and Interrupted is
/// thrown.
TrackOutcome track_sequence(const Common& common, const TrackJob& job);

}  // namespace odosplat::apps
