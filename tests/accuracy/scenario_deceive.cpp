// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>

#include "apps/command/number_flags.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/odometry/relocalise/place_index.hpp"
#include "tests/accuracy/disturb/disturb_image.hpp"
#include "tests/accuracy/output.hpp"
#include "tests/accuracy/scenarios.hpp"

namespace odosplat::accuracy {
namespace {

struct DeceiveFlags {
  Job job;
  std::vector<std::string> others;  // sequences of other places
  std::vector<std::string> only;    // substrings of names of deceptions, all if empty
  std::size_t frames = 60;
};

/// A run with wrong input to the odometry.
struct Deception {
  std::string name;
  Script script;
  SE3 T_world_camera_start;
  double focal_factor = 1.0;                         // applied to the focal lengths given to the odometry
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // [px] added to the principal point given to it
};

/// Another sequence's images at this camera's size, repeated cyclically.
std::function<GrayImage(std::size_t n)> images_of(const Sequence& other, const Camera& camera) {
  return [other, camera](std::size_t n) { return resized_gray(other.gray(n % other.size()), camera); };
}

class Deceptions {
 public:
  Deceptions(const World& world, const DeceiveFlags& flags)
      : world_(world), frames_(std::min(flags.frames, world.size())), seed_(flags.job.track.seed) {}

  /// Edits every image of the world, with the true start pose. blind: the result shows nothing of the world.
  void edited(const std::string& name, bool blind, const std::function<ImageEdit(std::size_t)>& edit) {
    Script script = in_order(world_, 0, frames_, edit);
    for (Step& step : script) step.blind = blind;
    all.push_back({name, std::move(script), world_.T_world_camera(0)});
  }

  /// The given frames of the world at regular times.
  void ordered(const std::string& name, const std::vector<std::size_t>& frames) {
    Script script;
    const double interval = world_.time(1) - world_.time(0);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      script.push_back({world_.time(0) + static_cast<double>(k) * interval, frames[k], {}, false});
    }
    all.push_back({name, std::move(script), world_.T_world_camera(frames.front())});
  }

  /// Every n-th frame at its own time.
  void sparse(const std::string& name, std::size_t every) {
    Script script;
    for (std::size_t i = 0; i < world_.size(); i += every) script.push_back({world_.time(i), i, {}, false});
    all.push_back({name, std::move(script), world_.T_world_camera(0)});
  }

  void wrong_camera(const std::string& name, double focal_factor, const Eigen::Vector2d& center) {
    all.push_back({name, in_order(world_, 0, frames_), world_.T_world_camera(0), focal_factor, center});
  }

  void wrong_start(const std::string& name, const SE3& T_world_camera_start) {
    all.push_back({name, in_order(world_, 0, frames_), T_world_camera_start});
  }

  void kidnapped(const std::string& name, const std::function<GrayImage(std::size_t)>& other) {
    constexpr std::size_t before = 20;
    Script script = in_order(world_, 0, std::max(frames_, 2 * before));
    for (std::size_t k = before; k < script.size(); ++k) {
      script[k].blind = true;
      script[k].edit = [other, k](const GrayImage&) { return other(k - before); };
    }
    all.push_back({name, std::move(script), world_.T_world_camera(0)});
  }

  std::vector<Deception> all;

 private:
  const World& world_;
  std::size_t frames_;
  std::uint64_t seed_;
};

std::vector<std::size_t> random_order(std::size_t size, std::size_t frames, std::uint64_t seed) {
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(seed + 1);
  for (std::size_t k = size - 1; k > 0; --k)
    std::swap(order[k], order[random.below(static_cast<std::uint32_t>(k + 1))]);
  order.resize(std::min(size, frames));
  return order;
}

/// Alternates between the sequence's beginning and its middle after every `stay` frames.
std::vector<std::size_t> back_and_forth(std::size_t size, std::size_t frames, std::size_t stay) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < frames; ++k) {
    const bool far = (k / stay) % 2 != 0;
    order.push_back((k + (far ? size / 2 : 0)) % size);
  }
  return order;
}

