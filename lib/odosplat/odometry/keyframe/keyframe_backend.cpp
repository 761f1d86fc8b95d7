// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/keyframe/keyframe_backend.hpp"

#include <algorithm>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/frame/row_shift.hpp"
#include "odosplat/odometry/reprojection.hpp"

namespace odosplat {
namespace {

enum StageIndex : std::size_t { stage_render, stage_keyframe, stage_optimise, stage_trace, stage_confirm };

constexpr double recalled_flow = 0.5;  // [px] a keyframe that others move further is rendered from its new place

}  // namespace

void DriftOptions::check() const {
  require(translation >= 0.0 && rotation >= 0.0, "drift.translation and rotation", "at least 0");
}

Matrix6d drift_covariance(const DriftOptions& options, const SE3& T_world_camera) {
  Vector6d variance;
  variance << Eigen::Vector3d::Constant(options.translation * options.translation),
      Eigen::Vector3d::Constant(options.rotation * options.rotation);
  const Matrix6d at_camera = SE3(Eigen::Quaterniond::Identity(), T_world_camera.translation()).adjoint();
  return at_camera * variance.asDiagonal() * at_camera.transpose();
}

void KeyframeBackendOptions::check() const {
  keyframe.check();
  confirmation.check();
  misfit.check();
  memory.check();
  window.check();
  optimizer.check();
  marginalization.check();
  activation.check();
  drift.check();
}

KeyframeBackend::KeyframeBackend(const Camera& camera, MapView& map, const ImageAligner& aligner,
                                 const KeyframeBackendOptions& options)
    : camera_(camera),
      map_(map),
      aligner_(aligner),
      options_(options),
      maker_(options.keyframe),
      optimizer_(options.optimizer),
      misfit_(options.misfit),
      memory_(camera, options.memory) {
  options_.check();
}

void KeyframeBackend::trace(const PosedFrame& frame) {
  const StageTimer timer(stages_[stage_trace]);
  const SE3 T_camera_world = frame.T_world_camera.inverse();
  for (const auto& host : window_.keyframes) {
    if (host->immature.empty()) continue;
    trace_points(host->immature, T_camera_world * host->T_world_camera, *frame.image.even,
                 relative_brightness(frame.brightness, host->brightness), options_.keyframe.immature);
  }
}

std::vector<TransferredPoint> KeyframeBackend::points_seen_from(const SE3& T_world_camera) const {
  std::vector<TransferredPoint> seen;
  const SE3 T_camera_world = T_world_camera.inverse();
  for (const auto& host : window_.keyframes) {
    const SE3 T_camera_host = T_camera_world * host->T_world_camera;
    for (const WindowPoint& point : host->points) {
      if (point.of_map) continue;
      const double q = inverse_depth(point, camera_, host->T_world_camera);
      const auto pixel = reproject(camera_, T_camera_host, point.u, point.v, q, 0.0);
      if (!pixel) continue;
      seen.push_back(
          {static_cast<float>(pixel->uv.x()), static_cast<float>(pixel->uv.y()), static_cast<float>(1.0 / pixel->z)});
    }
  }
  return seen;
}

MadeKeyframe KeyframeBackend::make_from(RenderedView& view, const KeyframeRequest& request,
                                        const KeyframeContext& context, EvenFrame& image,
                                        std::vector<GradientImage>& gradients) {
  const StageTimer timer(stages_[stage_keyframe]);
  if (view.gray == nullptr) view.gray = gray_of(camera_, view.images, options_.keyframe.smoothing);
  const auto make = [&] { return maker_.make(image, gradients, view, request.frame.brightness, aligner_, context); };
  MadeKeyframe made = make();
  if (!made.evened) return made;
  image = *made.evened;
  gradients = build_gradients(*image.even);
  return make();
}

std::shared_ptr<const ViewPatches> KeyframeBackend::patches_of(const RenderedView& view) {
  if (!options_.confirmation.enabled || view.images.color.empty()) return nullptr;
  const StageTimer timer(stages_[stage_confirm]);
  return std::make_shared<ViewPatches>(camera_, view, options_.keyframe.smoothing, options_.confirmation);
}

std::vector<Recollection> KeyframeBackend::recall(const FramePyramid& image, const SE3& T_world_camera) {
  const StageTimer timer(stages_[stage_keyframe]);
  return memory_.recall(image, T_world_camera, aligner_);
}

KeyframeBackend::Attempt KeyframeBackend::make_recalled(RenderedView& view, std::vector<Recollection> recalled,
                                                        const KeyframeRequest& request, KeyframeContext context,
                                                        EvenFrame& image, std::vector<GradientImage>& gradients) {
  const SE3& T_world_keyframe = recalled.front().T_world_camera;
  context.distrust_map = false;  // the view is rendered from a pose that remembered keyframes gave
  Attempt result;
  result.made = make_from(view, request, context, image, gradients);
  result.patches = patches_of(view);
  result.corrected = recalled.front().flow;
  MadeKeyframe& made = result.made;
  if (made.keyframe == nullptr) return result;
  made.keyframe->T_world_camera = T_world_keyframe;
  made.keyframe->anchors.clear();
  made.anchored = true;
  int links = recalled.front().links;
  for (Recollection& recollection : recalled) {
    links = std::min(links, recollection.links);
    made.keyframe->anchors.push_back(std::move(recollection.anchor));
  }
  result.links = links + 1;
  return result;
}

KeyframeBackend::Attempt KeyframeBackend::make(const KeyframeRequest& request, EvenFrame& image,
                                               std::vector<GradientImage>& gradients) {
  const AnchorOptions& anchor = options_.keyframe.anchor;
  MapView& map = request.view != nullptr ? *request.view : map_;
  KeyframeContext context;
  context.first = window_.keyframes.empty();
  context.other_points = static_cast<int>(points_seen_from(request.frame.T_world_camera).size());
  context.distrust_map = outside_;
  // The view rendered ahead has another pose than the frame. The anchor's alignment finds the frame's pose in it;
  // without an anchor, no keyframe can be made from it.
  std::optional<RenderedView> ahead = std::exchange(prefetched_, std::nullopt);
  if (ahead && (!anchor.enabled || request.view != nullptr ||
                view_flow(camera_, *ahead, request.frame.T_world_camera) > anchor.render_again_flow)) {
    ahead.reset();
  }
  Attempt result;
  result.prefetched = ahead.has_value();
  RenderedView view = ahead ? std::move(*ahead) : seen_from(map, request.frame.T_world_camera);
  {
    const StageTimer timer(stages_[stage_keyframe]);
    if (!image.even->row_motion.isZero(0.0)) {
      image = make_even(std::make_shared<FramePyramid>(with_rows_together(*image.even, view.images.depth)));
    }
    gradients = build_gradients(*image.even);
  }
  if (anchor.enabled && request.view == nullptr && map_share(view.images) < memory_.options().map_share) {
    std::vector<Recollection> recalled = recall(*image.even, request.frame.T_world_camera);
    if (!recalled.empty()) {
      const SE3& T_world_keyframe = recalled.front().T_world_camera;
      if (view_flow(camera_, view, T_world_keyframe) > recalled_flow) view = seen_from(map, T_world_keyframe);
      return make_recalled(view, std::move(recalled), request, context, image, gradients);
    }
  }
  MadeKeyframe& made = result.made;
  double& corrected = result.corrected;
  SE3 T_world_keyframe = view.T_world_camera;
  // Rendered again from the pose that the map gives, if that differs: depth and colour must belong to the image's
  // pixels.
  for (int attempt = 0; attempt < 3; ++attempt) {
    if (attempt > 0) {
      view = seen_from(map, T_world_keyframe);
      result.prefetched = false;
    }
    made = make_from(view, request, context, image, gradients);
    if (result.prefetched && !made.anchored) {
      T_world_keyframe = request.frame.T_world_camera;
      continue;
    }
    if (!made.anchored) break;
    corrected = std::max(corrected, result.prefetched ? view_flow(camera_, {made.T_world_camera_map, view.images},
                                                                  request.frame.T_world_camera)
                                                      : made.map_flow);
    T_world_keyframe = made.T_world_camera_map;
    if (made.map_flow <= anchor.render_again_flow) break;
  }
  result.patches = patches_of(view);
  if (outside_ && corrected > 0.0 && (!made.anchored || made.map_flow > anchor.render_again_flow)) {
    // The map gave a pose but did not confirm it in the view rendered from there: the camera is not back in the map.
    const double map_share = made.map_share;
    RenderedView nothing{request.frame.T_world_camera, {}};
    made = make_from(nothing, request, context, image, gradients);
    made.map_share = map_share;
    corrected = 0.0;
  } else if (made.anchored && made.keyframe != nullptr) {
    made.keyframe->T_world_camera = T_world_keyframe;
    if (made.map_share >= memory_.options().map_share) result.links = 0;
  }
  return result;
}

void KeyframeBackend::come_back(const SE3& T_correction, bool far) {
  const auto held_by_map = [](const std::shared_ptr<Keyframe>& k) {
    return !k->anchors.empty() ||
           std::any_of(k->points.begin(), k->points.end(), [](const WindowPoint& p) { return p.of_map; });
  };
  if (far) {
    for (const auto& k : window_.keyframes) memory_.forget(*k);
    std::erase_if(window_.keyframes, held_by_map);
  }
  for (const auto& k : window_.keyframes) {
    if (held_by_map(k)) continue;
    k->T_world_camera = T_correction * k->T_world_camera;
    if (k->T_world_tracked) k->T_world_tracked = T_correction * *k->T_world_tracked;
  }
  window_.prior.clear();
}

void KeyframeBackend::make_room() {
  const int drop = keyframe_to_drop(window_, camera_, options_.window);
  if (drop < 0) return;
  const std::shared_ptr<Keyframe> leaving = window_.keyframes[static_cast<std::size_t>(drop)];
  marginalize_keyframe(window_, static_cast<std::size_t>(drop), camera_, options_.optimizer, options_.marginalization);
  // These are large, and KeyframeMemory does not need them.
  leaving->gradient.release();
  leaving->immature = {};
  leaving->anchors = {};
}

KeyframeOutcome KeyframeBackend::add(const KeyframeRequest& request) {
  if (request.fresh) {
    for (const auto& k : window_.keyframes) memory_.forget(*k);
    window_.keyframes.clear();
    window_.prior.clear();
    outside_ = false;
  }
  EvenFrame image = request.frame.image;
  std::vector<GradientImage> gradients;
  auto [made, corrected, prefetched, links, patches] = make(request, image, gradients);
  KeyframeOutcome outcome;
  outcome.map_share = made.map_share;
  if (made.keyframe == nullptr) return outcome;
  if (request.to_be_confirmed && patches != nullptr) {
    outcome.evidence = patches->compare(*image.even, made.keyframe->T_world_camera);
    if (outcome.evidence.verdict != Confirmation::confirmed) return outcome;
    // By a copy: misfit_ counts the image once, at the pose that the window gives it.
    CameraMisfit tried = misfit_;
    const MisfitEffect effect =
        tried.effect(tried.add(*patches, *image.even, made.keyframe->T_world_camera, request.frame.velocity), camera_);
    if (!options_.max_misfit.allow(effect, MisfitEffect::likely_sigmas)) {
      outcome.misfit = effect;
      return outcome;
    }
  }
  outcome.made = true;
  outcome.anchored = made.anchored;
  outcome.prefetched = prefetched;
  outcome.in_map = made.in_map;
  const std::shared_ptr<Keyframe>& keyframe = made.keyframe;
  keyframe->id = request.id;
  keyframe->frame = request.frame.number;
  keyframe->time = request.frame.time;
  keyframe->T_world_tracked = keyframe->T_world_camera;
  keyframe->patches = patches;
  keyframe->in_map = made.in_map;
  const bool far = corrected > options_.keyframe.anchor.reset_flow;
  if (made.anchored && (outside_ || far))
    come_back(keyframe->T_world_camera * request.frame.T_world_camera.inverse(), far);
  if (!made.in_map) {
    outside_ = true;
  } else if (made.anchored || !made.verifiable) {
    outside_ = false;
  }
  if (!made.in_map && !made.anchored && !window_.keyframes.empty()) {
    keyframe->outside = window_.keyframes.back()->outside + 1;
  }
  {
    const StageTimer timer(stages_[stage_optimise]);
    make_room();
    window_.keyframes.push_back(keyframe);
    activate_points(window_, camera_, options_.optimizer.photometric, options_.activation);
    optimizer_.optimize(window_, camera_);
    remove_bad_points(window_, camera_);
  }
  const StageTimer timer(stages_[stage_keyframe]);
  add_projected_points(made.reference, gradients, points_seen_from(keyframe->T_world_camera),
                       options_.keyframe.reference);
  keyframe->reference = std::make_shared<TrackingReference>(std::move(made.reference));
  if (links) memory_.remember(keyframe, *links);
  if (patches != nullptr) {
    const StageTimer confirm_timer(stages_[stage_confirm]);
    outcome.evidence = patches->compare(*image.even, keyframe->T_world_camera);
    if (outcome.evidence.verdict == Confirmation::confirmed) {
      outcome.misfit =
          misfit_.effect(misfit_.add(*patches, *image.even, keyframe->T_world_camera, request.frame.velocity), camera_);
      keyframe->misfit = outcome.misfit;
    }
    outcome.likely_cause = misfit_.likely_cause(camera_);
  }
  outcome.window = references();
  return outcome;
}

void KeyframeBackend::prefetch(const SE3& T_world_camera) { prefetched_ = seen_from(map_, T_world_camera); }

RenderedView KeyframeBackend::seen_from(MapView& map, const SE3& T_world_camera) {
  const StageTimer timer(stages_[stage_render]);
  return {T_world_camera, map.render(camera_, T_world_camera, {options_.keyframe.anchor.enabled, true})};
}

Matrix6d KeyframeBackend::covariance(const Keyframe& keyframe) const {
  return keyframe.covariance + keyframe.outside * drift_covariance(options_.drift, keyframe.T_world_camera);
}

std::vector<ReferenceFrame> KeyframeBackend::references() const {
  std::vector<ReferenceFrame> references;
  for (const auto& k : window_.keyframes) {
    references.push_back(
        {k->id, k->T_world_camera, k->brightness, covariance(*k), k->reference, k->patches, k->in_map, k->misfit});
  }
  return references;
}

}  // namespace odosplat
