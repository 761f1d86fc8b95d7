// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/view/view_figures.hpp"

#include "odosplat/core/error.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"

namespace odosplat::apps {

SE3 pose_of_frame(const Sequence& sequence, std::size_t frame, const std::string& flag) {
  if (frame >= sequence.size()) {
    throw InputError(flag, "is " + std::to_string(frame) + ", the sequence has " + std::to_string(sequence.size()));
  }
  if (!sequence.T_world_camera(frame)) throw InputError(flag, std::to_string(frame) + " has no pose");
  return *sequence.T_world_camera(frame);
}

ComparedViews open_compared_views(const Common& common, const MapFlags& flags) {
  return {open_view(common, "interpolation", flags), open_view(common, "gaussian", flags)};
}

CompareExample compare_example(ComparedViews& views, const Sequence& sequence, std::size_t frame,
                               const std::string& name) {
  const SE3 T_world_camera = pose_of_frame(sequence, frame);
  CompareExample example;
  example.name = name;
  example.image = sequence.color(frame);
  example.methods = {{"interpolated", views.interpolation.view->render(sequence.camera(), T_world_camera, {}).depth},
                     {"rendered", views.gaussian.view->render(sequence.camera(), T_world_camera, {}).depth}};
  if (sequence.has_depth(frame)) example.truth = sequence.depth(frame);
  return example;
}

AssociationFigure association_figure(ComparedViews& views, const Sequence& sequence, std::size_t frame,
                                     const MapFlags& flags) {
  AssociationFigure figure;
  figure.camera = sequence.camera();
  figure.T_world_camera = pose_of_frame(sequence, frame);
  figure.cloud = read_point_cloud(flags.cloud);
  figure.interpolated = views.interpolation.view->render(figure.camera, figure.T_world_camera, {}).depth;
  figure.rendered = views.gaussian.view->render(figure.camera, figure.T_world_camera, {}).depth;
  figure.image = sequence.color(frame);
  return figure;
}

}  // namespace odosplat::apps
