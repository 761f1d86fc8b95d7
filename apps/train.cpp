// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "train.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cloud_files.hpp"
#include "number_flags.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/map/interpolation_view.hpp"
#include "odosplat/splat/cloud_colors.hpp"
#include "odosplat/splat/map_file.hpp"
#include "odosplat/splat/sigma_calibration.hpp"

namespace odosplat::apps {
namespace {

/// Every Nth posed frame of some sequences, read from disk when asked for.
class SequenceViews : public TrainingViews {
 public:
  SequenceViews(const TrainJob& job) {
    const FrameRange range = job.frames.empty() ? FrameRange() : parse_frames(job.frames);
    for (const std::string& path : job.sequences) {
      sequences_.push_back(Sequence::open(path, job.sequence_options));
      for (const std::size_t frame : posed_frames(sequences_.back(), job.every, range)) {
        frames_.push_back({sequences_.size() - 1, frame});
      }
    }
  }
  int count() const override { return static_cast<int>(frames_.size()); }
  Camera camera(int i) const override { return sequence(i).camera(); }
  SE3 T_world_camera(int i) const override { return *sequence(i).T_world_camera(at(i).frame); }
  ColorImage color(int i) override { return sequence(i).color(at(i).frame); }
  DepthImage depth(int i) override {
    return sequence(i).has_depth(at(i).frame) ? sequence(i).depth(at(i).frame) : DepthImage();
  }

 private:
  struct Place {
    std::size_t sequence;
    std::size_t frame;
  };
  const Place& at(int i) const { return frames_[static_cast<std::size_t>(i)]; }
  const Sequence& sequence(int i) const { return sequences_[at(i).sequence]; }

