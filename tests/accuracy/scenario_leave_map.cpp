// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "apps/command/interrupt.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "tests/accuracy/output.hpp"
#include "tests/accuracy/scenarios.hpp"

namespace odosplat::accuracy {
namespace {

struct LeaveMapFlags {
  Job job;
  double outside = 0.1;  // the camera is outside if less than this share of the image has map depth
  double inside = 0.4;   // and inside again if at least this share has
  double bar_mm = 5.0;
};

Script there_and_back(const World& world) {
  Script script;
  for (std::size_t k = 0; k < 2 * world.size() - 1; ++k) {
    const std::size_t frame = k < world.size() ? k : 2 * (world.size() - 1) - k;
    script.push_back({static_cast<double>(k) / world.fps(), frame});
  }
  return script;
}

/// For each frame the share of the image with map depth, rendered from the true pose at half the size.
std::vector<double> map_shares(const World& world, MapView& map) {
  const Camera camera = world.camera().level(1);
  std::vector<double> shares;
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (apps::interrupted()) throw Interrupted();
    const ViewImages view = map.render(camera, world.T_world_camera(i), {});
    shares.push_back(static_cast<double>(cv::countNonZero(view.depth)) / static_cast<double>(view.depth.total()));
  }
  return shares;
}

/// Steps from leaving the map to re-entering it.
struct Excursion {
  std::size_t left = 0;      // first step outside
  std::size_t returned = 0;  // first step inside again; the run's size if never
};

std::vector<Excursion> excursions(const Script& script, const std::vector<double>& shares, const LeaveMapFlags& flags) {
  std::vector<Excursion> found;
  bool away = false;
  for (std::size_t k = 0; k < script.size(); ++k) {
    const double share = shares[script[k].frame];
    if (!away && share < flags.outside) {
      found.push_back({k, script.size()});
      away = true;
    } else if (away && share >= flags.inside) {
      found.back().returned = k;
      away = false;
    }
  }
  return found;
}

/// Largest position error of the live poses of some steps [mm], infinite if there are none.
double largest_error_mm(const Run& run, std::size_t begin, std::size_t end) {
  const Judged judged = judge(run, begin, end);
  return judged.live_ate_m.count > 0 ? 1000.0 * judged.live_ate_m.max : std::numeric_limits<double>::infinity();
}

void run_leave_map(const apps::Common& common, const LeaveMapFlags& flags) {
  Output out(flags.job);
  const World world(flags.job);
  apps::OpenedView opened = apps::open_view(common, flags.job.track.method, flags.job.track.map);
  if (opened.sensor != nullptr) throw InputError("--method", "a depth sensor's map cannot be left");
  const std::vector<double> shares = map_shares(world, *opened.view);
  const Script script = there_and_back(world);
  const std::vector<Excursion> away = excursions(script, shares, flags);
  if (away.empty()) throw InputError("map", "the sequence never leaves it: give one of a part, train --frames A:B");
  const Run run = play(world, opened, flags.job.track, script, "leave map");
  out.trace(world, "leave map", run);
  out.add(row_of(world, "whole run", judge(run)).number("mean_share", statistics(shares).mean, 2));
  RecoveryBars bars;
  bars.meters = flags.bar_mm / 1000.0;
  for (std::size_t n = 0; n < away.size(); ++n) {
    const Excursion& trip = away[n];
    const std::size_t next = n + 1 < away.size() ? away[n + 1].left : run.frames.size();
    Row row = row_of(world, "outside, trip " + std::to_string(n + 1), judge(run, trip.left, trip.returned));
    row.count("first", static_cast<long>(world.number(script[trip.left].frame)))
        .number("live_max_mm", largest_error_mm(run, trip.left, trip.returned), 1);
    if (trip.returned < run.frames.size()) {
      const int recovered = frames_until_recovered(run, trip.returned, next, bars);
      row.count("re-entered", static_cast<long>(world.number(script[trip.returned].frame)))
          .number("drift_mm", largest_error_mm(run, trip.returned, trip.returned + 1), 1)
          .count("recovered_in", recovered)
          .number("max_after_mm",
                  recovered < 0 ? std::numeric_limits<double>::infinity()
                                : largest_error_mm(run, trip.returned + static_cast<std::size_t>(recovered), next),
                  1)
          .flag("pass", recovered >= 0 && recovered <= 30);
    }
    out.add(row);
  }
  out.write();
}

}  // namespace

void add_leave_map(CLI::App& app, apps::Common& common) {
  CLI::App* command = apps::add_command(
      app, common, "leave-map",
      "the sequence forward and back in a map of a part of it (train --frames A:B): how long the camera is outside, "
      "seen "
      "from the true poses, with errors and losses there; error when it re-enters, frames until it is within the bar "
      "for 15 frames (-1: never; at most 30 pass), largest live error from then on");
  auto flags = std::make_shared<LeaveMapFlags>();
  add_job_flags(command, flags->job);
  apps::add_number(command, "--outside", flags->outside, {.least = 0.0, .most = 1.0},
                   "outside where less than this share of the true view has map depth");
  apps::add_number(command, "--inside", flags->inside, {.least = 0.0, .most = 1.0},
                   "re-entered where at least this share has");
  apps::add_number(command, "--bar", flags->bar_mm, {.least = 0.01, .most = 10000.0},
                   "error that counts as back in the map [mm]");
  command->final_callback([&common, flags] { run_leave_map(common, *flags); });
}

}  // namespace odosplat::accuracy
