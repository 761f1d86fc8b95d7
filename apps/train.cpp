// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "train.hpp"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "cloud_files.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/splat/map_file.hpp"

namespace odosplat::apps {
namespace {

/// Every Nth posed frame of some sequences, read from disk when asked for.
class SequenceViews : public TrainingViews {
 public:
  SequenceViews(const TrainJob& job) {
    for (const std::string& path : job.sequences) {
      sequences_.push_back(Sequence::open(path, job.sequence_options));
      for (const std::size_t frame : posed_frames(sequences_.back(), job.every)) {
        frames_.push_back({sequences_.size() - 1, frame});
      }
    }
  }
  int count() const override { return static_cast<int>(frames_.size()); }
  Camera camera(int i) const override { return sequence(i).camera(); }
  SE3 T_world_camera(int i) const override { return *sequence(i).T_world_camera(at(i).frame); }
  ColorImage color(int i) override { return sequence(i).color(at(i).frame); }

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

TrainerOptions trainer_options(const TrainJob& job) {
  TrainerOptions options = TrainerOptions::preset(job.preset);
  if (job.iterations >= 0) options.iterations = job.iterations;
  options.seed = job.seed;
  return options;
}

InitializeOptions initialize_options(const TrainJob& job) {
  InitializeOptions options = InitializeOptions::preset(job.preset);
  options.budget = job.budget;
  options.seed = job.seed;
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
  const nlohmann::ordered_json json{{"iterations", report.iterations},
                                    {"gaussians", report.gaussians},
                                    {"seconds", report.seconds},
                                    {"iterations_per_second", report.iterations_per_second},
                                    {"psnr_db", report.psnr_db},
                                    {"peak_memory_mb", peak_memory_mb()},
                                    {"preset", job.preset},
                                    {"seed", job.seed},
                                    {"device", device.device().name},
                                    {"version", ODOSPLAT_VERSION}};
  write_file_atomically(job.report, json.dump(2) + "\n");
}

}  // namespace

TrainingReport train_map(const Common& common, const TrainJob& job) {
  const TrainerOptions options = trainer_options(job);
  const InitializeOptions initial = initialize_options(job);
  ensure_output_file(job.out);
  if (!job.report.empty()) ensure_output_file(job.report);
  SequenceViews views(job);
  const PointCloud cloud = read_cloud(job.cloud, job.voxel, job.remove_outliers);
  const compute::Context device = open_device(common);
  const Gaussians start = gaussians_from_cloud(cloud, initial);
  log_info("training " + std::to_string(start.size()) + " Gaussians on " + std::to_string(views.count()) + " images");
  Trainer trainer(device, options, start, views);
  Progress progress("train", options.iterations);
  while (!trainer.done() && !interrupted()) {
    const TrainingStep step = trainer.step();
    progress.update(step.iteration, progress_text(step, trainer.report()));
  }
  progress.finish();
  const TrainingReport report = trainer.report();
  write_map(job.out, trainer.gaussians(), trainer.options().describe());
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
  command->add_option("--voxel", job->voxel, "thin the cloud to one point a voxel of this edge [m], 0 = as it is");
  command->add_flag("--remove-outliers", job->remove_outliers, outliers_help);
  command->add_option("--out", job->out, "map to write (PLY, or .splat)")->required();
  command->add_option("--every", job->every, "train on every Nth frame")->check(CLI::PositiveNumber);
  command->add_option("--preset", job->preset, "default, or paper (the recipe of the paper's code)");
  command->add_option("--iterations", job->iterations, "steps of one image each (default: the preset's)");
  command->add_option("--budget", job->budget, "most Gaussians, 0 = one a point");
  command->add_option("--seed", job->seed, "seed of every random choice");
  command->add_option("--report", job->report, "report to write (JSON)");
  command->final_callback([&common, job] {
    const TrainingReport report = train_map(common, *job);
    std::printf("%s: %zu Gaussians, %d iterations in %s (%.1f it/s), PSNR %.2f dB on the training images\n",
                job->out.c_str(), report.gaussians, report.iterations, format_duration(report.seconds).c_str(),
                report.iterations_per_second, report.psnr_db);
  });
}

}  // namespace odosplat::apps
