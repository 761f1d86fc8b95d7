// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>
#include <cstdio>
#include <memory>

#include "map_views.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/eval/evaluate.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/camera_file.hpp"
#include "odosplat/io/image_file.hpp"
#include "odosplat/io/trajectory_file.hpp"
#include "odosplat/viewer/compare_figure.hpp"
#include "odosplat/viewer/depth_figure.hpp"
#include "odosplat/viewer/map_figure.hpp"
#include "odosplat/viewer/trajectory_figure.hpp"
#include "sequence_flags.hpp"

namespace odosplat::apps {
namespace {

struct OutputFlags {
  std::string out;
  std::string size;  // empty: the figure's own
};

void add_output_flags(CLI::App* command, OutputFlags& flags) {
  command->add_option("--out", flags.out, "picture to write (PNG)")->required();
  command->add_option("--size", flags.size, "WIDTHxHEIGHT of the picture [px] (default: as the figure needs)");
}

template <typename Figure>
void set_size(const OutputFlags& flags, Figure& figure) {
  ensure_output_file(flags.out);
  if (flags.size.empty()) return;
  const Size size = parse_size("--size", flags.size);
  figure.size = {size.width, size.height};
}

void save(const OutputFlags& flags, const cv::Mat3b& picture) {
  write_rgb8(flags.out, picture);
  std::printf("%s: %dx%d\n", flags.out.c_str(), picture.cols, picture.rows);
}

CLI::App* add_view_kind(CLI::App* parent, Common& common, const char* name, const char* help, OutputFlags& flags) {
  CLI::App* command = add_command(*parent, common, name, help);
  add_output_flags(command, flags);
  return command;
}

struct MapViewFlags {
  OutputFlags output;
  MapFlags map;
  std::string poses;
  std::string camera;
  std::string title;
};

void run_map(const MapViewFlags& flags) {
  MapFigure figure;
  set_size(flags.output, figure);
  figure.map = read_map_points(flags.map);
  if (!flags.poses.empty()) figure.cameras = read_trajectory(flags.poses);
  if (!flags.camera.empty()) figure.camera = read_camera_file(flags.camera).camera;
  figure.title = flags.title;
  save(flags.output, draw_map(figure));
}

struct TrajectoryViewFlags {
  OutputFlags output;
  MapFlags map;
  std::string estimate;
  std::string truth;
  std::string title;
};

std::string error_title(const Trajectory& estimate, const Trajectory& truth) {
  const EvalResult result = evaluate(estimate, truth, {});
  char text[120];
  std::snprintf(text, sizeof(text), "ATE RMSE %.1f mm, max %.1f mm", 1000.0 * result.ate_m.rmse,
                1000.0 * result.ate_m.max);
  return text;
}

void run_trajectory(const TrajectoryViewFlags& flags) {
  TrajectoryFigure figure;
  set_size(flags.output, figure);
  figure.map = read_map_points(flags.map);
  figure.estimate = read_trajectory(flags.estimate);
  if (!flags.truth.empty()) figure.truth = read_trajectory(flags.truth);
  figure.title = flags.title;
  if (figure.title.empty() && !figure.truth.empty()) figure.title = error_title(figure.estimate, figure.truth);
  save(flags.output, draw_trajectory(figure));
}

struct FrameViewFlags {
  OutputFlags output;
  SequenceFlags sequence;
  MapFlags map;
  std::string method = "gaussian";
  std::vector<std::size_t> frames{0};
};

SE3 pose_of_frame(const Sequence& sequence, std::size_t frame) {
  if (frame >= sequence.size()) {
    throw InputError("--frame",
                     "is " + std::to_string(frame) + ", the sequence has " + std::to_string(sequence.size()));
  }
  if (!sequence.T_world_camera(frame)) throw InputError("--frame", std::to_string(frame) + " has no pose");
  return *sequence.T_world_camera(frame);
}

void run_depth(const Common& common, const FrameViewFlags& flags) {
  DepthFigure figure;
  set_size(flags.output, figure);
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
  save(flags.output, draw_depth(figure));
}

void run_compare(const Common& common, const FrameViewFlags& flags) {
  CompareFigure figure;
  set_size(flags.output, figure);
  const Sequence sequence = open_sequence(flags.sequence);
  for (const std::size_t frame : flags.frames) pose_of_frame(sequence, frame);
  OpenedView interpolation = open_view(common, "interpolation", flags.map);
  OpenedView gaussian = open_view(common, "gaussian", flags.map);
  for (const std::size_t frame : flags.frames) {
    const SE3 T_world_camera = pose_of_frame(sequence, frame);
    CompareExample example;
    if (flags.frames.size() > 1) example.name = "frame " + std::to_string(frame);
    example.image = sequence.color(frame);
    example.methods.push_back(
        {"interpolated", interpolation.view->render(sequence.camera(), T_world_camera, {}).depth});
    example.methods.push_back({"rendered", gaussian.view->render(sequence.camera(), T_world_camera, {}).depth});
    if (sequence.has_depth(frame)) example.truth = sequence.depth(frame);
    figure.examples.push_back(std::move(example));
  }
  save(flags.output, draw_compare(figure));
}

}  // namespace

void add_view(CLI::App& app, Common& common) {
  CLI::App* view = app.add_subcommand("view", "figures as PNG, without a screen");
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
  command->add_option("--truth", trajectory->truth, "true trajectory");
  add_map_flags(command, trajectory->map);
  command->add_option("--title", trajectory->title, "one line (default: the error)");
  command->final_callback([trajectory] { run_trajectory(*trajectory); });

  auto depth = std::make_shared<FrameViewFlags>();
  command =
      add_view_kind(view, common, "depth", "depth, sigma and alpha of a map at a frame's true pose", depth->output);
  add_sequence_flags(command, depth->sequence);
  add_map_flags(command, depth->map);
  command->add_option("--method", depth->method, method_names());
  command->add_option("--frame", depth->frames, "frame number, from 0")->expected(1);
  command->final_callback([&common, depth] { run_depth(common, *depth); });

  auto compare = std::make_shared<FrameViewFlags>();
  command = add_view_kind(view, common, "compare",
                          "image, interpolated depth, rendered depth, true depth and errors (the paper's Figure 4)",
                          compare->output);
  add_sequence_flags(command, compare->sequence);
  add_map_flags(command, compare->map);
  command->add_option("--frame", compare->frames, "frame numbers, from 0")->delimiter(',');
  command->final_callback([&common, compare] { run_compare(common, *compare); });
}

}  // namespace odosplat::apps
