// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/eval/convention_report.hpp"

namespace odosplat {

/// Posed depth images with what their files say about them.
struct ConventionInput {
  Camera camera;             // fy > 0; its sign as declared is fy_sign
  int fy_sign = 1;           // +1 or -1
  double depth_scale = 1.0;  // units a metre as declared
  // One a depth image, at the depth's own time, as the files have them: neither inverted nor reflected. None: the files
  // have no pose for it.
  std::vector<std::optional<SE3>> T_world_camera;
  // Depth of an image [m] by the declared depth_scale, 0 = none; called from one thread; of the images two at a
  // time are kept.
  std::function<DepthImage(std::size_t)> depth;
};

struct ConventionOptions {
  int gap = 20;              // [frames] between the two images of a pair; others for short sequences, see below
  int pairs = 32;            // pairs of images, spread evenly
  int samples = 2000;        // pixels looked at a pair, on a regular grid
  double min_overlap = 0.2;  // share of them that must land on depth in the other image
  double max_error = 0.05;   // largest relative error of a convention that is believed
  // Tried beside the declared scale: millimetres; TUM and ICL-NUIM; Replica as rendered for iMAP; tenths of a
  // millimetre; KITTI.
  std::vector<double> depth_scales = {1000.0, 5000.0, 6553.5, 10000.0, 256.0};

  void check() const;
};

/// Finds out from the data how fy, poses, numbering and depth scale are meant, by reprojection: pixels of image i are
/// lifted with their depth, moved by the poses into image i + gap, and the depth found there (nearest pixel) is
/// compared with their own. 2 signs of fy x poses as stored or inverted x 3 shifts x depth scales are tried. Reflected
/// poses, F T F with F = diag(1, -1, 1), need no rows of their own: with fy > 0 they are the stored poses with fy < 0.
/// Rows are judged by the error relative to depth: a scale that makes everything small would win in metres.
///
/// A row beats another as beats() says. Among the rows that the best row does not beat, the one most like the declared
/// convention is the winner: where the data do not decide, nothing is called wrong. A part of the winner is called
/// decided if the winner beats every row that differs from it in this part and in at most one other; three mistakes at
/// once that fit by chance are not considered. A row that could not be tried, because the poses it needs are not there,
/// is not beaten.
///
/// A sequence shorter than twice the gap is used in pairs of every gap from a third of its length up, so that few
/// images say as much as they can. Pairs that can be tried under every shift are preferred. Gaps are halved while no
/// row is believable and less than half of the pixels overlap as declared: where a camera moves so fast, wrong rows
/// overlap as well as the right one and none fits. The report is of the gap at which most overlaps if none fits at any.
/// Throws InputError if there are fewer than two images with pose, if sizes of depth and camera differ, or if nothing
/// overlaps at any gap.
ConventionReport check_conventions(const ConventionInput& input, const ConventionOptions& options = {});

/// "+480.0 as stored shift 0 scale 1000": the parts of a convention, for messages.
std::string convention_text(const Convention& convention, const Camera& camera);

/// The first max_rows rows, and the declared one if it is not among them, as aligned text: errors in mm and in % of
/// depth, the winner marked *, the declared convention marked d.
std::string convention_table(const ConventionReport& report, const Camera& camera, std::size_t max_rows = 12);

}  // namespace odosplat
