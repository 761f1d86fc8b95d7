// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/keyframe/keyframe_maker.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/frame/motion_model.hpp"
#include "odosplat/odometry/keyframe/keyframe_policy.hpp"
#include "odosplat/odometry/light/brightness_splines.hpp"

namespace odosplat {
namespace {

/// Aligns the image with the rendered one. Levels 2 to 0 are enough where the tracked pose is right to a few pixels.
Alignment find_in_view(const TrackingReference& reference, const FramePyramid& image, const ImageAligner& aligner,
                       const AnchorOptions& options, const KeyframeContext& context) {
  if (context.first || context.distrust_map) {
    std::vector<SE3> guesses{SE3()};
    for (const SE3& turned : rotated_guesses(SE3(), options.far_off_angle)) guesses.push_back(turned);
    Alignment found = aligner.align_best(reference, image, guesses, {});
    // With so many guesses, one may fit a map of wrong colours by chance: then the caller's pose is the better start.
    if (context.distrust_map || (found.finished && found.correlation >= options.far_off_correlation)) return found;
  }
  const PosePrior tracked = pose_prior(SE3(), options.bare_translation, options.bare_rotation);
  return aligner.align(reference, image, SE3(), {}, 2, 0, reference.bare ? &tracked : nullptr);
}

bool is_good(const Alignment& a, const AnchorOptions& options, double max_log_gain) {
  return a.finished && a.inlier_share >= options.min_inliers && a.coverage >= options.min_coverage &&
         a.rmse <= options.max_rmse && std::abs(a.brightness.a) <= max_log_gain;
}

void trust_depth(MadeKeyframe& made, const ResidualWeights& agreement) {
  const auto trust = [&](double u, double v) { return std::pow(agreement.at(u, v), 2); };
  for (std::size_t level = 0; level < made.reference.levels.size(); ++level) {
    const double scale = std::ldexp(1.0, static_cast<int>(level));
    for (ReferencePoint& point : made.reference.levels[level]) {
      point.weight *= static_cast<float>(trust((point.u + 0.5) * scale - 0.5, (point.v + 0.5) * scale - 0.5));
    }
  }
  for (WindowPoint& point : made.keyframe->points) point.prior_information *= trust(point.u, point.v);
}

}  // namespace

double map_share(const ViewImages& view) {
  if (view.depth.empty()) return 0.0;
  return static_cast<double>(cv::countNonZero(view.depth)) / static_cast<double>(view.depth.total());
}

void AnchorOptions::check() const {
  require(noise > 0.0, "anchor.noise", "positive");
  require(strength > 0.0, "anchor.strength", "positive");
  require(min_inliers >= 0.0 && min_inliers <= 1.0, "anchor.min_inliers", "in [0, 1]");
  require(min_coverage >= 0.0 && min_coverage <= 1.0, "anchor.min_coverage", "in [0, 1]");
  require(max_rmse > 0.0, "anchor.max_rmse", "positive");
  require(render_again_flow > 0.0, "anchor.render_again_flow", "positive");
  require(gradient_weight > 0.0, "anchor.gradient_weight", "positive");
  require(bare_translation > 0.0 && bare_rotation > 0.0, "anchor.bare_translation and bare_rotation", "positive");
  require(far_off_angle > 0.0, "anchor.far_off_angle", "positive");
  require(far_off_correlation >= -1.0 && far_off_correlation <= 1.0, "anchor.far_off_correlation", "in [-1, 1]");
  tone.check();
  blur.check();
  agreement.check();
  depth_agreement.check();
  require(reset_flow >= render_again_flow, "anchor.reset_flow", "at least render_again_flow");
}

void KeyframeMakerOptions::check() const {
  selector.check();
  weak_selector.check();
  reference.check();
  plane.check();
  window_points.check();
  immature.check();
  anchor.check();
  require(smoothing >= 0.0 && smoothing <= 1.5, "keyframe.smoothing", "0 to 1.5 px");
  require(min_map_share >= 0.0 && min_map_share < 1.0, "keyframe.min_map_share", "in [0, 1)");
  require(full_share > 0.0 && full_share <= 1.0, "keyframe.full_share", "in (0, 1]");
  require(hole > 0.0 && border >= 0.0, "keyframe.hole and border", "positive");
  require(min_points >= 20, "keyframe.min_points", "at least 20");
}

KeyframeMaker::KeyframeMaker(const KeyframeMakerOptions& options)
    : options_(options),
      reference_selectors_{PixelSelector(options.selector), PixelSelector(options.weak_selector)},
      window_selectors_(reference_selectors_),
      map_reference_selectors_(reference_selectors_),
      anchor_selectors_(reference_selectors_),
      immature_selector_(options.selector) {
  options_.check();
}

ViewImages KeyframeMaker::without_border(const ViewImages& view, double share) const {
  if (share == 0.0 || share == 1.0 || options_.border == 0.0) return view;
  const double size = view.depth.cols + view.depth.rows;
  const auto square = [](double side) {
    const int odd = 2 * static_cast<int>(0.5 * side) + 1;
    return cv::getStructuringElement(cv::MORPH_RECT, {odd, odd});
  };
  cv::Mat1b holes;
  holes = view.depth <= 0.0F;
  // Pixels outside the image do not count as holes.
  const cv::Scalar none = cv::Scalar::all(0);
  cv::erode(holes, holes, square(options_.hole * size));
  cv::dilate(holes, holes, square((options_.hole + 2.0 * options_.border) * size), {-1, -1}, 1, cv::BORDER_CONSTANT,
             none);
  ViewImages inner = view;
  inner.depth = view.depth.clone();
  inner.depth.setTo(0.0F, holes);
  return inner;
}

MadeKeyframe KeyframeMaker::make(const EvenFrame& image, std::span<const GradientImage> gradients,
                                 const RenderedView& whole_view, const Brightness& brightness,
                                 const ImageAligner& aligner, const KeyframeContext& context) {
  const FramePyramid& pyramid = *image.even;
  MadeKeyframe made;
  made.map_share = map_share(whole_view.images);
  const ViewImages view = without_border(whole_view.images, made.map_share);
  // If the map covers less of the image, there are fewer points: they are as dense as in a full image.
  made.point_share = std::min(1.0, map_share(view) / options_.full_share);
  made.reference = build_reference(pyramid, gradients, view, reference_selectors_.usual, options_.reference,
                                   options_.plane, &reference_selectors_.weak);
  const auto enough = [&](int others) {
    return static_cast<int>(made.reference.levels.front().size()) + others >= options_.min_points;
  };
  made.verifiable = options_.anchor.enabled && !view.color.empty();
  // A map without colours is always trusted: once left, nothing could show when its depth is right again.
  made.in_map = enough(0) && (made.map_share >= options_.min_map_share || !made.verifiable);
  made.keyframe = std::make_shared<Keyframe>();
  made.keyframe->T_world_camera = whole_view.T_world_camera;
  made.keyframe->brightness = brightness;
  made.keyframe->gradient = gradients.front();
  std::optional<ResidualWeights> depth_agreement;
  if (made.in_map && made.verifiable) {
    const auto seen =
        whole_view.gray != nullptr ? whole_view.gray : gray_of(pyramid.cameras.front(), view, options_.smoothing);
    depth_agreement = add_anchor(made, image, view, *seen, aligner, context);
  }
  const bool map_believed = made.in_map && (!context.distrust_map || made.anchored || !made.verifiable);
  if (!map_believed) {
    made.in_map = false;
    for (auto& level : made.reference.levels) level.clear();
  }
  if (!enough(context.other_points)) {
    made.keyframe = nullptr;
    return made;
  }
  add_points(made, pyramid.cameras.front(), gradients, map_believed ? view : ViewImages(), context.first);
  if (depth_agreement) trust_depth(made, *depth_agreement);
  return made;
}

void KeyframeMaker::add_points(MadeKeyframe& made, const Camera& camera, std::span<const GradientImage> gradients,
                               const ViewImages& view, bool first) {
  Keyframe& keyframe = *made.keyframe;
  const WindowPointOptions& options = options_.window_points;
  const bool search = options.depth_use == DepthUse::interval && !first;
  const int wanted = static_cast<int>(made.point_share * options.points);
  keyframe.immature =
      make_immature_points(gradients, view.depth, options.gradient_weight, immature_selector_, options_.immature);
  keyframe.points =
      make_window_points(camera, gradients, view, keyframe.T_world_camera, wanted,
                         window_selectors_.of(made.reference.bare), options, options_.plane, options.depth_use);
  if (!search) return;
  for (const WindowPoint& point : keyframe.points) {
    const cv::Point pixel(static_cast<int>(point.u), static_cast<int>(point.v));
    const double q = inverse_depth(point, camera, keyframe.T_world_camera);
    ImmaturePoint immature = make_immature_point(keyframe.gradient, pixel, options.gradient_weight);
    immature.of_map = true;
    immature.min_q = q / (1.0 + options_.immature.depth_interval);
    immature.max_q = q / (1.0 - options_.immature.depth_interval);
    keyframe.immature.push_back(immature);
  }
  keyframe.points.clear();
}

KeyframeMaker::RenderedReference KeyframeMaker::rendered_reference(const FramePyramid& pyramid,
                                                                   const ViewImages& view) {
  RenderedReference out;
  out.gradients = build_gradients(pyramid);
  out.reference = build_reference(pyramid, out.gradients, view, map_reference_selectors_.usual, options_.reference,
                                  options_.plane, &map_reference_selectors_.weak);
  return out;
}

std::optional<ResidualWeights> KeyframeMaker::add_anchor(MadeKeyframe& made, const EvenFrame& image,
                                                         const ViewImages& view, const RenderedGray& seen,
                                                         const ImageAligner& aligner, const KeyframeContext& context) {
  const FramePyramid& pyramid = *image.even;
  const AnchorOptions& options = options_.anchor;
  Keyframe& keyframe = *made.keyframe;
  GrayImage gray = seen.gray;
  RenderedReference rendered = rendered_reference(seen.pyramid, view);
  if (rendered.reference.empty()) return {};
  Alignment alignment = find_in_view(rendered.reference, pyramid, aligner, options, context);
  EvenFrame evened = image;
  const bool changed = alignment.finished && even_rows(aligner, rendered.reference, evened, alignment);
  const double max_log_gain = aligner.options().max_log_gain;
  made.anchor = alignment;
  if (!is_good(alignment, options, max_log_gain)) return {};
  const auto try_again = [&](GrayImage other) {
    RenderedReference view_again =
        rendered_reference(build_frame_pyramid(pyramid.cameras.front(), other, options_.smoothing), view);
    const Alignment again = aligner.align(view_again.reference, *evened.even, alignment.T_target_host, {}, 1, 0);
    if (!is_good(again, options, max_log_gain) || !(worth(again) > worth(alignment))) return false;
    rendered = std::move(view_again);
    gray = std::move(other);
    made.anchor = alignment = again;
    return true;
  };
  if (const auto tone = estimate_tone(rendered.reference, *evened.even, alignment.T_target_host, alignment.brightness,
                                      options.tone)) {
    try_again(apply_tone(gray, *tone));
  }
  const auto take_samples = [&] {
    return brightness_samples(rendered.reference, *evened.even, alignment.T_target_host, alignment.brightness, 0);
  };
  std::vector<BrightnessSample> samples = take_samples();
  // A large blur takes two steps: each is right to second order only.
  for (int step = 0; step < 2; ++step) {
    const auto blur =
        estimate_blur(rendered.gradients.front(), samples, std::exp(alignment.brightness.a), options.blur);
    if (!blur || !try_again(apply_blur(gray, *blur))) break;
    samples = take_samples();
  }
  if (changed) made.evened = evened;
  Anchor anchor;
  anchor.T_world_view = keyframe.T_world_camera;
  WindowPointOptions point_options = options_.window_points;
  point_options.gradient_weight = options.gradient_weight;
  anchor.points =
      make_window_points(pyramid.cameras.front(), rendered.gradients, view, anchor.T_world_view,
                         static_cast<int>(made.point_share * point_options.anchor_points),
                         anchor_selectors_.of(rendered.reference.bare), point_options, options_.plane, DepthUse::fixed);
  const ResidualWeights agreement = residual_weights(pyramid.cameras.front(), samples, options.agreement);
  for (WindowPoint& point : anchor.points) {
    for (float& weight : point.weight) weight *= static_cast<float>(agreement.at(point.u, point.v));
  }
  // Relative brightness of the image against the rendered one is (a_k - a_m, b_k - e^(a_k - a_m) b_m): solved for the
  // map's a_m and b_m.
  anchor.brightness.a = keyframe.brightness.a - alignment.brightness.a;
  anchor.brightness.b = (keyframe.brightness.b - alignment.brightness.b) * std::exp(-alignment.brightness.a);
  const double ratio = options.noise / std::max(options.noise, alignment.rmse);
  anchor.weight = options.strength * ratio * ratio * made.point_share;
  made.T_world_camera_map = anchor.T_world_view * alignment.T_target_host.inverse();
  made.map_flow = keyframe_score(rendered.reference, alignment, 0.0, {}).full_flow;
  made.anchored = !anchor.points.empty();
  if (made.anchored) keyframe.anchors.push_back(std::move(anchor));
  return residual_weights(pyramid.cameras.front(), samples, options.depth_agreement);
}

}  // namespace odosplat
