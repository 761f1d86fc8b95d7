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

/// Posed depth images with the conventions that their files declare.
struct ConventionInput {
  Camera camera;             // fy > 0; the declared sign is fy_sign
  int fy_sign = 1;           // +1 or -1
  double depth_scale = 1.0;  // declared units per metre
  // One per depth image, at the depth's own time, as stored in the files: neither inverted nor reflected. None: the
  // files have no pose for the image.
  std::vector<std::optional<SE3>> T_world_camera;
  // Depth of an image [m] by the declared depth_scale, 0 = none; called from one thread; two images are kept at a time.
  std::function<DepthImage(std::size_t)> depth;
};

struct ConventionOptions {
  int gap = 20;              // [frames] between the two images of a pair; other gaps for short sequences, see below
  int pairs = 32;            // pairs of images, spread evenly
  int samples = 2000;        // pixels per pair, on a regular grid
  double min_overlap = 0.2;  // share of them that must be projected onto a pixel with depth in the other image
  double max_error = 0.05;   // largest relative error of a convention that is accepted
  // Tried in addition to the declared scale: millimetres; TUM and ICL-NUIM; Replica as rendered for iMAP; tenths of a
  // millimetre; KITTI.
  std::vector<double> depth_scales = {1000.0, 5000.0, 6553.5, 10000.0, 256.0};

  void check() const;
};

/// Determines from the data which conventions of fy, poses, numbering and depth scale are right, by reprojection:
/// pixels of image i are back-projected with their depth and transformed by the poses into image i + gap, and their
/// depth there is compared with that image's depth (nearest pixel). All combinations of both signs of fy, poses as
/// stored or inverted, 3 shifts and the depth scales are tried, one row each. Reflected poses, F T F with F = diag(1,
/// -1, 1), need no rows of their own: with fy > 0 they equal the stored poses with fy < 0. Rows are compared by the
/// error relative to depth, because the error in metres favours a scale that makes everything small.
///
/// Rows are compared by beats(). Among the rows that the best row does not beat, the one most similar to the declared
/// convention is the winner, so that nothing is reported as wrong unless the data show it. A part of the winner is
/// decided if the winner beats every row that differs from it in this part and in at most one other; rows with three
/// different parts are not considered, because they may fit by chance. A row that could not be tried because its poses
/// are missing is not beaten.
///
/// A sequence shorter than twice the gap is used with pairs of every gap from a third of its length up, to get as much
/// as possible from few images. Pairs that can be tried under every shift are preferred. The gap is halved as long as
/// no row is believable and less than half of the pixels overlap under the declared convention: if the camera moves
/// that fast, wrong rows overlap as much as the right one and none fits. If no row fits at any gap, the report is that
/// of the gap with the largest overlap. Throws InputError if there are fewer than two images with a pose, if the sizes
/// of depth and camera differ, or if nothing overlaps at any gap.
ConventionReport check_conventions(const ConventionInput& input, const ConventionOptions& options = {});

/// The parts of a convention as text: "fy +480.0, poses as stored, id shift 0, depth scale 1000".
std::string convention_text(const Convention& convention, const Camera& camera);

/// The first max_rows rows, and the declared one if it is not among them, as aligned text: errors in mm and in % of
/// depth, the winner marked *, the declared convention marked d.
std::string convention_table(const ConventionReport& report, const Camera& camera, std::size_t max_rows = 12);

}  // namespace odosplat
