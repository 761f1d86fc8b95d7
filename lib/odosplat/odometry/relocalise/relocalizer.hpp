// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/align/image_aligner.hpp"
#include "odosplat/odometry/confirm/map_confirmation.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/relocalise/perspective_pose.hpp"
#include "odosplat/odometry/relocalise/place_index.hpp"

namespace odosplat {

struct RelocalizerOptions {
  PlaceIndexOptions index;
  PerspectivePoseOptions pose;
  ConfirmationOptions confirmation;  // whether it is enabled does not count: a found pose must be confirmed
  ImageAlignerOptions aligner;
  SelectorOptions selector;
  ReferenceOptions reference;
  MapPlaneOptions plane;
  double smoothing = 0.8;            // [px] of images and rendered views
  double min_spread = 3.0 / 255;     // [grey] of the image; one of a single colour is not looked up
  int candidates = 4;                // places tried by thumbnail, and as many by corners
  int finalists = 3;                 // poses that are rendered again and verified
  double same_distance = 0.1;        // [m] poses within this and same_angle count as one
  double same_angle = 5.0 / 57.3;    // [rad]
  double min_coverage = 0.6;         // share of the image that the map must show
  double min_score = 0.5;            // MapEvidence::score: the best of many poses agrees better by chance than one pose
  double ambiguity = 0.1;            // score by which the best pose must beat every other one
  double min_inliers = 0.4;          // share of the points in view that must agree
  double max_position_sigma = 0.05;  // [m] largest standard deviation of the position by alignment, times root of
                                     // covariance_factor
  double covariance_factor = 20.0;   // errors of neighbouring pixels are correlated, which the information does not
                                     // contain
  double disturbance = 0.02;         // [m] along, and half as many rad about, each axis: a second alignment starts
                                     // there
  double return_distance = 0.02;     // [m] and must end within this distance of the first

  /// Throws InputError naming the field.
  void check() const;
};

/// Where an image was taken, or why that is not known.
struct Relocalization {
  bool found = false;
  SE3 T_world_camera;  // identity if not found: no pose is made up
  /// Of exp(xi) on the left of T_world_camera, xi = (translation [m], rotation [rad]): covariance_factor times that of the
  /// last alignment. Zero if not found.
  Matrix6d covariance = Matrix6d::Zero();
  Brightness brightness;      // of the image against the map's rendered one
  double score = 0.0;         // of the best pose, MapEvidence::score, also if it was refused
  double probability = 0.0;   // that the best pose is right, MapEvidence::probability, also if it was refused
  double inlier_share = 0.0;  // of the best pose's alignment
  std::string reason;         // why not found; empty if found
};

/// Finds the camera in a map without a start pose, or reports that it cannot, in four steps:
/// 1. The places most like the image, by thumbnail and by corners (PlaceIndex).
/// 2. A pose from each: P3P on corners with rendered depth of the place and its neighbours, or the place's own.
/// 3. Direct alignment (ImageAligner) of the image with the map rendered at that pose, twice.
/// 4. Confirmation by the map's colours (ViewPatches); besides, the pose must be well determined, must be found again
///    from a disturbed start, and no other place may look alike.
/// The first call renders every place. Images and views are at most options.index.width wide, so memory and time do not
/// grow with the camera's size. Deterministic: the same bits for any number of threads. map must outlive this. Not
/// thread safe.
class Relocalizer {
 public:
  /// camera: of the images. places: T_world_camera of views of the map to look from. Throws InputError on bad options.
  Relocalizer(const Camera& camera, MapView& map, std::vector<SE3> places, const RelocalizerOptions& options = {});

  /// Renders the places now rather than in the first call of find; nothing if that was done. Returns how many of them
  /// see enough of the map to be looked from.
  std::size_t prepare();

  /// image: grey 0..1, of the camera's size (else InputError).
  Relocalization find(const GrayImage& image);
  /// The same for a camera that was at T_world_near some time ago: that pose and the places nearest to it are tried,
  /// too. They must pass the same checks.
  Relocalization find(const GrayImage& image, const SE3& T_world_near);

 private:
  /// A guess of the camera's pose, and the result of aligning the image from there.
  struct Candidate {
    SE3 T_world_view;                // where the map is rendered from
    std::vector<SE3> T_target_host;  // guesses for the image against that view
    Alignment alignment;
    SE3 T_world_camera() const { return T_world_view * alignment.T_target_host.inverse(); }
  };
  struct Finalist {
    Candidate candidate;
    MapEvidence evidence;
    Matrix6d covariance = Matrix6d::Zero();  // of exp(xi) on the left of its T_world_camera
    std::string fault;                       // why it is not accepted
  };

  Relocalization look_up(const GrayImage& image, const std::optional<SE3>& T_world_near);
  std::vector<Candidate> propose(const GrayImage& gray, const std::optional<SE3>& T_world_near) const;
  /// The points of a rendered view to align with.
  TrackingReference reference_of(const FramePyramid& rendered, const ViewImages& view) const;
  void align(std::vector<Candidate>& candidates, const FramePyramid& image);
  std::vector<Candidate> distinct(std::vector<Candidate> candidates, std::size_t most) const;
  Finalist verify(const Candidate& candidate, const FramePyramid& image);
  bool is_same(const SE3& T_a, const SE3& T_b) const;

  Camera camera_;
  MapView& map_;
  std::vector<SE3> given_places_;
  RelocalizerOptions options_;
  ImageAligner aligner_;
  std::optional<PlaceIndex> index_;
};

}  // namespace odosplat
