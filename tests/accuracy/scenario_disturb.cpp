// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <numbers>

#include <unistd.h>

#include "apps/command/number_flags.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "tests/accuracy/disturb_image.hpp"
#include "tests/accuracy/disturb_map.hpp"
#include "tests/accuracy/output.hpp"
#include "tests/accuracy/scenarios.hpp"

namespace odosplat::accuracy {
namespace {

// Limits for passing: ATE relative to the undisturbed run, and share of lost frames.
constexpr double max_ratio = 2.0;
constexpr double max_lost_share = 0.02;
// Number of frames after which a wrong start pose must be corrected.
constexpr std::size_t start_frames = 30;

struct DisturbFlags {
  Job job;
  std::vector<std::string> only{"noise", "gamma", "exposure", "blur", "rolling", "deleted", "moved", "start"};
  double noise = 8.0;  // [of 255]
  double gamma = 0.6;
  double exposure = 1.5;
  double exposure_seconds = 2.0;
  double blur_px = 5.0;
  double rolling = 0.15;
  double rolling_seconds = 2.0;
  double deleted = 0.2;
  double deleted_radius = 0.3;  // [m]
  MoveOptions moved;
  int starts = 6;
  double start_m = 0.1;
  double start_deg = 5.0;
};

using EditOfFrame = std::function<ImageEdit(std::size_t frame)>;

EditOfFrame image_edit(const std::string& name, const World& world, const DisturbFlags& flags) {
  if (name == "noise") {
    return [&flags](std::size_t frame) -> ImageEdit {
      const std::uint64_t seed = flags.job.track.seed + 0x9E3779B97F4A7C15ULL * (frame + 1);
      return [&flags, seed](const GrayImage& image) { return with_noise(image, flags.noise / 255.0, seed); };
    };
  }
  if (name == "gamma") {
    return [&flags](std::size_t) -> ImageEdit {
      return [&flags](const GrayImage& image) { return with_gamma(image, flags.gamma); };
    };
  }
  if (name == "exposure") {
    return [&flags, &world](std::size_t frame) -> ImageEdit {
      const double gain = exposure_gain(world.time(frame) - world.time(0), flags.exposure, flags.exposure_seconds);
      return [gain](const GrayImage& image) { return with_gain(image, gain); };
    };
  }
  if (name == "blur") {
    return [&flags, &world](std::size_t frame) -> ImageEdit {
      constexpr double depth = 2.0;
      const SE3 before = world.T_world_camera(frame > 0 ? frame - 1 : frame);
      const SE3 after = world.T_world_camera(std::min(frame + 1, world.size() - 1));
      const Eigen::Vector2d direction = center_motion(world.camera(), before, after, depth);
      return [&flags, direction](const GrayImage& image) { return with_motion_blur(image, direction, flags.blur_px); };
    };
  }
  if (name == "rolling") {
    return [&flags, &world](std::size_t frame) -> ImageEdit {
      const double phase = (world.time(frame) - world.time(0)) / flags.rolling_seconds;
      return [&flags, phase](const GrayImage& image) { return with_rolling_gain(image, flags.rolling, phase); };
    };
  }
  return {};
}

MapEdit map_edit(const std::string& name, const DisturbFlags& flags) {
  const std::uint64_t seed = flags.job.track.seed;
  if (name == "deleted") {
    return [&flags, seed](std::span<float> p) { return in_random_balls(p, flags.deleted, flags.deleted_radius, seed); };
  }
  if (name == "moved") {
    return [&flags, seed](std::span<float> p) {
      move_random_pieces(p, flags.moved, seed);
      return std::vector<std::uint8_t>();
    };
  }
  return {};
}

/// The true pose, disturbed by the given distance and angle in directions that depend on the seed.
SE3 wrong_start(const SE3& T_world_camera, const DisturbFlags& flags, std::uint64_t seed) {
  Random random(seed);
  const auto direction = [&random] {
    return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  };
  const Eigen::Vector3d translation = flags.start_m * direction();
  const Eigen::Vector3d rotation = flags.start_deg * std::numbers::pi / 180.0 * direction();
  return T_world_camera * SE3(so3_exp(rotation), translation);
}

/// A temporary folder for damaged maps, removed at the end.
class DamagedMaps {
 public:
  DamagedMaps() : path_(std::filesystem::temp_directory_path() / ("odosplat_accuracy." + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~DamagedMaps() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  DamagedMaps(const DamagedMaps&) = delete;
  DamagedMaps& operator=(const DamagedMaps&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// A row that compares a run with the undisturbed one, both evaluated over the same frames.
Row compared(const World& world, const std::string& name, const Judged& judged, const Judged& plain) {
  const double ratio = plain.ate_m.rmse > 0.0 && judged.ate_m.count > 0 ? judged.ate_m.rmse / plain.ate_m.rmse
                                                                        : std::numeric_limits<double>::infinity();
  return row_of(world, name, judged)
      .number("live_mm", 1000.0 * judged.live_ate_m.rmse, 2)
      .number("lost_share", judged.lost_share(), 3)
      .number("ratio", ratio, 2)
      .flag("pass", ratio <= max_ratio && judged.lost_share() <= max_lost_share);
}

/// Runs with start poses near the true one, each evaluated after its first frames.
void run_starts(const World& world, apps::OpenedView& opened, const DisturbFlags& flags, const Run& plain,
                Output& out) {
  const std::size_t end = std::min(world.size(), std::size_t{150});
  if (end <= start_frames) throw InputError(world.name(), "is too short for wrong starts");
  for (int n = 1; n <= flags.starts; ++n) {
    const SE3 start = wrong_start(world.T_world_camera(0), flags, flags.job.track.seed + static_cast<std::uint64_t>(n));
    const std::string name = "start " + std::to_string(n);
    const Run run =
        play(world, *opened.view, opened.sensor, flags.job.track, in_order(world, 0, end), start, name, world.camera());
    out.trace(world, name, run);
    out.add(compared(world, name, judge(run, start_frames, end), judge(plain, start_frames, end)));
  }
}

void run_disturb(const apps::Common& common, const DisturbFlags& flags) {
  Output out(flags.job);
  const World world(flags.job);
  const apps::TrackJob& job = flags.job.track;
  apps::OpenedView opened = apps::open_view(common, job.method, job.map);
  const Run plain = play(world, opened, job, in_order(world, 0, world.size()), "plain");
  out.trace(world, "plain", plain);
  const Judged undisturbed = judge(plain);
  out.add(compared(world, "plain", undisturbed, undisturbed));
  for (const std::string& name : flags.only) {
    if (const EditOfFrame edit = image_edit(name, world, flags); edit) {
      const Run run = play(world, opened, job, in_order(world, 0, world.size(), edit), name);
      out.trace(world, name, run);
      out.add(compared(world, name, judge(run), undisturbed));
    } else if (const MapEdit damage = map_edit(name, flags); damage) {
      const DamagedMaps folder;
      double share = 0.0;
      const apps::MapFlags damaged = edited_map(job.map, damage, folder.path(), share);
      apps::OpenedView view = apps::open_view(common, job.method, damaged);
      const Run run = play(world, view, job, in_order(world, 0, world.size()), name);
      out.trace(world, name, run);
      char label[64];
      std::snprintf(label, sizeof(label), "%.0f %% %s", 100.0 * share, name.c_str());
      out.add(compared(world, label, judge(run), undisturbed));
    } else {
      run_starts(world, opened, flags, plain, out);
    }
  }
  out.write();
}

}  // namespace

void add_disturb(CLI::App& app, apps::Common& common) {
  CLI::App* command = apps::add_command(
      app, common, "disturb",
      "disturbed runs, each against the undisturbed one over the same frames (bars: ATE at most twice, at most 2 % "
      "lost). Images: noise, gamma, exposure steps, motion blur along the true motion of the image's centre at 2 m, a "
      "wave of brightness that rolls over the rows. Map: balls deleted, cubes moved. Start pose: off in several "
      "directions, judged from frame 30 to 149");
  auto flags = std::make_shared<DisturbFlags>();
  add_job_flags(command, flags->job);
  command->add_option("--only", flags->only, "which of noise, gamma, exposure, blur, rolling, deleted, moved, start")
      ->delimiter(',')
      ->check(CLI::IsMember(flags->only));
  apps::add_number(command, "--noise", flags->noise, {.least = 0.0, .most = 255.0},
                   "standard deviation of the noise [grey levels of 255]");
  apps::add_number(command, "--gamma", flags->gamma, {.least = 0.1, .most = 10.0}, "exponent of the brightness");
  apps::add_number(command, "--exposure", flags->exposure, {.least = 0.1, .most = 10.0},
                   "factor of an exposure step: 1, F, 1, 1/F and so on");
  apps::add_number(command, "--exposure-seconds", flags->exposure_seconds, {.least = 0.01, .most = 1000.0},
                   "time between steps [s]");
  apps::add_number(command, "--blur", flags->blur_px, {.least = 0.1, .most = 100.0}, "length of the motion blur [px]");
  apps::add_number(command, "--rolling", flags->rolling, {.least = 0.0, .most = 0.9}, "amplitude of the rolling gain");
  apps::add_number(command, "--rolling-seconds", flags->rolling_seconds, {.least = 0.01, .most = 1000.0},
                   "time in which it goes once over the image [s]");
  apps::add_number(command, "--deleted", flags->deleted, {.least = 0.0, .most = 0.95},
                   "share of the map that is deleted");
  apps::add_number(command, "--deleted-radius", flags->deleted_radius, {.least = 0.01, .most = 100.0},
                   "radius of the balls deleted [m]");
  apps::add_number(command, "--pieces", flags->moved.pieces, {.least = 0, .most = 1000}, "pieces of the map moved");
  apps::add_number(command, "--piece-edge", flags->moved.edge, {.least = 0.01, .most = 100.0},
                   "edge of the cubes that cut them out [m]");
  apps::add_number(command, "--piece-distance", flags->moved.distance, {.least = 0.0, .most = 100.0},
                   "how far each is moved [m]");
  apps::add_number(command, "--starts", flags->starts, {.least = 0, .most = 1000}, "wrong start poses");
  apps::add_number(command, "--start-distance", flags->start_m, {.least = 0.0, .most = 100.0},
                   "how far off the start is [m]");
  apps::add_number(command, "--start-angle", flags->start_deg, {.least = 0.0, .most = 180.0},
                   "how far it is turned [deg]");
  command->final_callback([&common, flags] { run_disturb(common, *flags); });
}

}  // namespace odosplat::accuracy
