// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "apps/cli/track/track.hpp"
#include "apps/input/map_views.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "odosplat/odometry/odometry.hpp"
#include "odosplat/odometry/relocalise/relocalizer.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace odosplat::accuracy {

/// Input of every scenario: a sequence with true poses, a map, and how they are read.
struct Job {
  apps::TrackJob track;  // sequence, method, map, anchor, seed
  std::string frames;    // "A:B", range of the sequence; empty: all
  std::string json;      // output file for the rows; empty: none
  std::string trace;     // output file (CSV) for every frame of every run; empty: none
};

/// Declares the flags of Job on a scenario's command.
void add_job_flags(CLI::App* command, Job& job);

/// The selected frames of a sequence with true poses. Frames are counted from the first of them.
class World {
 public:
  /// InputError if a frame has no true pose, or if there are fewer than two frames.
  explicit World(const Job& job);

  std::size_t size() const { return size_; }
  const Camera& camera() const { return sequence_.camera(); }
  const std::string& name() const { return sequence_.name(); }
  double fps() const { return sequence_.fps(); }
  double time(std::size_t i) const { return sequence_.time(begin_ + i); }
  GrayImage gray(std::size_t i) const { return sequence_.gray(begin_ + i); }
  DepthImage depth(std::size_t i) const {
    return sequence_.has_depth(begin_ + i) ? sequence_.depth(begin_ + i) : DepthImage();
  }
  SE3 T_world_camera(std::size_t i) const { return *sequence_.T_world_camera(begin_ + i); }
  /// The frame's number in the sequence.
  std::size_t number(std::size_t i) const { return begin_ + i; }

 private:
  Sequence sequence_;
  std::size_t begin_ = 0;
  std::size_t size_ = 0;
};

/// The odometry under test and its relocaliser (null for a sensor, which has no places).
struct Localiser {
  std::unique_ptr<Relocalizer> relocalizer;
  std::unique_ptr<Odometry> odometry;
};

/// Changes the options that a job specifies; empty: no change.
using OptionEdit = std::function<void(OdometryOptions&)>;

/// The only function of these tests that creates it. map must outlive it; sensor: map shows the depth images of a
/// sensor.
Localiser make_localiser(const Camera& camera, MapView& map, bool sensor, const apps::TrackJob& job,
                         const SE3& T_world_camera_start, const OptionEdit& edit = {});

}  // namespace odosplat::accuracy
