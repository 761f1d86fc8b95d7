// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "viewer/color_map.hpp"
#include "viewer/figure_mesh.hpp"
#include "viewer/figure_view.hpp"

namespace odosplat {

/// One depth-tested layer of a picture.
struct FigureLayer {
  FigureMesh mesh;
  bool cull_back = false;  // leave out triangles seen from behind, so that a room's near walls do not hide its inside
};

/// Draws with VTK into memory, without an X server: an EGL context with VTK's generic render window on it. Windows may
/// be created and destroyed one after another, in any thread, but only one may exist at a time, because VTK's caches
/// are shared. Prints nothing on standard error. Throws std::runtime_error if the machine has no OpenGL.
class OffscreenWindow {
 public:
  OffscreenWindow();
  ~OffscreenWindow();
  OffscreenWindow(const OffscreenWindow&) = delete;
  OffscreenWindow& operator=(const OffscreenWindow&) = delete;

  /// Renders the layers, each drawn over the previous ones whatever their depths, into a picture of view.size. Smoothed
  /// by 2 x 2 samples per pixel. Drawn in tiles, so that memory does not grow with the size. The same call gives the
  /// same bits. Blocks. To be called in the thread that created the window.
  cv::Mat3b render(const std::vector<FigureLayer>& layers, const FigureView& view, const Rgb& background);

  /// Platform and name of the renderer, for logs.
  std::string renderer() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace odosplat