std::vector<Deception> deceptions(const World& world, const DeceiveFlags& flags) {
  Deceptions d(world, flags);
  const std::uint64_t seed = flags.job.track.seed;
  const Camera camera = world.camera();
  for (const std::string& name : flags.others) {
    const Sequence other = Sequence::open(name);
    const auto image = images_of(other, camera);
    d.edited("foreign " + other.name(), true,
             [image](std::size_t i) { return [image, i](const GrayImage&) { return image(i); }; });
    d.edited("still " + other.name(), true,
             [image](std::size_t) { return [image](const GrayImage&) { return image(7); }; });
    d.edited("half " + other.name(), false, [image](std::size_t i) {
      return [image, i](const GrayImage& own) { return with_right_half(own, image(i)); };
    });
    d.kidnapped("kidnapped to " + other.name(), image);
  }
  const auto flip = [](int code) {
    return [code](std::size_t) { return [code](const GrayImage& own) { return mirrored(own, code); }; };
  };
  d.edited("mirrored", true, flip(1));
  d.edited("upside down", true, flip(0));
  d.edited("white noise", true, [camera, seed](std::size_t) {
    return [camera, seed](const GrayImage&) { return with_noise(uniform_image(camera, 0.5), 0.3, seed); };
  });
  d.ordered("random order", random_order(world.size(), flags.frames, seed));
  d.ordered("back and forth", back_and_forth(world.size(), flags.frames, 6));
  d.ordered("jumps", back_and_forth(world.size(), flags.frames, 1));
  for (const std::size_t every : {10, 25, 50}) {
    if (world.size() / every >= 5) d.sparse("every " + std::to_string(every) + "th frame", every);
  }
  for (const int percent : {-20, -10, -5, -2, 2, 5, 10, 20}) {
    char name[32];
    std::snprintf(name, sizeof(name), "focal length %+d %%", percent);
    d.wrong_camera(name, 1.0 + percent / 100.0, Eigen::Vector2d::Zero());
  }
  d.wrong_camera("principal point 16 px off", 1.0, {16.0, 0.0});
  const SE3 start = world.T_world_camera(0);
  d.wrong_start("start 20 m away", SE3(start.rotation(), start.translation() + Eigen::Vector3d(20.0, 0.0, 0.0)));
  d.wrong_start("start turned by 90 deg", start * SE3(so3_exp({0.0, 1.5707963, 0.0}), Eigen::Vector3d::Zero()));
  d.wrong_start("start 0.5 m away", start * SE3(Eigen::Quaterniond::Identity(), {0.5, 0.0, 0.0}));
  if (flags.only.empty()) return d.all;
  std::erase_if(d.all, [&](const Deception& each) {
    return std::none_of(flags.only.begin(), flags.only.end(),
                        [&](const std::string& part) { return each.name.find(part) != std::string::npos; });
  });
  return d.all;
}

/// Effect of a deception on the poses. A blind frame has no correct pose.
struct Harm {
  int frames = 0;
  int posed = 0;
  int in_map = 0;
  int wrong = 0;         // poses in the map with a large error, or of blind frames
  int wrong_beyond = 0;  // the same for poses not in the map
  double worst_m = 0.0;  // largest error of poses in the map, without blind frames
  double mean_nees = 0.0;
};

Harm harm_of(const Run& run, const RecoveryBars& bars) {
  Harm harm;
  harm.wrong = wrong_in_map(run, bars);
  int judged = 0;
  for (const PlayedFrame& frame : run.frames) {
    ++harm.frames;
    if (frame.result.status == TrackStatus::lost) continue;
    ++harm.posed;
    const PoseError error = pose_error(frame);
    if (!frame.result.in_map) {
      const bool wrong = frame.blind || error.meters > bars.wrong_m || error.degrees > bars.wrong_deg;
      harm.wrong_beyond += wrong ? 1 : 0;
      continue;
    }
    ++harm.in_map;
    if (frame.blind) continue;
    harm.worst_m = std::max(harm.worst_m, error.meters);
    harm.mean_nees +=
        normalised_error_squared(frame.result.T_world_camera, frame.T_world_camera_true, frame.result.covariance);
    ++judged;
  }
  harm.mean_nees = judged > 0 ? harm.mean_nees / judged : std::numeric_limits<double>::quiet_NaN();
  return harm;
}

void run_deceive(const apps::Common& common, const DeceiveFlags& flags) {
  Output out(flags.job);
  const World world(flags.job);
  apps::OpenedView opened = apps::open_view(common, flags.job.track.method, flags.job.track.map);
  const RecoveryBars bars;
  Harm all;
  for (const Deception& d : deceptions(world, flags)) {
    const Run run = play(world, opened, flags.job.track, d.script, d.name, d.T_world_camera_start, [&d](Camera camera) {
      camera.fx *= d.focal_factor;
      camera.fy *= d.focal_factor;
      camera.cx += d.center.x();
      camera.cy += d.center.y();
      return camera;
    });
    out.trace(world, d.name, run);
    const Harm harm = harm_of(run, bars);
    all.frames += harm.frames;
    all.wrong += harm.wrong;
    out.add(Row()
                .text("set", world.name())
                .text("deception", d.name)
                .count("frames", harm.frames)
                .count("posed", harm.posed)
                .count("in_map", harm.in_map)
                .count("wrong", harm.wrong)
                .count("wrong_beyond", harm.wrong_beyond)
                .number("worst_mm", 1000.0 * harm.worst_m, 1)
                .number("nees_mean", harm.mean_nees, 1)
                .count("refused", run.statistics.refused)
                .text("likely_cause", run.statistics.likely_cause)
                .flag("pass", harm.wrong == 0));
  }
  out.add(Row().text("set", world.name()).text("total", "all").count("frames", all.frames).count("wrong", all.wrong));
  out.write();
}

}  // namespace

void add_deceive(CLI::App& app, apps::Common& common) {
  CLI::App* command = apps::add_command(
      app, common, "deceive",
      "the odometry is shown other places, mirrored, still, mixed and shuffled images, and told wrong cameras and "
      "starts: poses that count as in the map and are off by more than 0.1 m or 5 deg, or of images that show nothing "
      "of it (0 pass), the same beyond the map, and the normalised pose error squared (6 expected)");
  auto flags = std::make_shared<DeceiveFlags>();
  add_job_flags(command, flags->job);
  command->add_option("--other", flags->others, "sequences of other places, shown at this one's size");
  command->add_option("--only", flags->only, "deceptions whose name contains one of these (default: all)");
  apps::add_number(command, "--length", flags->frames, {.least = 2, .most = 100000}, "frames of each");
  command->final_callback([&common, flags] { run_deceive(common, *flags); });
}

}  // namespace odosplat::accuracy
