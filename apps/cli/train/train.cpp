// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/train/train.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/cli/map_quality_json.hpp"
#include "apps/cli/train/stages.hpp"
#include "apps/cli/train/train_views.hpp"
#include "apps/command/interrupt.hpp"
#include "apps/command/json_text.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/input/cloud_files.hpp"
#include "apps/input/map_formats.hpp"
#include "apps/input/sequence_flags.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/splat/map_file.hpp"
#include "odosplat/splat/map_training.hpp"

namespace odosplat::apps {
namespace {

std::string progress_text(const TrainingStep& step, const TrainingReport& report) {
  // The report's mean over images: the PSNR of a single image depends on its brightness. 0: no image has been seen at
  // full size yet.
  const std::string psnr = report.psnr_db > 0.0 ? formatted("%.2f dB", report.psnr_db) : "-";
  return formatted("loss %.4f  PSNR %s  %zu Gaussians  %.1f it/s", step.value.loss, psnr.c_str(), report.gaussians,
                   report.iterations_per_second);
}

std::string checkpoint_file(const TrainJob& job) { return job.out + ".checkpoint"; }

/// Resumes from the last checkpoint if --resume is given and there is one. Without --resume an existing checkpoint is
/// renamed, not overwritten.
void take_up(const TrainJob& job, Trainer& trainer) {
  const std::string file = checkpoint_file(job);
  const bool there = std::filesystem::is_regular_file(file);
  if (!job.resume) {
    if (!there) return;
    std::filesystem::rename(file, file + ".old");
    log_warning("the checkpoint of an earlier run, which --resume would go on from, is kept as " + file + ".old");
    return;
  }
  if (!there) {
    log_info("no checkpoint " + file + ": training starts at the beginning");
    return;
  }
  try {
    trainer.resume(Checkpoint::read(file));
  } catch (const InputError& e) {
    // Errors about the checkpoint's content do not name the file: it is added.
    throw std::string(e.what()).starts_with(file) ? e : InputError(file, e.what());
  }
  log_info("going on from iteration " + std::to_string(trainer.iteration()) + " of " + file);
}

/// Writes a checkpoint. A failure is only a warning: training continues, and the next checkpoint may succeed.
bool save(const TrainJob& job, const Trainer& trainer) {
  try {
    trainer.checkpoint().write(checkpoint_file(job));
    return true;
  } catch (const InputError& e) {
    log_warning("no checkpoint after iteration " + std::to_string(trainer.iteration()) + ": " + e.what());
    return false;
  }
}

/// Runs all remaining steps and writes checkpoints. After Ctrl-C it writes a checkpoint and throws Interrupted.
void run(const TrainJob& job, Trainer& trainer) {
  const SavesWhenInterrupted saves;
  Progress progress("train", trainer.options().iterations);
  while (!trainer.done() && !interrupted()) {
    const TrainingStep step = trainer.step();
    progress.update(step.iteration, progress_text(step, trainer.report()));
    if (job.checkpoint_every > 0 && step.iteration % job.checkpoint_every == 0 && !trainer.done()) save(job, trainer);
  }
  progress.finish();
  if (trainer.done()) return;
  if (save(job, trainer))
    log_info("stopped after iteration " + std::to_string(trainer.iteration()) + "; --resume goes on from " +
             checkpoint_file(job) + "; no map is written");
  throw Interrupted();
}

nlohmann::ordered_json json_of_views(const std::vector<ViewQuality>& qualities, const SequenceViews& views) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < qualities.size(); ++k) {
    const ViewQuality& q = qualities[k];
    const int view = static_cast<int>(k);
    nlohmann::ordered_json row{{"sequence", views.sequence_name(view)},
                               {"frame", views.frame(view)},
                               {"psnr_db", q.psnr_db},
                               {"depth_error_m", nullptr},
                               {"covered", q.covered},
                               {"disagrees", q.odd}};
    if (q.depth_error_m >= 0.0) row["depth_error_m"] = q.depth_error_m;
    rows.push_back(std::move(row));
  }
  return rows;
}

