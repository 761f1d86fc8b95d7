// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/splat/raster/device_gaussians.hpp"
#include "odosplat/splat/train/checkpoint.hpp"
#include "odosplat/splat/train/trainer_options.hpp"
#include "odosplat/splat/train/training_guard.hpp"
#include "odosplat/splat/train/training_targets.hpp"

namespace odosplat {

/// One step: which view it saw, at which image level, and the loss before the step.
struct TrainingStep {
  int iteration = 0;  // 1 for the first
  int view = 0;
  int level = 0;
  LossValue value;           // of the image
  double depth_error = 0.0;  // weighted mean relative difference to the surface (DepthLoss), 0 without
};

struct TrainingReport {
  int iterations = 0;
  std::size_t gaussians = 0;
  double seconds = 0.0;  // spent in step(), of a resumed run in all its parts
  double iterations_per_second = 0.0;
  double psnr_db = 0.0;      // mean over the last round of views at full size (each as it was before its own step)
  double depth_error = 0.0;  // likewise of TrainingStep::depth_error
  int undone = 0;            // how often training collapsed (TrainingGuard) and was taken back to its best state
};

/// Fits Gaussians to posed images and to the surface they were made from: render, losses, gradients, Adam, one image
/// per step. Source: Kerbl et al. 2023, sections 5 and 7; order of views: a new seeded shuffle every round, each view
/// once.
/// Differs: the default preset starts with the Gaussians of a cloud, which are on the surface already; it splits and
/// clones up to a budget and prunes, but never resets opacities. Accurate depth has priority over the last decibel of
/// PSNR: Gaussians move little, keep their planes and their thickness, rendered depth is tied to the surface's, and all
/// rates fall, so that the result does not depend on the last views seen.
/// Frames: Gaussians and poses in one world frame [m]. Same seed, input and device: the same bits, whatever the
/// threads, and whether the run was stopped and resumed. If the PSNR collapses (TrainingGuard), training goes back to
/// its best state and on from there without densification; if it collapses without densification, it ends with its best
/// state; a warning on the log says so. The guard waits for half a reset interval after an opacity reset, which lowers
/// the PSNR on purpose. Throws InputError for bad options, no Gaussians, no views, an image of another size than its
/// camera or with values that are not finite; compute::DeviceError from the device. A run can be left after any step:
/// gaussians() is complete then. Blocks. Not thread safe.
class Trainer {
 public:
  /// views and surface must outlive the trainer. surface: what depth is trained on, in the frame of the Gaussians (the
  /// cloud's InterpolationView); null: no depth term. Surface terms take the third axis of `initial` as its normal.
  Trainer(const compute::Context& context, const TrainerOptions& options, const Gaussians& initial,
          TrainingViews& views, MapView* surface = nullptr);

  /// True when all iterations are done, or training has ended early (TrainingGuard); step() then does nothing more and
  /// returns the last step.
  bool done() const { return ended_early_ || iteration_ >= options_.iterations; }
  TrainingStep step();
  /// The exposures that were trained with the map.
  const Exposures& exposures() const { return exposures_; }
  /// The Gaussians at the current step.
  Gaussians gaussians() const { return gaussians_.download(); }
  TrainingReport report() const;
  const TrainerOptions& options() const { return options_; }
  int iteration() const { return iteration_; }

  /// All of the run's state, to go on from here, in this or another process.
  Checkpoint checkpoint() const;
  /// Continues the run of a checkpoint of a trainer with the same options, views and start. InputError naming what
  /// differs, or what is no valid state of a run.
  void resume(const Checkpoint& checkpoint);

 private:
  Checkpoint state() const;
  void set_state(const Checkpoint& state);
  void guard();
  int level_at(int iteration) const;
  int view_at(int iteration);
  bool with_depth() const { return targets_.has_depth() && options_.depth.weight > 0.0; }
  void update();
  bool densifies() const;
  void densify();
  void reset_opacities();
  std::vector<Adam*> optimisers();
  std::string fingerprint() const;

  TrainerOptions options_;
  compute::Context context_;
  TrainingViews& views_;
  TrainingTargets targets_;
  DeviceGaussians gaussians_, gradients_;
  Rasterizer rasterizer_;
  ImageLoss loss_;
  DepthLoss depth_loss_;
  SurfaceTerms surface_terms_;
  Exposures exposures_;
  Adam positions_, log_scales_, rotations_, opacity_logits_, sh_;
  compute::Kernel screen_statistics_;
  double position_length_ = 1.0;  // [m]
  DensifySizes densify_sizes_;
  std::string start_;  // checksum of Gaussians and views at the start

  RenderOutput rendered_;
  OutputGradients image_gradients_;
  compute::Buffer<float> exposed_;
  compute::Buffer<float> largest_log_scales_;  // empty: no limit
  compute::Buffer<float> anchors_;             // empty: no surface terms
  compute::Buffer<float> pulls_, seen_;        // sums since the last densification; empty: not gathered

  int iteration_ = 0;
  int round_ = -1;
  std::vector<int> order_;  // views of the current round
  // Last values of every view at full size; negative: none yet.
  std::vector<double> psnr_db_, depth_errors_;
  TrainingStep last_;
  double seconds_ = 0.0;

  TrainingGuard guard_;
  Checkpoint best_;  // state() at the guard's best; empty: none yet
  int undone_ = 0;
  bool ended_early_ = false;
};

}  // namespace odosplat
