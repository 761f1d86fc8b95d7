// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/sequence_cloud.hpp"

#include "apps/command/interrupt.hpp"
#include "apps/input/unreadable_frames.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/progress.hpp"

namespace odosplat::apps {
namespace {

void add_frames(const Sequence& sequence, int every, const FrameRange& range, CloudBuilder& builder) {
  const std::vector<std::size_t> frames = posed_frames(sequence, every, range);
  Progress progress("cloud " + sequence.name(), static_cast<long>(frames.size()));
  long done = 0;
  UnreadableFrames unreadable;
  for (const std::size_t i : frames) {
    if (interrupted()) throw Interrupted();
    if (sequence.has_depth(i) && sequence.T_world_depth(i)) {
      DepthImage depth;
      ColorImage color;
      try {
        depth = sequence.depth(i);
        color = sequence.color(i);
      } catch (const InputError& e) {
        unreadable.add(e.what());
        depth.release();
      }
      if (!depth.empty()) builder.add(depth, color, sequence.camera(), *sequence.T_world_depth(i));
    }
    progress.update(++done, std::to_string(builder.voxels()) + " points");
  }
  progress.finish();
  unreadable.report(frames.size());
}

}  // namespace

PointCloud cloud_of_sequences(const std::vector<Sequence>& sequences, const CloudOptions& options, int every,
                              const FrameRange& range) {
  CloudBuilder builder(options);
  for (const Sequence& sequence : sequences) add_frames(sequence, every, range, builder);
  PointCloud cloud = builder.finish();
  if (cloud.size() == 0) throw InputError(sequences.at(0).name(), "no frame has both a pose and depth");
  return cloud;
}

}  // namespace odosplat::apps
