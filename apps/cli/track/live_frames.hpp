// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>

#include "apps/cli/track/frame_source.hpp"
#include "apps/cli/track/track_job.hpp"
#include "odosplat/io/camera/image_correction.hpp"
#include "odosplat/io/video/live_source.hpp"

namespace odosplat::apps {

/// The images of a live source, corrected by its camera file.
class LiveFrames : public FrameSource {
 public:
  /// Opens the source of the job and waits for its first image. InputError: no camera file is given or the images have
  /// another size, and as LiveSource. Interrupted after Ctrl-C.
  explicit LiveFrames(const TrackJob& job);

  const std::string& name() const override { return source_.name(); }
  const Camera& camera() const override { return camera_.camera; }
  std::optional<std::size_t> size() const override { return std::nullopt; }
  void start() override { source_.start(); }
  std::optional<InputFrame> next(const std::function<bool()>& stopped) override;

  nlohmann::ordered_json facts() const override;

 private:
  const CameraFile camera_;
  const ImageCorrection correction_;
  LiveSource source_;
};

/// Refuses flags of `track` that a live source has no use for, and those for live sources alone if the job has none.
/// InputError names the flag.
void check_live_flags(const TrackJob& job);

}  // namespace odosplat::apps
