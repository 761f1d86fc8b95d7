// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <utility>

#include "apps/cli/view/view_figures.hpp"
#include "apps/cli/view/view_output.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/input/map_views.hpp"
#include "apps/input/sequence_flags.hpp"
#include "apps/input/truth.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/near_origin.hpp"
#include "odosplat/eval/evaluate.hpp"
#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "viewer/figures/depth_figure.hpp"
#include "viewer/figures/map_figure.hpp"
#include "viewer/figures/trajectory_figure.hpp"

namespace odosplat::apps {
namespace {

struct MapViewFlags {
  ViewOutputFlags output;
  MapFlags map;
  std::string poses;
  std::string camera;
  std::string title;
};

void run_map(const MapViewFlags& flags) {
  if (flags.map.map.empty() && flags.map.cloud.empty() && flags.poses.empty()) {
    throw InputError("--map, --cloud or --poses", "is needed: there is nothing to draw");
  }
  MapFigure figure;
  const MadeFolders made = prepare_picture(flags.output, figure);
  figure.map = read_map_points(flags.map);
  if (!flags.poses.empty()) figure.cameras = read_trajectory(flags.poses);
  require_near_origin(flags.poses, figure.cameras);
  if (!flags.camera.empty()) figure.camera = read_camera_file(flags.camera).camera;
  figure.title = flags.title;
  log_info("drawing " + std::to_string(figure.map.cloud.size()) + " points");
  save_picture(flags.output, draw_map(figure));
}

struct TrajectoryViewFlags {
  ViewOutputFlags output;
  MapFlags map;
  std::string estimate;
  std::string times;
  TruthFlags truth;
  std::string title;
};

std::string error_title(const Trajectory& estimate, const Trajectory& truth) {
  const EvalResult result = evaluate(estimate, truth, {});
  if (!result.doubt.empty()) log_warning("only " + result.doubt);
  return formatted("ATE RMSE %.1f mm, max %.1f mm", 1000.0 * result.ate_m.rmse, 1000.0 * result.ate_m.max);
}

void run_trajectory(const TrajectoryViewFlags& flags) {
  TrajectoryFigure figure;
  const MadeFolders made = prepare_picture(flags.output, figure);
  figure.map = read_map_points(flags.map);
  JudgedTrajectory judged = read_judged(flags.estimate, flags.times, flags.truth);
  figure.estimate = std::move(judged.estimate);
  figure.truth = std::move(judged.truth);
  // If the run's images are not known (a trajectory of another program), the span is that of the estimate, so that no
  // part before or after it counts as lost.
  figure.span = judged.span.value_or(TimeSpan{figure.estimate.front().time, figure.estimate.back().time});
  // The truth before and after the run is not drawn.
  constexpr double slack = 0.01;  // [s] largest time difference of matched poses
  std::erase_if(figure.truth, [&](const StampedPose& pose) {
    return pose.time < figure.span->first - slack || pose.time > figure.span->last + slack;
  });
  require_near_origin(flags.estimate, figure.estimate);
  require_near_origin(flags.truth.sequence.path, figure.truth);
  figure.title = flags.title;
  if (figure.title.empty() && !figure.truth.empty()) figure.title = error_title(figure.estimate, figure.truth);
  log_info("drawing " + std::to_string(figure.map.cloud.size()) + " points");
  save_picture(flags.output, draw_trajectory(figure));
}

struct FrameViewFlags {
  ViewOutputFlags output;
  SequenceFlags sequence;
  MapFlags map;
  std::string method = "gaussian";
  std::vector<std::size_t> frames{0};
};

void run_depth(const Common& common, const FrameViewFlags& flags) {
  DepthFigure figure;
  const MadeFolders made = prepare_picture(flags.output, figure);
  check_flags_of_method(flags.method, flags.map);
  const Sequence sequence = open_sequence(flags.sequence);
  const std::size_t frame = flags.frames.at(0);
  const SE3 T_world_camera = pose_of_frame(sequence, frame);
  OpenedView opened = open_view(common, flags.method, flags.map);
  if (opened.sensor != nullptr && !sequence.has_depth(frame)) {
    throw InputError("--frame", std::to_string(frame) + " has no depth image");
  }
  opened.show_frame(sequence, frame);
  ViewRequest request;
  request.alpha = true;
  const ViewImages images = opened.view->render(sequence.camera(), T_world_camera, request);
  figure.depth = images.depth;
  figure.sigma = images.sigma;
  figure.alpha = images.alpha;
  figure.color = sequence.color(frame);
  figure.title = opened.view->name() + ", frame " + std::to_string(frame);
  save_picture(flags.output, draw_depth(figure));
}

void run_compare(const Common& common, const FrameViewFlags& flags) {
  CompareFigure figure;
  const MadeFolders made = prepare_picture(flags.output, figure);
  const Sequence sequence = open_sequence(flags.sequence);
  for (const std::size_t frame : flags.frames) pose_of_frame(sequence, frame);
  ComparedViews views = open_compared_views(common, flags.map);
  for (const std::size_t frame : flags.frames) {
    const std::string name = flags.frames.size() > 1 ? "frame " + std::to_string(frame) : "";
    figure.examples.push_back(compare_example(views, sequence, frame, name));
  }
  save_picture(flags.output, draw_compare(figure));
}

void run_association(const Common& common, const FrameViewFlags& flags) {
  AssociationFigure figure;
  const MadeFolders made = prepare_picture(flags.output, figure);
  const Sequence sequence = open_sequence(flags.sequence);
  const std::size_t frame = flags.frames.at(0);
  pose_of_frame(sequence, frame);
  ComparedViews views = open_compared_views(common, flags.map);
  const cv::Size size = figure.size;
  figure = association_figure(views, sequence, frame, flags.map);
  figure.size = size;
  save_picture(flags.output, draw_association(figure));
}

}  // namespace

void add_view(CLI::App& app, Common& common) {
  CLI::App* view = app.add_subcommand("view", "figures (PNG, JPEG, PDF, SVG), films and web pages, without a screen");
  view->require_subcommand(1);

  auto map = std::make_shared<MapViewFlags>();
  CLI::App* command = add_view_kind(view, common, "map", "a map and the cameras in it", map->output);
  add_map_flags(command, map->map);
  command->add_option("--poses", map->poses, "trajectory of the cameras");
  command->add_option("--camera", map->camera, "camera.yaml, for the shape of the frusta");
  command->add_option("--title", map->title, "one line");
  command->final_callback([map] { run_map(*map); });

  auto trajectory = std::make_shared<TrajectoryViewFlags>();
  command = add_view_kind(view, common, "trajectory", "an estimated trajectory in its map, coloured by its error",
                          trajectory->output);
  command->add_option("EST", trajectory->estimate, "estimated trajectory")->required();
  command->add_option("--times", trajectory->times, "times of EST, one a line, for formats without times");
  add_truth_flags(command, trajectory->truth);
  add_map_flags(command, trajectory->map);
  command->add_option("--title", trajectory->title, "one line (default: the error)");
  command->final_callback([trajectory] { run_trajectory(*trajectory); });

  auto depth = std::make_shared<FrameViewFlags>();
  command =
      add_view_kind(view, common, "depth", "depth, sigma and alpha of a map at a frame's true pose", depth->output);
  add_sequence_flags(command, depth->sequence);
  add_map_flags(command, depth->map);
  command->add_option("--method", depth->method, method_names());
  add_numbers(command, "--frame", depth->frames, 1, 1, {}, "frame number, from 0");
  command->final_callback([&common, depth] { run_depth(common, *depth); });

  auto compare = std::make_shared<FrameViewFlags>();
  command = add_view_kind(view, common, "compare",
                          "image, interpolated depth, rendered depth, true depth and errors (the paper's Figure 4)",
                          compare->output);
  add_sequence_flags(command, compare->sequence);
  add_map_flags(command, compare->map);
  add_numbers(command, "--frame", compare->frames, 1, most_numbers, {}, "frame numbers, from 0, as in 3,40")
      ->delimiter(',');
  command->final_callback([&common, compare] { run_compare(common, *compare); });

  auto association = std::make_shared<FrameViewFlags>();
  command = add_view_kind(view, common, "association",
                          "interpolated depth, rendered depth and the points of a map (the paper's Figure 1)",
                          association->output);
  add_sequence_flags(command, association->sequence);
  add_map_flags(command, association->map);
  add_numbers(command, "--frame", association->frames, 1, 1, {}, "frame number, from 0");
  command->final_callback([&common, association] { run_association(common, *association); });

  add_view_fly(view, common);
  add_view_web(view, common);
}

}  // namespace odosplat::apps
