// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/map_training.hpp"

#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/splat/map_places.hpp"
#include "odosplat/splat/quality/cloud_colors.hpp"
#include "odosplat/splat/quality/sigma_calibration.hpp"

namespace odosplat {
namespace {

void notify(const StageNotice& stage, const std::string& name) {
  if (stage) stage(name);
}

void require_seen(const std::string& name, const PointCloud& cloud, const TrainingViews& views) {
  if (any_in_view(cloud, views)) return;
  const bool inverted = any_in_view(cloud, views, true);
  throw InputError(name, std::string("no image sees any of its points: ") +
                             (inverted ? "the poses are inverted, or not in the cloud's frame"
                                       : "poses and cloud are in different frames, or not both in metres"));
}

}  // namespace

TrainingStart prepare_training(PointCloud cloud, const std::string& name, const InitializeOptions& options,
                               TrainingViews& views, const StageNotice& stage) {
  TrainingStart start;
  start.cloud = std::move(cloud);
  require_seen(name, start.cloud, views);
  notify(stage, "comparing the images at the cloud's points");
  const ColorConsistency consistency(start.cloud, views);
  constexpr std::size_t least_points = 200;  // in common: with fewer there is no result
  const ColorConsistency::Value given = consistency.of({});
  start.consistency = given.points >= least_points ? given.unexplained : -1.0;
  start.doubt = geometry_doubt(consistency);
  notify(stage, "how much of the cloud the images see");
  start.coverage = cloud_coverage(start.cloud, views);
  notify(stage, "colouring the cloud");
  if (!start.cloud.has_colors()) color_from_views(start.cloud, views);
  notify(stage, "shaping " + std::to_string(start.cloud.size()) + " Gaussians");
  start.gaussians = gaussians_from_cloud(start.cloud, options);
  if (options.shape != InitialShape::discs) return start;
  notify(stage, "smoothing the cloud");
  const PointCloud smoothed = smoothed_cloud(start.cloud, options);
  notify(stage, "interpolating the cloud's surface");
  start.surface = std::make_unique<InterpolationView>(smoothed);
  start.shared_sigma = noise_left(start.cloud, smoothed, options);
  return start;
}

TrainedMap finish_training(const compute::Context& context, const Trainer& trainer, const TrainingStart& start,
                           TrainingViews& views, const TrainingFacts& facts, const StageNotice& stage) {
  TrainedMap made;
  made.training = trainer.report();
  made.map.gaussians = trainer.gaussians();
  const Gaussians& gaussians = made.map.gaussians;
  notify(stage, "comparing the map with its images");
  made.views =
      view_qualities(context, gaussians, views, start.surface.get(), trainer.exposures(), trainer.options().rasterizer);
  const TrainingEvidence evidence{trainer.iteration(), facts.usual_iterations, gaussians.size(), start.cloud.size(),
                                  facts.budget};
  const MapQuality quality = judge_map(made.views, start.coverage, start.consistency, start.doubt, evidence);

  std::vector<std::string> notes = trainer.options().describe();
  const auto add = [&notes](const std::vector<std::string>& lines) {
    notes.insert(notes.end(), lines.begin(), lines.end());
  };
  notes.push_back("iterations_done " + std::to_string(trainer.iteration()));
  add(quality.to_lines());
  std::vector<SE3> poses;
  poses.reserve(static_cast<std::size_t>(views.count()));
  for (int i = 0; i < views.count(); ++i) poses.push_back(views.T_world_camera(i));
  add(place_lines(thinned_places(poses)));
  add(facts.notes);
  if (start.surface != nullptr) {
    notify(stage, "calibrating the uncertainty of the map's depth");
    SigmaCalibrationOptions options;
    options.rasterizer = trainer.options().rasterizer;
    options.shared_sigma = start.shared_sigma;
    add(calibrated_sigma(context, gaussians, views, *start.surface, options).to_lines());
  }
  made.map.header = MapHeader::from_notes(std::move(notes));
  made.map.header.quality = quality;  // unrounded
  return made;
}

TrainedMap train_map(const compute::Context& context, PointCloud cloud, TrainingViews& views,
                     const std::string& preset) {
  return train_map(context, std::move(cloud), views, InitializeOptions::preset(preset),
                   TrainerOptions::preset(preset, views.count()));
}

TrainedMap train_map(const compute::Context& context, PointCloud cloud, TrainingViews& views,
                     const InitializeOptions& initial, const TrainerOptions& options) {
  initial.check();
  options.check();
  const TrainingStart start = prepare_training(std::move(cloud), "cloud", initial, views);
  Trainer trainer(context, options, start.gaussians, views, start.surface.get());
  while (!trainer.done()) trainer.step();
  return finish_training(context, trainer, start, views, {options.iterations, initial.budget, {}});
}

}  // namespace odosplat
