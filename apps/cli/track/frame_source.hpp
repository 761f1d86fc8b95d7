// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/map/sensor_view.hpp"

namespace odosplat::apps {

/// An image to be tracked.
struct InputFrame {
  std::size_t number = 0;            // in the sequence or stream, counted from 0
  double time = 0.0;                 // [s]
  std::string stamp;                 // the time as text
  GrayImage image;                   // of the source's camera; empty: it cannot be read
  std::string fault;                 // why it cannot be read
  std::shared_ptr<SensorView> view;  // rendered in place of the map; null: the map
  std::size_t dropped = 0;           // frames between the one before and this that were dropped
  std::optional<std::chrono::steady_clock::time_point> arrival;  // of live sources
};

/// The images of a run, one after another: of a recorded sequence or of a live source.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// For messages.
  virtual const std::string& name() const = 0;
  virtual const Camera& camera() const = 0;
  /// Number of frames; none: not known.
  virtual std::optional<std::size_t> size() const = 0;
  /// To be called once, before the first next(), when tracking is ready.
  virtual void start() {}
  /// Waits for the next frame. Nothing: no frame follows, or `stopped` returned true; it is asked every 50 ms or more
  /// often while waiting, and before each frame. InputError: the source has become useless.
  virtual std::optional<InputFrame> next(const std::function<bool()>& stopped) = 0;
  /// For the top level of report.json; null: nothing.
  virtual nlohmann::ordered_json facts() const { return nullptr; }
};

}  // namespace odosplat::apps
