// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <numbers>

#include "apps/command/number_flags.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "tests/accuracy/disturb/disturbances.hpp"
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
  DisturbanceOptions strength;
  int starts = 6;
  double start_m = 0.1;
  double start_deg = 5.0;
};

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
    if (const auto edit = image_disturbance(name, world, flags.strength, job.seed); edit) {
      const Run run = play(world, opened, job, in_order(world, 0, world.size(), edit), name);
      out.trace(world, name, run);
      out.add(compared(world, name, judge(run), undisturbed));
    } else if (const MapEdit damage = map_disturbance(name, flags.strength, job.seed); damage) {
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
  add_disturbance_flags(command, flags->strength);
  apps::add_number(command, "--starts", flags->starts, {.least = 0, .most = 1000}, "wrong start poses");
  apps::add_number(command, "--start-distance", flags->start_m, {.least = 0.0, .most = 100.0},
                   "how far off the start is [m]");
  apps::add_number(command, "--start-angle", flags->start_deg, {.least = 0.0, .most = 180.0},
                   "how far it is turned [deg]");
  command->final_callback([&common, flags] { run_disturb(common, *flags); });
}

}  // namespace odosplat::accuracy