  std::vector<Sequence> sequences_;
  std::vector<Place> frames_;
};

TrainerOptions trainer_options(const TrainJob& job, int views) {
  TrainerOptions options = TrainerOptions::preset(job.preset, views);
  if (job.iterations >= 0) options.iterations = job.iterations;
  options.seed = job.seed;
  if (!job.densify.empty()) options.densify.method = densify_method(job.densify);
  if (job.budget > 0) options.densify.budget = job.budget;
  if (job.exposure == "on") options.exposure.rate = 1e-3;
  if (job.exposure == "off") options.exposure.rate = 0.0;
  if (job.depth_weight >= 0.0) options.depth.weight = job.depth_weight;
  if (is_splat_path(job.out)) options.rasterizer.order = BlendOrder::depth;
  if (!job.blend_order.empty()) options.rasterizer.order = blend_order(job.blend_order);
  return options;
}

InitializeOptions initialize_options(const TrainJob& job) {
  InitializeOptions options = InitializeOptions::preset(job.preset);
  options.budget = job.budget;
  options.seed = job.seed;
  if (job.sh_degree >= 0) options.sh_degree = job.sh_degree;
  return options;
}

std::string progress_text(const TrainingStep& step, const TrainingReport& report) {
  char text[160];
  std::snprintf(text, sizeof(text), "loss %.4f  PSNR %.2f dB  %zu Gaussians  %.1f it/s", step.value.loss,
                step.value.psnr_db(), report.gaussians, report.iterations_per_second);
  return text;
}

void write_report(const TrainJob& job, const TrainingReport& report, const compute::Context& device) {
  if (job.report.empty()) return;
  nlohmann::ordered_json json{{"iterations", report.iterations},
                              {"gaussians", report.gaussians},
                              {"seconds", report.seconds},
                              {"iterations_per_second", report.iterations_per_second},
                              {"psnr_db", report.psnr_db},
                              {"peak_memory_mb", peak_memory_mb()},
                              {"preset", job.preset},
                              {"seed", job.seed},
                              {"device", device.device().name},
                              {"version", ODOSPLAT_VERSION}};
  if (device.profiling()) {
    nlohmann::ordered_json& stages = json["stages_ms"];  // a step, not the whole run
    for (const compute::StageTime& stage : device.stage_times())
      stages[stage.stage] = stage.milliseconds / std::max(1, report.iterations);
  }
  write_file_atomically(job.report, json.dump(2) + "\n");
}

std::string checkpoint_file(const TrainJob& job) { return job.out + ".checkpoint"; }

/// Goes on from the last checkpoint where one is wanted and there is one.
void take_up(const TrainJob& job, Trainer& trainer) {
  const std::string file = checkpoint_file(job);
  if (!job.resume) return;
  if (!std::filesystem::exists(file)) {
    log_info("no checkpoint " + file + ": training starts at the beginning");
    return;
  }
  try {
    trainer.resume(Checkpoint::read(file));
  } catch (const InputError& e) {
    // Errors of the state itself do not know the file.
    throw std::string(e.what()).starts_with(file) ? e : InputError(file, e.what());
  }
  log_info("going on from iteration " + std::to_string(trainer.iteration()) + " of " + file);
}

/// Steps until all are done or Ctrl-C, with checkpoints.
void run(const TrainJob& job, Trainer& trainer) {
  Progress progress("train", trainer.options().iterations);
  while (!trainer.done() && !interrupted()) {
    const TrainingStep step = trainer.step();
    progress.update(step.iteration, progress_text(step, trainer.report()));
    if (job.checkpoint_every > 0 && step.iteration % job.checkpoint_every == 0 && !trainer.done())
      trainer.checkpoint().write(checkpoint_file(job));
  }
  progress.finish();
  if (!trainer.done()) {
    trainer.checkpoint().write(checkpoint_file(job));
    log_info("stopped after iteration " + std::to_string(trainer.iteration()) + "; --resume goes on from " +
             checkpoint_file(job));
  }
}

/// The map with its settings, where its images were taken, and how sure its depth is.
void write_result(const TrainJob& job, const compute::Context& device, const Trainer& trainer, TrainingViews& views,
                  MapView* surface, double shared_sigma) {
  const Gaussians gaussians = trainer.gaussians();
  std::vector<std::string> notes = trainer.options().describe();
  std::vector<SE3> poses;
  for (int i = 0; i < views.count(); ++i) poses.push_back(views.T_world_camera(i));
  for (const std::string& line : place_lines(thinned_places(poses))) notes.push_back(line);
  if (surface != nullptr) {
    SigmaCalibrationOptions options;
    options.rasterizer = trainer.options().rasterizer;
    options.shared_sigma = shared_sigma;
    for (const std::string& line : calibrated_sigma(device, gaussians, views, *surface, options).to_lines())
      notes.push_back(line);
  }
  write_map(job.out, gaussians, notes);
}

}  // namespace

TrainingReport train_map(const Common& common, const TrainJob& job) {
  const InitializeOptions initial = initialize_options(job);
  ensure_output_file(job.out);
  if (!job.report.empty()) ensure_output_file(job.report);
  SequenceViews views(job);
  const TrainerOptions options = trainer_options(job, views.count());
  PointCloud cloud = read_cloud(job.cloud, job.voxel, job.remove_outliers);
  if (!cloud.has_colors()) color_from_views(cloud, views);
  const compute::Context device = open_device(common);
  const Gaussians start = gaussians_from_cloud(cloud, initial);
  std::unique_ptr<InterpolationView> surface;
  double shared_sigma = 0.0;
  if (initial.shape == InitialShape::discs) {
    const PointCloud smoothed = smoothed_cloud(cloud, initial);
    surface = std::make_unique<InterpolationView>(smoothed);
    shared_sigma = noise_left(cloud, smoothed, initial);
  }
  log_info("training " + std::to_string(start.size()) + " Gaussians on " + std::to_string(views.count()) + " images");
  Trainer trainer(device, options, start, views, surface.get());
  take_up(job, trainer);
  run(job, trainer);
  const TrainingReport report = trainer.report();
  // After Ctrl-C nobody wants to wait for the calibration.
  write_result(job, device, trainer, views, trainer.done() ? surface.get() : nullptr, shared_sigma);
  if (trainer.done()) std::filesystem::remove(checkpoint_file(job));
  write_report(job, report, device);
  print_profile(common, device);
  if (!trainer.done()) throw Interrupted();
  return report;
}

void add_train(CLI::App& app, Common& common) {
  CLI::App* command = add_command(app, common, "train", "train a map of Gaussians from a cloud and posed images");
  auto job = std::make_shared<TrainJob>();
  command->add_option("SEQ", job->sequences, "sequences in one world frame")->required();
  command->add_option("--layout", job->sequence_options.layout, "layout of the sequences (default: detected)");
  command->add_option("--camera", job->sequence_options.camera_file, "camera.yaml to use instead of their own");
  command->add_option("--cloud", job->cloud, cloud_formats)->required();
  add_number(command, "--voxel", job->voxel, {.least = 0.0, .most = 1000.0, .word = "off"},
             "thin the cloud to one point per voxel of this edge [m]; 0 or off: as it is");
  command->add_flag("--remove-outliers", job->remove_outliers, outliers_help);
  command->add_option("--out", job->out, "map to write (PLY, or .splat)")->required();
  add_number(command, "--every", job->every, {.least = 1}, "train on every Nth frame");
  command->add_option("--frames", job->frames, frames_help);
  command->add_option("--preset", job->preset, "default, or paper (the recipe of the paper's code)");
  add_number(command, "--iterations", job->iterations, {.least = 0, .most = 100000000, .word = "preset", .meaning = -1},
             "steps of one image each (preset default: 4000, and at least 8 per image; paper: 20000)");
  add_number(command, "--budget", job->budget, {.least = 0, .most = 1000000000, .word = "preset"},
             "most Gaussians: of the cloud's points, and that densification grows to; 0 or preset: one per point, and "
             "the preset's limit of growth (default: 150000, paper: none)");
  command->add_option(
      "--densify", job->densify,
      "none, relocate (the dead move to where the images need them, and grow to the budget) or split (clone "
      "and split by screen gradient) (default: the preset's)");
  command
      ->add_option("--exposure", job->exposure, "learn the exposure of each image: on or off (default: the preset's)")
      ->check(CLI::IsMember({"on", "off"}));
  add_number(command, "--depth-weight", job->depth_weight,
             {.least = 0.0, .most = 1e6, .word = "preset", .meaning = -1.0},
             "weight of the cloud's depth beside the images");
  add_number(command, "--sh-degree", job->sh_degree, {.least = 0, .most = 3, .word = "preset", .meaning = -1},
             "degree of the colours' spherical harmonics, 0 to 3");
  command
      ->add_option("--blend-order", job->blend_order,
                   "what Gaussians are sorted by when they are blended: distance from the camera, which makes better "
                   "maps, or depth, which other programs expect (default: the preset's, depth for a .splat)")
      ->check(CLI::IsMember({"distance", "depth"}));
  add_number(command, "--checkpoint-every", job->checkpoint_every, {.least = 0, .word = "never"},
             "iterations between checkpoints (OUT.checkpoint, removed at the end); 0 or never: only on Ctrl-C");
  command->add_flag("--resume", job->resume,
                    "go on from OUT.checkpoint if there is one: the same bits as without a stop");
  add_number(command, "--seed", job->seed, {}, "seed of every random choice");
  command->add_option("--report", job->report, "report to write (JSON)");
  command->final_callback([&common, job] {
    const TrainingReport report = train_map(common, *job);
    print("%s: %zu Gaussians, %d iterations in %s (%.1f it/s), PSNR %.2f dB on the training images\n", job->out.c_str(),
          report.gaussians, report.iterations, format_duration(report.seconds).c_str(), report.iterations_per_second,
          report.psnr_db);
  });
}

}  // namespace odosplat::apps
