// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "apps/cli/view/view_output.hpp"
#include "apps/command/interrupt.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/input/map_views.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/near_origin.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "odosplat/io/video/video_writer.hpp"
#include "viewer/figures/fly_frame.hpp"

namespace odosplat::apps {
namespace {

struct FlyFlags {
  MapFlags map;
  std::string method = "gaussian";
  std::string poses;
  std::string camera;
  std::string out;
  std::string size;  // empty: the camera's
  double fps = 30.0;
  int step = 1;
};

/// One depth range for the whole video, from a few views along the path.
ValueRange depth_range_along(MapView& view, const Camera& camera, const Trajectory& poses) {
  constexpr std::size_t samples = 12;
  std::vector<DepthImage> depths;
  for (std::size_t k = 0; k < samples; ++k) {
    const std::size_t pose = k * (poses.size() - 1) / (samples - 1);
    depths.push_back(view.render(camera, poses[pose].T_world_camera, {}).depth);
  }
  std::vector<const cv::Mat1f*> images;
  images.reserve(samples);
  for (const DepthImage& depth : depths) images.push_back(&depth);
  return depth_range_of(images);
}

void run(const Common& common, const FlyFlags& flags) {
  check_video_name(flags.out);
  const MadeFolders made = ensure_output_file(flags.out);
  Camera camera = read_camera_file(flags.camera).camera;
  if (!flags.size.empty()) {
    const Size size = parse_size("--size", flags.size);
    camera = camera.resized(size.width, size.height);
  }
  const Trajectory poses = read_trajectory(flags.poses);
  require_near_origin(flags.poses, poses);
  if (poses.empty()) throw InputError(flags.poses, "holds no pose");
  if (method_preset(flags.method).view == ViewKind::sensor) throw InputError("--method", "rgbd has no map to render");
  OpenedView opened = open_view(common, flags.method, flags.map);
  const ValueRange range = depth_range_along(*opened.view, camera, poses);
  ViewRequest request;
  request.color = true;
  std::optional<VideoWriter> video;
  const auto step = static_cast<std::size_t>(flags.step);
  const std::size_t count = (poses.size() + step - 1) / step;
  Progress progress("fly", static_cast<long>(count));
  for (std::size_t k = 0; k < count; ++k) {
    if (interrupted()) throw Interrupted();
    const StampedPose& pose = poses[k * step];
    ViewImages images = opened.view->render(camera, pose.T_world_camera, request);
    const std::string words = formatted("%.2f s", pose.time - poses.front().time);
    const cv::Mat3b frame = draw_fly_frame({std::move(images.color), std::move(images.depth), range, words});
    if (!video) video.emplace(flags.out, frame.size(), flags.fps);
    video->write(frame);
    progress.update(static_cast<long>(k) + 1);
  }
  progress.finish();
  video->commit();
  if (opened.device) print_profile(common, *opened.device);
  print("%s: %zu frames\n", flags.out.c_str(), count);
}

}  // namespace

void add_view_fly(CLI::App* view, Common& common) {
  CLI::App* command = add_command(*view, common, "fly", "a film of the flight through a map: colour beside depth");
  auto flags = std::make_shared<FlyFlags>();
  add_map_flags(command, flags->map);
  command->add_option("--method", flags->method, "gaussian, paper, interpolation or surfel");
  command->add_option("--poses", flags->poses, "trajectory, camera to world")->required();
  command->add_option("--camera", flags->camera, "camera.yaml")->required();
  command->add_option("--out", flags->out, "video to write: .avi (Motion JPEG) or .mp4 (MPEG-4)")->required();
  command->add_option("--size", flags->size, "WIDTHxHEIGHT of the rendered images [px] (default: the camera's)");
  add_number(command, "--fps", flags->fps, {.least = 0.1, .most = 1000.0}, "frames per second of the video");
  add_number(command, "--step", flags->step, {.least = 1}, "use every Nth pose");
  command->final_callback([&common, flags] { run(common, *flags); });
}

}  // namespace odosplat::apps
