// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odosplat/odometry/confirm/misfit_system.hpp"
#include "odosplat/odometry/confirm/rendered_view.hpp"
#include "odosplat/odometry/frame/frame.hpp"

namespace odosplat {

/// Side of the squares of a view that are compared with an image [px of its pyramid level].
inline constexpr int patch_side = 8;
inline constexpr int patch_pixels = patch_side * patch_side;
/// Values of a square's pixels, row by row.
using PatchValues = Eigen::Array<float, patch_pixels, 1>;

struct ConfirmationOptions {
  bool enabled = true;             // false: every pose is accepted, as where the map has no colours
  int width = 400;                 // [px] the finest level that is compared is at most this wide, the other one half
  double min_texture = 2.0 / 255;  // [grey] spread in a square, less a plane; a square with less in both image and map
                                   // is not used
  int min_patches = 30;            // squares with texture, on one level, that a verdict needs
  double min_share = 0.3;          // share of the image that the map must show

  // The score of an image of another place, at the pose where it fits best, is modelled as normal around 0 with
  // variance null_common^2 + null_patch^2 / squares. The common part accounts for structures that repeat within a
  // place, as ceiling panels do. `odosplat_accuracy confirm` counts the wrong poses that are confirmed with these
  // values and the right ones that are not.
  double null_common = 0.05;
  double null_patch = 0.5;
  double prior = 1e-3;  // probability of a right pose before the image is looked at
  // Parts of two places may be alike to the pixel, such as ceilings and walls: then the score is high, but the image
  // also shows what the map does not.
  double part_prior = 0.005;   // odds of a place alike in part to the right one, before the image is looked at
  double right_against = 0.1;  // mean of MapEvidence::against at right poses, where it is modelled as exponential; for
                               // places that are alike in part it is modelled as uniform
  double confirmed = 0.99;     // probability from which a pose counts as confirmed
  double contradicted = 0.5;   // probability below which it counts as contradicted, where the map could be compared

  /// Throws InputError naming the field.
  void check() const;
};

/// How a pose agrees with the map's colours.
enum class Confirmation {
  none,          // nothing: the map shows too little there, or nothing with texture, or has no colours
  confirmed,     // the image agrees with the map there
  undecided,     // image and map agree in part
  contradicted,  // the map shows something else from there
};

/// How an image compares with a view of the map from an assumed pose.
struct MapEvidence {
  double share = 0.0;        // of the image, where the view's squares fall
  int patches = 0;           // squares with texture on the level that decides
  double score = 0.0;        // -1..1, their mean correlation
  double against = 0.0;      // share of the squares in which the image shows clearly what the map does not
  double probability = 0.0;  // that the pose is right; 0 where nothing can be compared
  Confirmation verdict = Confirmation::none;
};

/// A rendered view of the map cut into squares, each with its place in space, to be compared with images from nearby.
/// Each square is correlated with what the image shows in its place, after mean and slope are removed from both: then
/// light, exposure and shading have no influence, nor has what an alignment can bring to agree between two different
/// places, and squares of an image of another place correlate by chance, positively or negatively. The mean of the
/// correlations is the score. The image is compared on two pyramid levels, of which the coarser one is for blurred
/// images. Data; the same bits for any number of threads.
class ViewPatches {
 public:
  /// view: rendered with colours by this camera; without colours there are no squares. smoothing: as that of the
  /// images' pyramids [px], for a view whose grey values are not computed yet.
  ViewPatches(const Camera& camera, const RenderedView& view, double smoothing, const ConfirmationOptions& options);

  /// image: of the same camera, taken at T_world_camera.
  MapEvidence compare(const FramePyramid& image, const SE3& T_world_camera) const;

  /// The normal equations for pose and camera together: of the shifts that bring each square to agree with the image,
  /// at T_camera_world and `camera`. velocity: of the camera, T_camera_world(t) = exp(t velocity) T_camera_world.
  /// coarse: 0 the finer level, 1 the coarser one. Squares that correlate by less than min_patch are left out, others
  /// count by the square of their correlation.
  MisfitSystem misfit(const FramePyramid& image, const SE3& T_camera_world, const Vector6d& velocity,
                      const CameraCorrection& camera, int coarse, double min_patch) const;

 private:
  struct Patch {
    PatchValues x, y, z;  // [m] in the view's frame
    PatchValues shape;    // grey values less mean and slope, of length 1; shorter if they hardly vary
    bool textured = false;

    Eigen::Vector3d point(int pixel) const { return Eigen::Vector3f(x[pixel], y[pixel], z[pixel]).cast<double>(); }
  };
  struct Level {
    int number = 0;  // of the pyramid
    int cells = 0;   // squares that would fill the image
    std::vector<Patch> patches;
  };
  MapEvidence compare(const Level& level, const FramePyramid& image, const SE3& T_camera_view) const;

  ConfirmationOptions options_;
  SE3 T_world_view_;
  std::vector<Level> levels_;
};

/// Probability that a pose is right, by Bayes' rule: against an image of another place, from the score, which is
/// modelled as uniform in 0..1 for right poses; and against a place that is alike in part, from `against`.
double confirmation_probability(double score, int patches, double against, const ConfirmationOptions& options);

}  // namespace odosplat
