// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/synth/motion/path.hpp"
#include "odosplat/synth/motion/tremor.hpp"

namespace odosplat {

struct WalkOptions {
  double fps = 30.0;          // [1/s] > 0
  int frames = 240;           // >= 2
  double length_m = 3.0;      // [m] > 0, summed from frame to frame, tremor included
  bool loop = false;          // true: the waypoints form a loop, which is repeated until length_m is reached
  double turn_m = 0.5;        // [m] > 0: turning by a radian takes as long as walking this distance
  double tremor_m = 0.002;    // [m] standard deviation of each coordinate of the eye's tremor, 0..0.05
  double tremor_deg = 0.25;   // [deg] the same for rotation, 0..5
  double max_speed = 1.5;     // [m/s] > 0
  double max_turn_deg = 3.0;  // [deg per frame] > 0
  std::uint64_t seed = 1;     // of the tremor

  /// Throws InputError naming the field.
  void check() const;
};

/// A hand-held walk of a given length in a given time, with a pose at any time: tremor and spline as in hand_held_path.
/// The speed is constant in metres plus turn_m times radians, so that the walk is slower in turns, except for
/// acceleration at the start and deceleration at the end. length_m determines how far along the waypoints the walk
/// goes. Throws InputError if the waypoints of an open walk end before length_m is reached, if the path of the tremor
/// alone is longer than length_m, or if speed or turn between frames exceed their limits. Immutable; any number of
/// threads may use it.
class Walk {
 public:
  Walk(const std::vector<Waypoint>& waypoints, const WalkOptions& options);

  /// T_world_camera at a time [s]; before 0 and after the last frame only the tremor moves the camera.
  SE3 pose_at(double time) const;
  /// Poses of all frames, at k / fps.
  Trajectory trajectory() const;
  /// Share of the waypoints' path that is covered; above 1 for a loop that is walked more than once.
  double laps() const { return reach_ / total_; }

 private:
  SE3 pose_at(double time, double reach) const;
  double travelled(double reach) const;

  WalkOptions options_;
  PathSpline spline_;
  std::vector<Tremor> tremor_;
  // Distances in metres plus turn_m times radians:
  std::vector<double> pace_;  // from the start, at equal steps of the spline's parameter
  double total_ = 0.0;        // over all waypoints
  double reach_ = 0.0;        // that the walk covers
};

/// Sum of the distances [m] between the poses' positions.
double travelled_length(const Trajectory& path);

}  // namespace odosplat
