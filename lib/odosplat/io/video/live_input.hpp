// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "odosplat/io/video/ffmpeg_parts.hpp"
#include "odosplat/io/video/live_options.hpp"

namespace odosplat {

/// One connection to a live source: opens it and decodes its main video stream, with as little delay as its images
/// allow. Blocking calls end soon after `given_up` returns true, except the look-up of a host's name and the opening of
/// a device. Not thread safe.
class LiveInput {
 public:
  /// Opens the source. Throws InputError with the shown address and the reason.
  LiveInput(const std::string& source, const LiveOptions& options, std::function<bool()> given_up);
  ~LiveInput();
  LiveInput(const LiveInput&) = delete;
  LiveInput& operator=(const LiveInput&) = delete;

  /// Waits for the next image. False: the stream has ended or failed (fault()), or given_up() is true. Images that are
  /// decoded from damaged data are left out and counted.
  bool next();
  /// Why next() returned false; empty: the stream has ended in order, or was given up.
  const std::string& fault() const;
  long damaged() const;

  /// The image of the last next(), which may outlive this; null: too little memory.
  ffmpeg::Frame frame() const;
  /// Stamp [s] of that image; none if the stream has none.
  std::optional<double> stamp() const;
  int quarters() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace odosplat
