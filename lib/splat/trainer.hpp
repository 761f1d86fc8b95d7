// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "odosplat/core/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/splat/adam.hpp"
#include "odosplat/splat/device_gaussians.hpp"
#include "odosplat/splat/losses.hpp"
#include "odosplat/splat/rasterizer.hpp"

namespace odosplat {

/// The posed images that a map is trained on. Images are asked for one at a time, again in every round, so that an
/// implementation may read them from disk and keep none.
class TrainingViews {
 public:
  virtual ~TrainingViews() = default;

  virtual int count() const = 0;
  /// Camera of view i, 0 <= i < count(). Views may differ in size.
  virtual Camera camera(int i) const = 0;
  virtual SE3 T_world_camera(int i) const = 0;
  /// Image of view i, as large as its camera says, values 0..1.
  virtual ColorImage color(int i) = 0;
};

/// What lengths of position steps are measured in.
enum class PositionLength {
  gaussian_size,  // median size (longest standard deviation) of the Gaussians at the start
  camera_extent   // largest distance of a camera from the cameras' mean (Kerbl et al. 2023)
};

struct TrainerOptions {
  int iterations = 2000;  // steps, one image each, >= 0
  std::uint64_t seed = 42;
  int coarse_levels = 1;      // image levels, each half the size, that training starts on, 0..4; 0: full size only
  float coarse_share = 0.2F;  // share of the iterations on levels above 0, split evenly, 0..1
  int sh_interval = 400;      // steps from one degree of spherical harmonics to the next, >= 0; 0: all from the start

  PositionLength position_length = PositionLength::gaussian_size;
  // Adam rates a step at the start. Those not given in units are of the attribute as it is stored.
  double position_rate = 2e-3;        // [position lengths]
  double position_rate_final = 2e-5;  // [position lengths] reached log-linearly at the last step
  double scale_rate = 5e-3;           // of log scales
  double rotation_rate = 0.0;         // of quaternions; discs that tilt lift depth towards the camera
  double opacity_rate = 2e-2;         // of opacity logits
  double color_rate = 1e-2;           // of SH of degree 0
  double sh_rate = 5e-4;              // of the other SH
  double final_share = 0.1;           // all rates but that of positions fall log-linearly to this share of theirs, 0..1
  bool keep_thickness = true;         // the third axis (of discs: across the surface) is left as it is

  double largest_growth = 1.5;  // no axis grows beyond this many times its start (silhouettes), >= 1; 0: no limit

  LossOptions loss;
  AdamOptions adam;
  RasterizerOptions rasterizer;

  /// "default": depth is kept while colours are learnt. "paper": the public recipe of the paper's code (rates of
  /// GS-DSO's fork of OpenSplat, 20 000 steps, levels /4, /2, 1, no decay but of positions). Throws InputError else.
  static TrainerOptions preset(const std::string& name);
  /// Throws InputError naming the field.
  void check() const;
  /// One line "name value" a setting, for the header of the map.
  std::vector<std::string> describe() const;
};

/// One step: which view it saw, at which image level, and the loss before the step.
struct TrainingStep {
  int iteration = 0;  // 1 for the first
  int view = 0;
  int level = 0;
  LossValue value;
};

struct TrainingReport {
  int iterations = 0;
  std::size_t gaussians = 0;
  double seconds = 0.0;  // spent in step()
  double iterations_per_second = 0.0;
  double psnr_db = 0.0;  // mean over the last round of views at full size (each as it was before its own step)
};

/// Fits Gaussians to posed images: render, loss, gradients, Adam, one image a step.
/// Source: Kerbl et al. 2023, sections 5 and 7; order of views: a new seeded shuffle every round, each view once.
/// Differs: the default preset never clones, splits, prunes or resets: the Gaussians are those of a cloud, on the
/// surface already, and depth is worth more than the last decibel. They move little, keep their planes and their
/// thickness, and all rates fall, so that the result does not hang on the last views seen. Frames: Gaussians and poses
/// in one world frame [m]. Same seed, input and device: the same bits, whatever the threads. Throws InputError for bad
/// options, no Gaussians, no views, an image of another size than its camera or with values that are not finite;
/// compute::DeviceError from the device. A run can be left after any step: gaussians() is complete then. Blocks. Not
/// thread safe.
class Trainer {
 public:
  /// views must outlive the trainer.
  Trainer(const compute::Context& context, const TrainerOptions& options, const Gaussians& initial,
          TrainingViews& views);

  /// True when all iterations are done; step() then does nothing more and returns the last step.
  bool done() const { return iteration_ >= options_.iterations; }
  TrainingStep step();
  /// The Gaussians as they are now.
  Gaussians gaussians() const { return gaussians_.download(); }
  TrainingReport report() const;
  const TrainerOptions& options() const { return options_; }

 private:
  int level_at(int iteration) const;
  int view_at(int iteration);
  void load_target(int view, int level);
  void update();

  TrainerOptions options_;
  compute::Context context_;
  TrainingViews& views_;
  DeviceGaussians gaussians_, gradients_;
  Rasterizer rasterizer_;
  ImageLoss loss_;
  Adam positions_, log_scales_, rotations_, opacity_logits_, sh_;
  double position_length_ = 1.0;  // [m]

  RenderOutput rendered_;
  OutputGradients image_gradients_;
  compute::Buffer<float> largest_log_scales_;  // empty: no limit
  compute::Buffer<float> target_;
  std::vector<float> planes_;
  Camera camera_;  // of the target

  int iteration_ = 0;
  int round_ = -1;
  std::vector<int> order_;       // views of the present round
  std::vector<double> psnr_db_;  // last value of every view at full size
  std::vector<bool> psnr_known_;
  TrainingStep last_;
  double seconds_ = 0.0;
};

}  // namespace odosplat
