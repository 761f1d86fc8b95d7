// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "sequence_flags.hpp"

#include "odosplat/core/error.hpp"

namespace odosplat::apps {

CLI::Option* add_sequence_flags(CLI::App* command, SequenceFlags& flags) {
  CLI::Option* sequence =
      command->add_option("SEQ", flags.path, "sequence: a folder in one of the known layouts, or a video")->required();
  add_layout_flags(command, flags);
  return sequence;
}

void add_layout_flags(CLI::App* command, SequenceFlags& flags) {
  command->add_option(
      "--layout", flags.options.layout,
      "tum, icl, redwood, sevenscenes, replica, colmap, nerfstudio, images or video (default: detected)");
  command->add_option("--camera", flags.options.camera_file, "camera.yaml to use instead of the sequence's own");
}

Sequence open_sequence(const SequenceFlags& flags) { return Sequence::open(flags.path, flags.options); }

std::vector<std::size_t> posed_frames(const Sequence& sequence, int every) {
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < sequence.size(); i += static_cast<std::size_t>(every)) {
    if (sequence.T_world_camera(i)) frames.push_back(i);
  }
  if (frames.empty()) throw InputError(sequence.name(), "no frame has a pose");
  return frames;
}

}  // namespace odosplat::apps
