// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/accuracy/world.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/command/number_flags.hpp"
#include "apps/input/places.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat::accuracy {

void add_job_flags(CLI::App* command, Job& job) {
  apps::add_sequence_flags(command, job.track.sequence);
  apps::add_map_flags(command, job.track.map);
  command->add_option("--method", job.track.method, "as odosplat track knows it");
  command->add_option("--anchor", job.track.anchor, "on or off (default: as the method has it)");
  command->add_option("--places", job.track.places, apps::places_help);
  command->add_flag("!--no-relocalise", job.track.relocalise, "lost frames are not looked up in the map");
  apps::add_number(command, "--seed", job.track.seed, {}, "seed of the pixel selector and of every disturbance");
  command->add_option("--frames", job.frames, apps::frames_help);
  command->add_option("--json", job.json, "the rows of the table, to this file");
  command->add_option("--trace", job.trace, "every frame of every run with its error, to this file (CSV)");
}

World::World(const Job& job) : sequence_(apps::open_sequence(job.track.sequence)) {
  const apps::FrameRange range = job.frames.empty() ? apps::FrameRange() : apps::parse_frames(job.frames);
  begin_ = range.begin;
  const std::size_t end = std::min(range.end, sequence_.size());
  if (end < begin_ + 2) throw InputError(sequence_.name(), "has fewer than two frames in question");
  size_ = end - begin_;
  for (std::size_t i = 0; i < size_; ++i) {
    if (!sequence_.T_world_camera(begin_ + i)) {
      throw InputError(sequence_.name(), "frame " + std::to_string(begin_ + i), "has no true pose to be judged by");
    }
  }
}

Localiser make_localiser(const Camera& camera, MapView& map, bool sensor, const apps::TrackJob& job,
                         const SE3& T_world_camera_start, const OptionEdit& edit) {
  Localiser made;
  OdometryOptions options = apps::odometry_options(job);
  if (edit) edit(options);
  made.odometry = std::make_unique<Odometry>(camera, map, options, T_world_camera_start);
  made.relocalizer = apps::make_relocalizer(job, camera, map, sensor);
  made.odometry->set_relocalizer(made.relocalizer.get());
  return made;
}

}  // namespace odosplat::accuracy
