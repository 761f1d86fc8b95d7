// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "apps/cli/demo/demo_world.hpp"
#include "apps/cli/eval_depth.hpp"
#include "apps/cli/track/track.hpp"
#include "apps/cli/train/train.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/eval/evaluate.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "viewer/figures/compare_figure.hpp"
#include "viewer/figures/error_plot.hpp"
#include "viewer/figures/map_figure.hpp"
#include "viewer/figures/trajectory_figure.hpp"

namespace odosplat::apps {
namespace {

/// Results of the demo for one source of depth.
struct Row {
  std::string method;
  TrackOutcome track;
  EvalResult result;
  EvalDepthOutcome depth;
};

Row run_method(const Common& common, const std::string& out, const DemoWorld& world, const std::string& method) {
  log_info("tracking with depth of method " + method);
  Row row;
  row.method = method;
  TrackJob track;
  track.sequence.path = world.sequence;
  track.method = method;
  track.anchor = true;  // also for interpolation: without the anchor it would be the paper's ablation, which drifts
  track.map = {out + "/map.ply", world.cloud};
  track.out = out + "/" + method;
  row.track = track_sequence(common, track);
  row.result = evaluate(row.track.trajectory, world.truth, {});
  EvalDepthJob depth;
  depth.sequence.path = world.sequence;
  depth.method = method;
  depth.map = track.map;
  row.depth = evaluate_depth(common, depth);
  return row;
}

std::string table_of(const std::vector<Row>& rows) {
  std::string text = formatted("%-15s %9s %9s %9s %9s %9s %13s %13s\n", "depth from", "posed", "ATE [mm]", "max [mm]",
                               "RTE [mm]", "RRE [deg]", "depth median", "depth 90 %");
  for (const Row& r : rows) {
    const std::string posed = formatted("%d/%d", r.track.posed, r.track.frames);
    text += formatted("%-15s %9s %9.2f %9.2f %9.2f %9.4f %10.2f mm %10.2f mm\n", r.method.c_str(), posed.c_str(),
                      1000.0 * r.result.ate_m.rmse, 1000.0 * r.result.ate_m.max, 1000.0 * r.result.rte_m.rmse,
                      r.result.rre_deg.rmse, 1000.0 * r.depth.all.median_abs_m, 1000.0 * r.depth.all.p90_m);
  }
  return text;
}

void draw_map_picture(const std::string& out, const DemoWorld& world, const MapPoints& map, std::size_t gaussians) {
  MapFigure figure;
  figure.map = map;
  figure.cameras = world.truth;
  figure.camera = world.camera;
  figure.up = Eigen::Vector3d::UnitZ();
  figure.title = "Map of " + std::to_string(gaussians) + " Gaussians and the path of the camera";
  write_rgb8(out + "/map.png", draw_map(figure));
}

void draw_trajectory_picture(const std::string& out, const DemoWorld& world, const MapPoints& map, const Row& row) {
  TrajectoryFigure figure;
  figure.map = map;
  figure.estimate = row.track.trajectory;
  figure.truth = world.truth;
  figure.up = Eigen::Vector3d::UnitZ();
  figure.title =
      formatted("ATE RMSE %.1f mm, max %.1f mm", 1000.0 * row.result.ate_m.rmse, 1000.0 * row.result.ate_m.max);
  write_rgb8(out + "/trajectory.png", draw_trajectory(figure));
}

void draw_compare_picture(const Common& common, const std::string& out, const DemoWorld& world) {
  const Sequence sequence = Sequence::open(world.sequence);
  const MapFlags map{out + "/map.ply", world.cloud};
  OpenedView interpolation = open_view(common, "interpolation", map);
  OpenedView gaussian = open_view(common, "gaussian", map);
  CompareFigure figure;
  // Two views that the map was not trained on.
  for (const std::size_t frame :
       {sequence.size() / 4 + 5 - sequence.size() / 4 % 10, sequence.size() * 3 / 4 / 10 * 10 + 5}) {
    const SE3 T_world_camera = *sequence.T_world_camera(frame);
    CompareExample example;
    example.name = "frame " + std::to_string(frame);
    example.image = sequence.color(frame);
    example.methods.push_back(
        {"interpolated", interpolation.view->render(sequence.camera(), T_world_camera, {}).depth});
    example.methods.push_back({"rendered", gaussian.view->render(sequence.camera(), T_world_camera, {}).depth});
    example.truth = sequence.depth(frame);
    figure.examples.push_back(std::move(example));
  }
  write_rgb8(out + "/compare.png", draw_compare(figure));
}

void draw_error_picture(const std::string& out, const std::vector<Row>& rows) {
  ErrorPlot plot;
  plot.words = "position error";
  for (const Row& row : rows) {
    ErrorSeries series;
    series.name = row.method;
    for (const StampedPose& pose : row.track.trajectory) series.times.push_back(pose.time);
    series.errors = row.result.position_errors_m;
    plot.series.push_back(std::move(series));
  }
  write_rgb8(out + "/errors.png", draw_error_plot(plot));
}

void run(const Common& common, const std::string& out, const DemoOptions& options) {
  const Stopwatch watch;
  const MadeFolders made = ensure_output_folder(out);
  const DemoWorld world = make_demo_world(out, options);
  TrainJob train;
  train.sequences = {world.sequence};
  train.cloud = world.cloud;
  train.out = out + "/map.ply";
  train.report = out + "/training.json";
  train.iterations = options.iterations;
  const TrainOutcome trained = run_training(common, train);
  if (!trained.quality.good) log_warning(train.out + ": " + trained.quality.verdict);
  const TrainingReport& report = trained.training;
  std::vector<Row> rows;
  for (const char* method : {"gaussian", "interpolation"}) rows.push_back(run_method(common, out, world, method));

  const MapPoints map = read_map_points({train.out, world.cloud});
  draw_map_picture(out, world, map, report.gaussians);
  draw_trajectory_picture(out, world, map, rows[0]);
  draw_compare_picture(common, out, world);
  draw_error_picture(out, rows);

  std::string text = table_of(rows) + "(each anchored in the colours of its map: --anchor on)\n";
  text += formatted("map: %zu Gaussians, %d iterations at %.1f it/s, PSNR %.2f dB on unseen views\n", report.gaussians,
                    report.iterations, report.iterations_per_second, rows[0].depth.psnr_db);
  write_file_atomically(out + "/table.txt", text);
  print("%s", text.c_str());
  print("%s: map.png, trajectory.png, compare.png, errors.png, table.txt after %s\n", out.c_str(),
        format_duration(watch.seconds()).c_str());
}

}  // namespace

void add_demo(CLI::App& app, Common& common) {
  CLI::App* command = add_command(app, common, "demo", "the whole chain on a synthetic room: no data needed");
  auto out = std::make_shared<std::string>();
  auto options = std::make_shared<DemoOptions>();
  auto size = std::make_shared<std::string>("320x240");
  command->add_option("--out", *out, "folder for everything the demo makes")->required();
  command->add_option("--size", *size, "WIDTHxHEIGHT of the images [px]");
  add_number(command, "--frames", options->frames, {.least = 20, .most = 100000},
             "length of the path [frames at 30 per second]");
  add_number(command, "--iterations", options->iterations, {.least = 1, .most = 100000000}, "steps of training");
  add_number(command, "--seed", options->seed, {}, "seed of room, tremor and noise");
  command->final_callback([&common, out, options, size] {
    const Size parsed = parse_size("--size", *size);
    options->width = parsed.width;
    options->height = parsed.height;
    run(common, *out, *options);
  });
}

}  // namespace odosplat::apps
