// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <sstream>

#include "apps/command/interrupt.hpp"
#include "apps/command/output.hpp"
#include "apps/input/map_views.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/near_origin.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat::apps {
namespace {

struct RenderFlags {
  std::string method = "gaussian";
  MapFlags map;
  std::string poses;
  std::string camera;
  std::string out;
  std::string what = "color,depth";
};

struct Wanted {
  bool color = false;
  bool depth = false;
  bool alpha = false;
  bool sigma = false;
};

Wanted parse_what(const std::string& text) {
  Wanted wanted;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "color") {
      wanted.color = true;
    } else if (word == "depth") {
      wanted.depth = true;
    } else if (word == "alpha") {
      wanted.alpha = true;
    } else if (word == "sigma") {
      wanted.sigma = true;
    } else {
      throw InputError("--what", "must be some of color,depth,alpha,sigma, is " + text);
    }
  }
  if (text.empty()) throw InputError("--what", "must be some of color,depth,alpha,sigma, is empty");
  return wanted;
}

std::string file_of(const RenderFlags& flags, const char* kind, std::size_t k) {
  return flags.out + formatted("/%s/%06zu.png", kind, k);
}

void run(const Common& common, const RenderFlags& flags) {
  const Wanted wanted = parse_what(flags.what);
  check_flags_of_method(flags.method, flags.map);
  const MadeFolders made = ensure_output_folder(flags.out);
  const CameraFile camera = read_camera_file(flags.camera);
  const PoseFile file = read_pose_file(flags.poses);
  const Trajectory& poses = file.poses;
  require_near_origin(flags.poses, poses);
  if (method_preset(flags.method).view == ViewKind::sensor) throw InputError("--method", "rgbd has no map to render");
  OpenedView opened = open_view(common, flags.method, flags.map);
  constexpr double sigma_units = 10000.0;
  std::size_t too_far = 0;
  ViewRequest request;
  request.color = wanted.color;
  request.alpha = wanted.alpha;
  Progress progress("render", static_cast<long>(poses.size()));
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (interrupted()) throw Interrupted();
    const ViewImages images = opened.view->render(camera.camera, poses[k].T_world_camera, request);
    if (wanted.color && !images.color.empty()) write_color(file_of(flags, "color", file.numbers[k]), images.color);
    if (wanted.depth) {
      too_far += write_depth(file_of(flags, "depth", file.numbers[k]), images.depth, camera.depth_scale);
    }
    if (wanted.alpha) write_gray(file_of(flags, "alpha", file.numbers[k]), images.alpha);
    if (wanted.sigma) {
      // As 0 a sigma beyond 16 bits would count as none, which a reader may take for certain depth.
      DepthImage sigma = images.sigma;
      if (!sigma.empty()) cv::min(sigma, largest_depth(sigma_units), sigma);
      write_depth(file_of(flags, "sigma", file.numbers[k]), sigma, sigma_units);
    }
    progress.update(static_cast<long>(k) + 1);
  }
  progress.finish();
  if (too_far > 0) {
    log_warning(flags.out + formatted(": %zu pixels lie beyond the %.3g m that 16 bits at depth_scale %g hold: depth 0",
                                      too_far, largest_depth(camera.depth_scale), camera.depth_scale));
  }
  if (opened.device) print_profile(common, *opened.device);
  print("%s: %zu views\n", flags.out.c_str(), poses.size());
}

}  // namespace

void add_render(CLI::App& app, Common& common) {
  CLI::App* command = add_command(app, common, "render", "images of a map from given poses");
  auto flags = std::make_shared<RenderFlags>();
  add_map_flags(command, flags->map);
  command->add_option("--method", flags->method, "gaussian, paper, interpolation or surfel");
  command->add_option("--poses", flags->poses, "trajectory, camera to world")->required();
  command->add_option("--camera", flags->camera, "camera.yaml")->required();
  command->add_option("--out", flags->out, "folder for color/, depth/, alpha/, sigma/")->required();
  command->add_option("--what", flags->what, "some of color,depth,alpha,sigma");
  command->final_callback([&common, flags] { run(common, *flags); });
}

}  // namespace odosplat::apps