void write_report(const TrainJob& job, const TrainedMap& made, const SequenceViews& views,
                  const compute::Context& device) {
  if (job.report.empty()) return;
  const TrainingReport& report = made.training;
  const MapQuality& quality = *made.map.header.quality;
  nlohmann::ordered_json json{{"iterations", report.iterations},
                              {"gaussians", report.gaussians},
                              {"seconds", report.seconds},
                              {"iterations_per_second", report.iterations_per_second},
                              {"psnr_db", report.iterations > 0 ? report.psnr_db : quality.psnr_db},
                              {"undone", report.undone},
                              {"peak_memory_mb", peak_memory_mb()},
                              {"preset", job.preset},
                              {"seed", job.seed},
                              {"device", device.device().name},
                              {"version", ODOSPLAT_VERSION},
                              {"quality", json_of(quality)},
                              {"images", json_of_views(made.views, views)}};
  for (const auto& [name, value] : job.options.items()) json["options"][name] = std::stod(value);
  if (device.profiling()) {
    nlohmann::ordered_json& stages = json["stages_ms"];  // mean per step
    for (const compute::StageTime& stage : device.stage_times())
      stages[stage.stage] = stage.milliseconds / std::max(1, report.iterations);
  }
  write_file_atomically(job.report, json_text(json));
}

/// Logs the names of a few of the images that disagree with the others.
void name_odd_images(const std::vector<ViewQuality>& qualities, const SequenceViews& views) {
  constexpr int most = 5;
  std::string names;
  int count = 0;
  for (std::size_t k = 0; k < qualities.size(); ++k) {
    if (!qualities[k].odd || ++count > most) continue;
    const int view = static_cast<int>(k);
    names += (names.empty() ? "" : ", ") + views.sequence_name(view) + " " + std::to_string(views.frame(view));
  }
  if (count > 0)
    log_warning("images that disagree with the rest (wrong poses, or things that moved): frames " + names +
                (count > most ? ", ... (" + std::to_string(count) + ")" : ""));
}

TrainingStart prepare(const TrainJob& job, const InitializeOptions& initial, SequenceViews& views) {
  Stages stages("prepare", 7);
  stages.next("reading the cloud");
  TrainingStart prepared = prepare_training(read_cloud(job.cloud, job.voxel, job.remove_outliers), job.cloud, initial,
                                            views, [&stages](const std::string& name) { stages.next(name); });
  if (prepared.doubt) {
    log_warning("the images disagree on the colours of the cloud's points: likely cause: " +
                prepared.doubt->hypothesis.words() +
                formatted(" (%.0f %% of the variance is left unexplained, instead of %.0f %%)",
                          100.0 * prepared.doubt->as_given, 100.0 * prepared.doubt->instead));
  }
  return prepared;
}

}  // namespace

TrainOutcome run_training(const Common& common, const TrainJob& job) {
  const InitializeOptions initial = initialize_options(job);
  initial.check();
  check_extension(job.out, map_extensions);
  const MadeFolders made = ensure_output_file(job.out);
  const MadeFolders made_for_report = ensure_output_if_given(job.report);
  std::vector<Sequence> sequences;
  for (const std::string& path : job.sequences) sequences.push_back(open_sequence(path, job.sequence_options));
  SequenceViews views(std::move(sequences), job.every, job.frames.empty() ? FrameRange() : parse_frames(job.frames));
  const TrainerOptions options = trainer_options(job, views.count());
  options.check();
  const TrainingStart prepared = prepare(job, initial, views);
  const compute::Context device = open_device(common);
  log_info("training " + std::to_string(prepared.gaussians.size()) + " Gaussians on " + std::to_string(views.count()) +
           " images");
  Trainer trainer(device, options, prepared.gaussians, views, prepared.surface.get());
  take_up(job, trainer);
  run(job, trainer);
  const bool saved = save(job, trainer);  // before the evaluation, which takes time and may be interrupted
  const TrainedMap trained = [&] {
    Stages stages("finish", 2);
    return finish_training(device, trainer, prepared, views, facts_of(job, views),
                           [&stages](const std::string& name) { stages.next(name); });
  }();
  try {
    write_map(job.out, trained.map);
  } catch (const InputError& e) {
    throw InputError(std::string(e.what()) + (saved ? "; what was trained is kept in " + checkpoint_file(job) +
                                                          ": --resume writes the map from it"
                                                    : "; nor could a checkpoint be written"));
  }
  if (saved) std::filesystem::remove(checkpoint_file(job));
  write_report(job, trained, views, device);
  print_profile(common, device);
  name_odd_images(trained.views, views);
  const MapQuality& quality = *trained.map.header.quality;
  return {trained.training, quality};
}

