// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/map/map_view.hpp"

namespace odosplat {

struct PlaceIndexOptions {
  int width = 320;            // [px] of the widest image that places are rendered and images are looked up in
  int thumbnail_width = 32;   // [px]
  int max_shift = 8;          // [thumbnail px] largest shift between an image and the view of its place
  int features = 500;         // ORB keypoints wanted per view
  int corner_threshold = 6;   // [of 255] contrast of a corner; rendered walls have little
  double ratio = 0.85;        // a match is kept if its distance is at most this share of the second best's
  double min_coverage = 0.3;  // share of a place's view with depth, below which the place is not kept

  /// Throws InputError naming the field.
  void check() const;
};

/// What an image is recognised by. Data only.
struct ViewSignature {
  cv::Mat1f thumbnail;               // grey, blurred
  cv::Mat1b thumbnail_valid;         // not 0 where the map shows something
  std::vector<cv::Point2f> corners;  // [px] of the index's camera
  cv::Mat1b descriptors;             // one row per corner
};

/// A corner of the image that is, perhaps, a point of the map.
struct PointMatch {
  Eigen::Vector3d p_world;  // [m]
  cv::Point2f pixel;        // of the index's camera
};

/// How well an image fits one place.
struct PlaceMatch {
  std::size_t place = 0;                            // number in PlaceIndex::places()
  double similarity = -1.0;                         // -1..1, correlation of the thumbnails at the best shift
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  // [px] of the index's camera: image (u) shows place (u + shift)
  std::vector<PointMatch> points;
};

/// Views rendered from some places of a map, kept as thumbnails and as corners with descriptor and 3-D point, to find
/// the place nearest to where an image was taken.
/// Source: thumbnails as in PTAM's relocaliser (Klein and Murray 2008), ORB (Rublee et al. 2011) with rendered depth.
/// Differs: both come from the map, so no image of the mapping run is needed. About 30 kB a place. Deterministic; const
/// calls may run at once. Throws InputError on bad options.
class PlaceIndex {
 public:
  /// Renders every place once; those that see too little of the map are not kept. camera: of the images to be found.
  PlaceIndex(const Camera& camera, MapView& map, const std::vector<SE3>& places, const PlaceIndexOptions& options);

  /// The camera that views are rendered with: the images' own, smaller if they are wider than options.width.
  const Camera& camera() const { return camera_; }
  /// T_world_camera of the places kept.
  const std::vector<SE3>& places() const { return places_; }

  /// `gray` is of camera()'s size, 0..1.
  ViewSignature signature(const GrayImage& gray) const;
  /// Compares with every place kept, in their order. Corners are compared only for those with the most similar
  /// thumbnails.
  std::vector<PlaceMatch> match(const ViewSignature& image) const;

 private:
  struct PlaceView {
    ViewSignature signature;
    std::vector<Eigen::Vector3d> points_world;  // one per corner
  };
  void compare_thumbnails(const ViewSignature& image, PlaceMatch& match) const;
  void match_points(const ViewSignature& image, PlaceMatch& match) const;

  PlaceIndexOptions options_;
  Camera camera_;
  std::vector<SE3> places_;
  std::vector<PlaceView> views_;
};

/// The image at the size of `camera`, which has the same view: mean over areas.
GrayImage resized_gray(const GrayImage& gray, const Camera& camera);

}  // namespace odosplat
