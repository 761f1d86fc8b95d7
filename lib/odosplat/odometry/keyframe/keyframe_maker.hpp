// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/align/image_aligner.hpp"
#include "odosplat/odometry/confirm/rendered_view.hpp"
#include "odosplat/odometry/frame/even_rows.hpp"
#include "odosplat/odometry/keyframe/keyframe.hpp"
#include "odosplat/odometry/light/image_blur.hpp"
#include "odosplat/odometry/light/residual_weights.hpp"
#include "odosplat/odometry/light/tone_curve.hpp"
#include "odosplat/odometry/points/immature_points.hpp"
#include "odosplat/odometry/residual_noise.hpp"
#include "odosplat/odometry/window/window_points.hpp"

namespace odosplat {

struct AnchorOptions {
  bool enabled = true;
  // [grey] root mean square residual of a rendered view up to which it counts like a real image
  double noise = residual_noise;
  double strength = 8.0;  // factor of its weight: one rendered view must balance six keyframes, and its points have
                          // weights below 1 where image and map agree less well (agreement)
  // [grey/px] c of the weight c^2 / (c^2 + |gradient|^2) of the rendered view's points in the window. Edges of a map
  // are displaced by fractions of a pixel, so strong ones count less than in an image (docs/rules.md). The alignment
  // before it uses the constant of images: with weak gradients alone, a map of wrong colours would be accepted.
  double gradient_weight = 10.0 / 255;
  // Share of its points that must agree with the real image. A coarse map (20 dB) reaches 0.4 to 0.6 and still keeps
  // the camera in place (docs/rules.md).
  double min_inliers = 0.4;
  double min_coverage = 0.3;       // share of its points that must be in view
  double max_rmse = 12.0 / 255;    // [grey]
  double render_again_flow = 2.0;  // [px] if the map moves a keyframe further, the view is rendered again from its new
                                   // pose
  double reset_flow = 4.0;         // [px] if the map moves it further than this, the keyframes that the map placed
                                   // before count as wrong and are dropped
  // In a bare rendered view (ReferenceOptions) some directions of motion are determined by weak shading alone, where
  // errors of the map's colours are correlated over many pixels. Its alignment is tied to the tracked pose.
  double bare_translation = 0.007;  // [m] standard deviation of that tie
  double bare_rotation = 0.0035;    // [rad] the same
  double far_off_angle = 0.04;      // [rad] of turned guesses, at the start and when the camera comes back into the map

  // Least correlation of a start that is found from turned guesses; if it is lower, only the given start pose is tried.
  // Right starts reach 0.8 to 0.96 before the view is rendered again, chance matches 0.68, and 0.83 in a map of
  // inverted colours.
  double far_off_correlation = 0.9;

  ToneOptions tone;  // of the image against the map's colours
  BlurOptions blur;  // the same
  // Weights of the rendered view's points in the window (docs/rules.md). The alignment before it gains nothing by them.
  ResidualWeightOptions agreement;
  // Weights of the map's depth in the keyframe's own image: where image and map differ by more, the surface may be
  // another one. The weight is squared (docs/rules.md).
  ResidualWeightOptions depth_agreement{.noise = 4.0 / 255};

  void check() const;
};

struct KeyframeMakerOptions {
  SelectorOptions selector;
  SelectorOptions weak_selector = weak_selector_options();  // for bare images
  ReferenceOptions reference;
  MapPlaneOptions plane;
  WindowPointOptions window_points;
  ImmaturePointOptions immature;
  AnchorOptions anchor;
  double smoothing = 0.8;      // [px] of all images before use, real and rendered; 0: none
  double min_map_share = 0.5;  // share of the image with map depth below which the camera counts as outside: what is
                               // left lies at the border of the image and of the map, where both are least accurate
  double full_share = 0.8;     // share of the image with map depth from which on the window gets all points it wants
  double hole = 0.015;         // share of width + height: holes at least this wide in the map's depth are borders of
                               // the map
  double border = 0.04;  // share of width + height: depth this near to a border is not used. Gaussians there were seen
                         // from few sides and stick out
  int min_points = 100;  // with depth, on full size, the map's or other keyframes'; fewer make no keyframe

  void check() const;
};

/// What is known beside the image and the map.
struct KeyframeContext {
  bool first = false;         // there is no other keyframe to search in, and the pose is not a tracked one
  int other_points = 0;       // estimated points of other keyframes that this image sees; they count towards min_points
  bool distrust_map = false;  // the camera has been outside the map: the pose that the map was rendered from may be far
                              // off, so that its depth is used only if the rendered image is found in the real one
};

/// The result of the attempt to make a keyframe.
struct MadeKeyframe {
  std::shared_ptr<Keyframe> keyframe;  // null: too little depth there
  TrackingReference reference;         // the keyframe's, with the map's points alone; the caller completes it and puts
                                       // it into the keyframe
  bool in_map = false;                 // the map alone shows enough, and its depth is used
  bool verifiable = false;             // the map has colours to be compared with the image
  double point_share = 0.0;            // share of the window's wanted points that the map should give
  double map_share = 0.0;              // share of the image with map depth
  bool anchored = false;
  std::optional<EvenFrame> evened;  // where the rendered view shows that the image's rows are not alike: the image as
                                    // the keyframe should be made of
  Alignment anchor;                 // of the keyframe's image against the rendered one
  SE3 T_world_camera_map;           // where that alignment puts the camera, if anchored
  double map_flow = 0.0;            // [px] root mean square image motion between that and the pose rendered from
};

/// Share of the view's pixels with depth.
double map_share(const ViewImages& view);

/// Turns an image and the map's view from its pose into a keyframe: points with map depth for tracking and for the
/// window, and the rendered view itself as anchor where it resembles the image. Holds scratch memory; not thread safe.
class KeyframeMaker {
 public:
  explicit KeyframeMaker(const KeyframeMakerOptions& options);

  /// gradients: the even image's, of every level. view must have been rendered with the image's camera. The keyframe's
  /// pose is the view's, its brightness as given; id, frame and time are left to the caller. aligner aligns image and
  /// rendered view.
  MadeKeyframe make(const EvenFrame& image, std::span<const GradientImage> gradients, const RenderedView& view,
                    const Brightness& brightness, const ImageAligner& aligner, const KeyframeContext& context = {});

  const KeyframeMakerOptions& options() const { return options_; }

 private:
  /// seen: the view's. Returns how far the map's depth is to be trusted; none if there is no anchor.
  std::optional<ResidualWeights> add_anchor(MadeKeyframe& made, const EvenFrame& image, const ViewImages& view,
                                            const RenderedGray& seen, const ImageAligner& aligner,
                                            const KeyframeContext& context);
  /// What the aligner and the window need of a rendered view. Its grey values may have been changed to match the image.
  struct RenderedReference {
    std::vector<GradientImage> gradients;
    TrackingReference reference;
  };
  RenderedReference rendered_reference(const FramePyramid& pyramid, const ViewImages& view);
  ViewImages without_border(const ViewImages& view, double share) const;
  void add_points(MadeKeyframe& made, const Camera& camera, std::span<const GradientImage> gradients,
                  const ViewImages& view, bool first);

  /// The selectors of one purpose: each keeps its cell size from image to image.
  struct Selectors {
    PixelSelector usual;
    PixelSelector weak;
    PixelSelector& of(bool bare) { return bare ? weak : usual; }
  };

  KeyframeMakerOptions options_;
  Selectors reference_selectors_;
  Selectors window_selectors_;
  Selectors map_reference_selectors_;
  Selectors anchor_selectors_;
  PixelSelector immature_selector_;
};

}  // namespace odosplat