void add_train(CLI::App& app, Common& common) {
  CLI::App* command = add_command(app, common, "train", "train a map of Gaussians from a cloud and posed images");
  auto job = std::make_shared<TrainJob>();
  command->add_option("SEQ", job->sequences, "sequences in one world frame")->required();
  command->add_option("--layout", job->sequence_options.layout, "layout of the sequences (default: detected)");
  add_image_limit_flag(command, job->sequence_options);
  command->add_option("--camera", job->sequence_options.camera_file, "camera.yaml to use instead of their own");
  command->add_option("--cloud", job->cloud, cloud_formats)->required();
  add_number(command, "--voxel", job->voxel, {.least = 0.0, .most = 1000.0, .word = "off"},
             "thin the cloud to one point per voxel of this edge [m]; 0 or off: as it is");
  command->add_flag("--remove-outliers", job->remove_outliers, outliers_help);
  command->add_option("--out", job->out, "map to write (.ply, .glb, .spz, .splat)")->required();
  add_number(command, "--every", job->every, {.least = 1}, "train on every Nth frame");
  command->add_option("--frames", job->frames, frames_help);
  command->add_option("--preset", job->preset, "default, or paper (the recipe of the paper's code)");
  add_number(command, "--iterations", job->iterations, {.least = 0, .most = 100000000, .word = "preset"},
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
  add_number(command, "--depth-weight", job->depth_weight, {.least = 0.0, .most = 1e6, .word = "preset"},
             "weight of the cloud's depth beside the images");
  add_number(command, "--sh-degree", job->sh_degree, {.least = 0, .most = 3, .word = "preset"},
             "degree of the colours' spherical harmonics, 0 to 3");
  command
      ->add_option("--blend-order", job->blend_order,
                   "what Gaussians are sorted by when they are blended: distance from the camera, which makes better "
                   "maps, or depth, which other programs expect (default: the preset's, depth for a .splat)")
      ->check(CLI::IsMember({"distance", "depth"}));
  add_number(command, "--checkpoint-every", job->checkpoint_every, {.least = 0, .word = "never"},
             "iterations between checkpoints (OUT.checkpoint, removed at the end); 0 or never: only at the end and on "
             "Ctrl-C, which leaves OUT as it was");
  command->add_flag("--resume", job->resume,
                    "go on from OUT.checkpoint if there is one: the same bits as without a stop");
  add_number(command, "--seed", job->seed, {}, "seed of every random choice");
  command->add_option("--report", job->report, "report to write (JSON)");
  auto settings = std::make_shared<std::vector<std::string>>();
  const std::vector<std::string> groups{"train"};
  add_set_flag(command, *settings, groups);
  command->final_callback([&common, job, settings, groups] {
    job->options = OptionValues(*settings, groups);
    const TrainOutcome outcome = run_training(common, *job);
    const TrainingReport& report = outcome.training;
    if (report.iterations == 0) {
      print("%s: %zu Gaussians of the cloud, untrained\n", job->out.c_str(), report.gaussians);
    } else {
      print("%s: %zu Gaussians, %d iterations in %s (%.1f it/s), PSNR %.2f dB on the training images\n",
            job->out.c_str(), report.gaussians, report.iterations, format_duration(report.seconds).c_str(),
            report.iterations_per_second, report.psnr_db);
    }
    print("the map is %s\n", outcome.quality.verdict.c_str());
  });
}

}  // namespace odosplat::apps
