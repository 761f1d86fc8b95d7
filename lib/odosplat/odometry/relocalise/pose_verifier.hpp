// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/frame/tracking_reference.hpp"

namespace odosplat {

/// When a pose found by search is accepted.
struct PoseVerifierOptions {
  int block = 16;                  // [px] side of the squares that are alternately used for alignment and held back
                                   // from it
  double block_depth_share = 0.6;  // share of a square's pixels with map depth below which it is not used
  double min_texture = 4.0 / 255;  // [grey] spread within a square, of image or map, below which it is not used
  int min_blocks = 12;             // squares that can be used
  double min_coverage = 0.6;       // share of the image where the map has depth
  // 0..1, see PoseEvidence::score. Right poses reach 0.90 and more in a good map (36 dB), 0.35 to 0.93 in a coarse one
  // of blurred images (20 dB). The best poses found for images of other rooms reach 0.15; for images of which half of
  // the map was deleted, 0.71.
  double min_score = 0.75;

  /// Throws InputError naming the field.
  void check() const;
};

/// How image and map compare at a pose, in the squares that were not used for alignment.
struct PoseEvidence {
  double coverage = 0.0;  // share of the image where the map has depth
  double score = 0.0;     // -1..1, mean correlation within the squares that were held back and can be used
  int blocks = 0;         // how many those are
};

/// Whether pixel (u, v) [px] of full size is held back: squares as on a chessboard.
bool is_held_back(double u, double v, int block);

/// The reference without the points that lie in squares that are held back, on every level.
TrackingReference without_held_back(const TrackingReference& reference, int block);

/// Compares an image with the map rendered at the pose found for it, in the squares that were held back. Correlation
/// does not depend on gain and offset, here within every square: exposure, vignette and the map's tones have no
/// influence, only the shape of what is seen. All of one size, 0..1, depth [m].
PoseEvidence compare_with_map(const GrayImage& image, const GrayImage& rendered, const DepthImage& depth,
                              const PoseVerifierOptions& options);

/// Why the pose is not accepted; empty: it is.
std::string fault_of(const PoseEvidence& evidence, const PoseVerifierOptions& options);

}  // namespace odosplat
