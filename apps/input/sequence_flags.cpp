// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/sequence_flags.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <optional>

#include "apps/command/interrupt.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/progress.hpp"

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
  add_image_limit_flag(command, flags.options);
}

void add_image_limit_flag(CLI::App* command, SequenceOptions& options) {
  add_number(command, "--max-image-pixels", options.max_image_pixels, {.least = 1, .most = ImageLimit::most_pixels},
             "refuse images of more pixels than this before they are decoded");
}

Sequence open_sequence(const std::string& path, const SequenceOptions& options) {
  constexpr double shown_after = 2.0;  // [s]
  const Stopwatch watch;
  std::optional<Progress> progress;
  SequenceOptions watched = options;
  watched.progress = [&](double share) {
    if (interrupted()) throw Interrupted();
    if (!progress && watch.seconds() > shown_after) progress.emplace("read video", 100);
    if (progress) progress->update(std::lround(100.0 * share));
  };
  return Sequence::open(path, watched);
}

Sequence open_sequence(const SequenceFlags& flags) { return open_sequence(flags.path, flags.options); }

}  // namespace odosplat::apps
