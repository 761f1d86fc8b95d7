// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <cstdio>
#include <memory>

#include "odosplat/core/error.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/cloud_file.hpp"
#include "odosplat/io/sequence.hpp"
#include "odosplat/map/cloud_builder.hpp"
#include "sequence_flags.hpp"
#include "support.hpp"

namespace odosplat::apps {
namespace {

struct CloudFlags {
  SequenceFlags sequence;
  std::string out;
  int every = 10;
  CloudOptions cloud;
};

void run(const CloudFlags& flags) {
  const Sequence sequence = open_sequence(flags.sequence);
  const std::vector<std::size_t> frames = posed_frames(sequence, flags.every);
  CloudBuilder builder(flags.cloud);
  Progress progress("cloud", static_cast<long>(frames.size()));
  long done = 0;
  for (const std::size_t i : frames) {
    if (interrupted()) throw Interrupted();
    if (sequence.has_depth(i) && sequence.T_world_depth(i)) {
      builder.add(sequence.depth(i), sequence.color(i), sequence.camera(), *sequence.T_world_depth(i));
    }
    progress.update(++done, std::to_string(builder.voxels()) + " points");
  }
  progress.finish();
  const PointCloud cloud = builder.finish();
  if (cloud.size() == 0) throw InputError(flags.sequence.path, "no frame has both a pose and depth");
  write_point_cloud(flags.out, cloud);
  std::printf("%s: %zu points from %zu frames\n", flags.out.c_str(), cloud.size(), frames.size());
}

}  // namespace

void add_cloud(CLI::App& app, Common& common) {
  CLI::App* command = add_command(app, common, "cloud", "make a point cloud from a sequence's depth and true poses");
  auto flags = std::make_shared<CloudFlags>();
  add_sequence_flags(command, flags->sequence);
  command->add_option("--out", flags->out, "cloud to write (PLY)")->required();
  command->add_option("--every", flags->every, "use every Nth frame")->check(CLI::PositiveNumber);
  command->add_option("--voxel", flags->cloud.voxel, "edge of the voxels that keep one point each [m]");
  command->add_option("--noise", flags->cloud.noise, "standard deviation of simulated range noise [m]");
  command->add_option("--seed", flags->cloud.seed, "seed of the noise");
  command->final_callback([flags] { run(*flags); });
}

}  // namespace odosplat::apps
