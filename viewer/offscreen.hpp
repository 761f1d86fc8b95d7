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
  bool cull_back = false;  // leave out triangles seen from their back: one looks through a room's near walls
};

/// VTK drawing into memory, with no X server: an OpenGL context of EGL's and VTK's generic render window on it.
/// Make one, draw with it, drop it; any number in turn, in any thread, but one at a time: VTK shares what it caches.
/// Silent on standard error. Throws std::runtime_error where the machine has no OpenGL at all.
class OffscreenWindow {
 public:
  OffscreenWindow();
  ~OffscreenWindow();
  OffscreenWindow(const OffscreenWindow&) = delete;
  OffscreenWindow& operator=(const OffscreenWindow&) = delete;

  /// The picture of view.size that the view has of the layers, each drawn over the one before it whatever their
  /// depths. Smoothed by 2 x 2 samples a pixel. Drawn in tiles, so that memory does not grow with the size. The same
  /// call gives the same bits. Blocks. Call it in the thread that made the window.
  cv::Mat3b render(const std::vector<FigureLayer>& layers, const FigureView& view, const Rgb& background);

  /// Who draws, for logs: the way to OpenGL and the name of its renderer.
  std::string renderer() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace odosplat
