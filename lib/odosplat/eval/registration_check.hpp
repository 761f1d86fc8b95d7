// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"

namespace odosplat {

/// Colour images and their depth images, said to be of one camera.
struct RegistrationInput {
  Camera camera;
  std::size_t images = 0;
  std::function<GrayImage(std::size_t)> gray;    // of the camera's size
  std::function<DepthImage(std::size_t)> depth;  // of the same size [m], 0 = none
};

struct RegistrationOptions {
  int images = 24;                // that are looked at, spread evenly
  double max_scale_change = 0.2;  // that is looked for, either way
  double max_shift = 0.04;        // of the image's width, along either axis
  double tolerance = 0.008;       // of the image's width: misfit at the image's corner that counts as registered
  double clear = 0.02;            // misfit that counts as not registered
  double sure = 4.0;              // standard deviations

  void check() const;
};

/// Where depth's edges are found in the colour images: u_color = center + scale * (u_depth - center) + shift.
struct RegistrationReport {
  std::optional<bool> registered;  // none: the images do not tell
  double scale = 1.0;              // focal length of colour over that of depth
  double scale_sigma = 0.0;
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d shift_sigma_px = Eigen::Vector2d::Zero();
  double contrast = 0.0;           // colour's gradient under the edges there, over that around them; 1: none
  double declared_contrast = 0.0;  // the same where they are said to be
  std::size_t edges = 0;
  std::string text;  // one sentence
};

/// Finds out whether depth belongs to the colour camera's pixels: where a surface ends before another, depth jumps and
/// so, mostly, does colour. The strength of colour's gradient across the edges of depth, over the mean strength around,
/// is looked at under every scale about the principal point and every shift in range, and the best is taken; sigmas by
/// a jackknife over groups of images. Depth that was taken by a camera aside, or with another focal length, has its
/// edges elsewhere. Edges are taken on the nearer surface's side, across holes of up to 8 pixels too (a sensor's
/// shadow). Not registered: the best place differs from the declared one by more than `clear` at the image's corner
/// and by more than `sure` sigmas. Registered: by less than the tolerance. Nothing is decided between the two (the text
/// says how far off depth seems to be: a camera a little aside, a small turn), with under 2000 edges, or without a
/// gradient that stands out by 15 %. Images wider than 400 pixels are halved.
///
/// Throws InputError if the images are not of the camera's size. Deterministic.
RegistrationReport check_registration(const RegistrationInput& input, const RegistrationOptions& options = {});

}  // namespace odosplat
